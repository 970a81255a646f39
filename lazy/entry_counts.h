#pragma once
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace firstray::inline v0::lazy {

/// Counts what many threads do in many places, without a lock or a shared cache line: every thread counts for itself.
class EntryCounts {
public:
    explicit EntryCounts(std::size_t places);
    EntryCounts(const EntryCounts&) = delete;
    EntryCounts& operator=(const EntryCounts&) = delete;

    /// Any number of threads.
    void add(std::size_t place, std::uint64_t rays)
    {
        // Nobody else writes here, so that a load and a store do; they are atomic for those who read.
        std::atomic<std::uint64_t>& mine = of_this_thread()[place];
        mine.store(mine.load(std::memory_order_relaxed) + rays, std::memory_order_relaxed);
    }
    /// What the calling thread has counted. Any number of threads.
    std::uint64_t mine(std::size_t place) { return of_this_thread()[place].load(std::memory_order_relaxed); }

    /// What all threads have counted, as far as they can be seen from here: exact once they are done, otherwise a
    /// little behind. Any number of threads.
    std::uint64_t total(std::size_t place) const;

    /// Begins anew at a place. Runs alone.
    void clear(std::size_t place);

    std::size_t places() const { return places_; }
    std::uint64_t bytes() const;

private:
    using Counters = std::unique_ptr<std::atomic<std::uint64_t>[]>;

    /// Whose counters the thread used last. The number is never given again, so that nothing is taken for another's
    /// that stood at the same address.
    struct LastUsed {
        std::uint64_t number;  ///< 0: nobody's
        std::atomic<std::uint64_t>* counters;
    };

    std::atomic<std::uint64_t>* of_this_thread()
    {
        return last_used_.number == number_ ? last_used_.counters : find_or_register();
    }
    std::atomic<std::uint64_t>* find_or_register();

    static constinit inline thread_local LastUsed last_used_{};

    std::size_t places_;
    std::uint64_t number_;
    mutable std::mutex mutex_;  ///< guards the map, not the counters
    std::map<std::thread::id, Counters> counters_;
};

}  // namespace firstray::inline v0::lazy
