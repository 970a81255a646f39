#pragma once
#include <atomic>
#include <cstdint>

namespace firstray::inline v0::lazy {

/// Counts what is built while rays fly, and how many bytes it holds; shared by all threads. Builds are rare, so that
/// sharing costs nothing.
class Ledger {
public:
    /// limit  bytes that lazily built parts may hold together; 0: no limit
    explicit Ledger(std::uint64_t limit) : limit_(limit) {}

    /// Asks for bytes before they are allocated; false where the limit would be passed: then nothing is built.
    bool charge(std::uint64_t bytes)
    {
        // By compare-exchange: what is added first and taken back afterwards would, in between, have others refused
        // that there is room for.
        std::uint64_t before = bytes_.load(std::memory_order_relaxed);
        do {
            if (limit_ != 0 && (bytes > limit_ || before > limit_ - bytes)) {
                note_refused();
                return false;
            }
        } while (!bytes_.compare_exchange_weak(before, before + bytes, std::memory_order_relaxed));
        return true;
    }
    /// There is no memory for a build, whatever the limit.
    void note_refused() { refused_.fetch_add(1, std::memory_order_relaxed); }
    /// What was charged turned out to be more, or less.
    void correct(std::uint64_t charged, std::uint64_t held)
    {
        bytes_.fetch_add(held - charged, std::memory_order_relaxed);
    }
    void give_back(std::uint64_t bytes) { bytes_.fetch_sub(bytes, std::memory_order_relaxed); }

    void note_built(std::uint64_t nanoseconds)
    {
        built_.fetch_add(1, std::memory_order_relaxed);
        nanoseconds_.fetch_add(nanoseconds, std::memory_order_relaxed);
    }

    /// Between frames: counts start anew, bytes stay.
    void begin_frame() { built_ = refused_ = nanoseconds_ = 0; }

    std::uint64_t bytes() const { return bytes_; }
    std::uint64_t built() const { return built_; }      ///< voxels and groups, in this frame
    std::uint64_t refused() const { return refused_; }  ///< builds that there was no room for, in this frame
    double milliseconds() const { return 1e-6 * static_cast<double>(nanoseconds_.load()); }  ///< summed over threads

private:
    std::uint64_t limit_;
    std::atomic<std::uint64_t> bytes_{0}, built_{0}, refused_{0}, nanoseconds_{0};
};

}  // namespace firstray::inline v0::lazy
