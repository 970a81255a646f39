#include "tests/support/failing_new.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr std::int64_t not_armed = -1, failed = -2;
thread_local std::int64_t allocations_left = not_armed;

bool fails_now()
{
    if (allocations_left < 0) return false;
    if (allocations_left-- > 0) return false;
    allocations_left = failed;
    return true;
}

[[maybe_unused]] void* allocate(std::size_t size, std::size_t boundary)
{
    if (fails_now()) throw std::bad_alloc();
    const std::size_t whole = (size + boundary - 1) / boundary * boundary;  // as aligned_alloc wants it
    if (void* const memory = std::aligned_alloc(boundary, whole == 0 ? boundary : whole)) return memory;
    throw std::bad_alloc();
}

}  // namespace

#ifndef FIRSTRAY_NEW_CANNOT_FAIL
void* operator new(std::size_t size)
{
    return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t boundary)
{
    return allocate(size, static_cast<std::size_t>(boundary));
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    std::free(memory);
}

#endif

namespace firstray::test {

FailingNew::FailingNew(std::int64_t number)
{
    allocations_left = number;
}
FailingNew::~FailingNew()
{
    allocations_left = not_armed;
}
bool FailingNew::has_failed() const
{
    return allocations_left == failed;
}

}  // namespace firstray::test
