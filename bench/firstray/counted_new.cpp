#include "bench/firstray/counted_new.h"

#include <malloc.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace firstray::command {

std::atomic<bool (*)()> fails_allocation{nullptr};

namespace {

// All zero before the first constructor runs: operator new may be called that early.
std::atomic<std::int64_t> limit{0}, held{0}, most{0};
std::atomic<bool> hit{false};

void note_most(std::int64_t now)
{
    std::int64_t before = most.load(std::memory_order_relaxed);
    while (before < now && !most.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
    }
}

/// What the large may not have: messages, and destructors that allocate, must go on when the limit is reached.
std::int64_t reserve_for(std::int64_t size, std::int64_t largest)
{
    constexpr std::int64_t small = 1024, reserve = 64 * 1024;
    return size <= small ? 0 : std::min(reserve, largest / 8);
}

/// Counts what malloc has given, which may be more than was asked for; gives it back where that is too much.
void* counted(void* memory)
{
    const std::int64_t largest = limit.load(std::memory_order_relaxed);
    if (largest == 0 || memory == nullptr) return memory;
    const auto size = static_cast<std::int64_t>(malloc_usable_size(memory));
    const std::int64_t now = held.fetch_add(size, std::memory_order_relaxed) + size;
    if (now <= largest - reserve_for(size, largest)) {
        note_most(now);
        return memory;
    }
    held.fetch_sub(size, std::memory_order_relaxed);
    hit.store(true, std::memory_order_relaxed);
    std::free(memory);
    return nullptr;
}

/// Refuses by its size alone what can never fit, so that it is not even mapped.
bool is_hopeless(std::size_t size)
{
    const std::int64_t largest = limit.load(std::memory_order_relaxed);
    if (largest == 0 || size <= static_cast<std::uint64_t>(largest)) return false;
    hit.store(true, std::memory_order_relaxed);
    return true;
}

void* allocate(std::size_t size, std::size_t boundary)
{
    if (const auto fails = fails_allocation.load(std::memory_order_relaxed); fails && fails()) throw std::bad_alloc();
    if (is_hopeless(size) || size > PTRDIFF_MAX) throw std::bad_alloc();
    const std::size_t least = size == 0 ? 1 : size;
    // aligned_alloc wants a multiple of the boundary
    void* const memory = counted(boundary <= alignof(std::max_align_t)
                                     ? std::malloc(least)
                                     : std::aligned_alloc(boundary, (least + boundary - 1) / boundary * boundary));
    if (!memory) throw std::bad_alloc();
    return memory;
}

void give_back(void* memory) noexcept
{
    if (memory && limit.load(std::memory_order_relaxed) != 0)
        held.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(memory)), std::memory_order_relaxed);
    std::free(memory);
}

}  // namespace

MemoryLimit::MemoryLimit(std::uint64_t bytes)
{
    held = most = 0;
    hit = false;
    limit = static_cast<std::int64_t>(bytes);
}

MemoryLimit::~MemoryLimit()
{
    limit = 0;
}

bool MemoryLimit::was_hit()
{
    return hit;
}

std::uint64_t MemoryLimit::peak()
{
    return static_cast<std::uint64_t>(most.load());
}

}  // namespace firstray::command

void* operator new(std::size_t size)
{
    return firstray::command::allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t boundary)
{
    return firstray::command::allocate(size, static_cast<std::size_t>(boundary));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
try {
    return operator new(size);
} catch (const std::bad_alloc&) {
    return nullptr;
}
void* operator new(std::size_t size, std::align_val_t boundary, const std::nothrow_t&) noexcept
try {
    return operator new(size, boundary);
} catch (const std::bad_alloc&) {
    return nullptr;
}
void operator delete(void* memory) noexcept
{
    firstray::command::give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    firstray::command::give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    firstray::command::give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    firstray::command::give_back(memory);
}
// The standard's array forms call these; a sanitizer's do not.
void* operator new[](std::size_t size)
{
    return operator new(size);
}
void operator delete[](void* memory) noexcept
{
    operator delete(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
    operator delete(memory);
}
