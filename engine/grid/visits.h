#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace firstray::inline v0 {

/// Which items of boxed grids a ray, or a beam, has been sent into already: never twice into the same. One for each thread.
class Visits {
public:
    void begin_ray(std::size_t items)
    {
        if (last_.size() < items) last_.resize(items);
        ++ray_;
    }
    bool is_first(std::uint32_t item)
    {
        const bool first = last_[item] != ray_;
        last_[item] = ray_;
        return first;
    }

    /// Rays are numbered through on a thread, so that visits in one structure say nothing about another.
    static Visits& of_this_thread();

private:
    std::vector<std::uint64_t> last_;  ///< by item: the last ray that was sent into it
    std::uint64_t ray_ = 0;
};

}  // namespace firstray::inline v0
