#pragma once
#include <atomic>
#include <cstdint>

namespace firstray::command {

/// Bounds what the program's operator new has given out and not got back, while this lives; beyond it std::bad_alloc is
/// thrown. The last 64 KiB are for small allocations, so that a run that has reached the limit can still end in order.
/// OpenImageIO's and TBB's C++ parts allocate by the same operator. Not counted: code, stacks, what C libraries
/// and TBB's task pools take from malloc themselves. One at a time.
class MemoryLimit {
public:
    /// bytes  0: no limit
    explicit MemoryLimit(std::uint64_t bytes);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

    /// Whether the limit that lives, or lived last, has refused an allocation.
    static bool was_hit();
    /// Most that was held at once under it, in bytes; 0 where there was no limit.
    static std::uint64_t peak();
};

/// Asked before every allocation, where it is set: true has it fail. For tests.
extern std::atomic<bool (*)()> fails_allocation;

}  // namespace firstray::command
