#pragma once
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace firstray::test {

/// Threads of the standard library, which the thread sanitizer understands through and through (an Executor's it does
/// not), that start together.
class Crew {
public:
    explicit Crew(int threads) : threads_(threads) {}

    /// Calls body(thread) on every thread, on none before all are there; returns when all are done.
    void run(const std::function<void(int thread)>& body) const
    {
        std::atomic<int> missing{threads_};
        std::vector<std::thread> crew;
        for (int i = 0; i < threads_; ++i)
            crew.emplace_back([&, i] {
                for (--missing; missing > 0;) std::this_thread::yield();
                body(i);
            });
        for (std::thread& thread : crew) thread.join();
    }

private:
    int threads_;
};

}  // namespace firstray::test
