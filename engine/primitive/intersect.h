#pragma once
#include <type_traits>

#include "engine/core/precision.h"
#include "engine/core/search_ray.h"
#include "engine/primitive/triangle.h"

namespace firstray::inline v0 {

/// The test of a search ray and a triangle, in the precision asked for: hits with t_min < t <= t_last.
template <typename Real>
FIRSTRAY_INLINE TriangleHit<Real> intersect_precisely(const RootTriangle<Real>& triangle, const SearchRay<Real>& ray,
                                                      Precision precision, Real t_last)
{
    if constexpr (std::is_same_v<Real, float>)
        return intersect(triangle, ray.origin, ray.direction, precision != Precision::fast, {ray.t_min, t_last});
    else
        return intersect(triangle, ray.origin, ray.direction, {ray.t_min, t_last});
}

}  // namespace firstray::inline v0
