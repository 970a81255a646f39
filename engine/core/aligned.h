#pragma once
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace firstray::inline v0 {

/// Memory on the boundary of a cache line; much of it in huge pages where the system has them, because it takes longer
/// to be given pages of 4 KB than to fill them.
/// throws  std::bad_alloc
void* allocate_lines(std::size_t bytes);
void free_lines(void* memory, std::size_t bytes);

/// Allocates on boundaries of cache lines and does not write to what it hands out: a vector of plain data that is
/// filled by many threads is then touched once.
template <typename T>
struct CacheLineAllocator {
    using value_type = T;

    CacheLineAllocator() = default;
    template <typename Other>
    explicit CacheLineAllocator(const CacheLineAllocator<Other>&)
    {
    }
    T* allocate(std::size_t count) { return static_cast<T*>(allocate_lines(count * sizeof(T))); }
    void deallocate(T* data, std::size_t count) { free_lines(data, count * sizeof(T)); }
    /// Value-initialisation is what vector::resize asks for; plain data is left as it is.
    template <typename U>
    void construct(U* place)
    {
        ::new (static_cast<void*>(place)) U;
    }
    template <typename U, typename... Args>
    void construct(U* place, Args&&... args)
    {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    bool operator==(const CacheLineAllocator&) const { return true; }
};

/// A vector of plain data whose elements are not initialised by resize().
template <typename T>
using RawVector = std::vector<T, CacheLineAllocator<T>>;

/// Makes a vector's size `count`; what it held is lost. One that grows again gets room for an eighth more, so that sizes
/// which rise a little from frame to frame do not ask for memory every time.
template <typename T>
void resize_for_overwrite(RawVector<T>& vector, std::size_t count)
{
    vector.clear();
    if (count > vector.capacity()) {
        const std::size_t room = vector.capacity() == 0 ? count : count + count / 8;
        vector = {};  // before the new memory is asked for
        vector.reserve(room);
    }
    vector.resize(count);
}

}  // namespace firstray::inline v0
