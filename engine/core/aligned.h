#pragma once
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace firstray::inline v0 {

/// Allocates on boundaries of cache lines and does not write to what it hands out: a vector of plain data that is
/// filled by many threads is then touched once.
template <typename T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t boundary{64};

    CacheLineAllocator() = default;
    template <typename Other>
    explicit CacheLineAllocator(const CacheLineAllocator<Other>&)
    {
    }
    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), boundary)); }
    void deallocate(T* data, std::size_t) { ::operator delete(data, boundary); }
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

}  // namespace firstray::inline v0
