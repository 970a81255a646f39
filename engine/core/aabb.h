#pragma once
#include <glm/glm.hpp>

#include <limits>

namespace firstray::inline v0 {

/// An axis-aligned box, closed; empty while lo > hi.
template <typename Real>
struct BasicAabb {
    using Vec = glm::vec<3, Real, glm::defaultp>;    ///< a point
    Vec lo{std::numeric_limits<Real>::infinity()};   ///< smallest coordinates
    Vec hi{-std::numeric_limits<Real>::infinity()};  ///< largest coordinates

    /// Makes it hold a point too.
    void grow(const Vec& p)
    {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    /// Makes it hold a box too.
    void grow(const BasicAabb& box)
    {
        lo = glm::min(lo, box.lo);
        hi = glm::max(hi, box.hi);
    }
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }  ///< holds no point
    Vec size() const { return hi - lo; }                                            ///< negative where empty
};

/// The largest coordinate in magnitude of any point of a box; 0 where it is empty.
template <typename Real>
Real largest_coordinate(const BasicAabb<Real>& box)
{
    if (box.empty()) return Real(0);
    const auto farthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
    return glm::max(glm::max(farthest.x, farthest.y), farthest.z);
}

using Aabb = BasicAabb<float>;    ///< of what is tested
using DAabb = BasicAabb<double>;  ///< of what is posed

}  // namespace firstray::inline v0
