#pragma once
#include <cstddef>
#include <functional>
#include <memory>

namespace firstray::inline v0 {

/// Runs loops on a fixed number of threads. One small interface over TBB, so that nothing else names it.
/// Engines with executors of their own do not disturb each other.
class Executor {
public:
    /// threads  how many work at once, the caller included; 0 means as many as the machine offers
    explicit Executor(int threads = 0);
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Threads that work at once, >= 1.
    int threads() const { return threads_; }

    /// Calls body(begin, end) for pieces that cover [0, count) exactly, each at most `grain` long (the last may be
    /// shorter); piece k begins at k * grain, whatever the number of threads. Returns when all are done. An exception
    /// thrown by a body ends the loop and is thrown here.
    void for_pieces(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& body) const;

    /// Calls body(i) for i in [0, count), one task each.
    void for_each(std::size_t count, const std::function<void(std::size_t index)>& body) const;

private:
    struct Arena;
    int threads_;
    std::unique_ptr<Arena> arena_;
};

/// The same with an executor, or without one on this thread in one piece.
void for_pieces(const Executor* executor, std::size_t count, std::size_t grain,
                const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace firstray::inline v0
