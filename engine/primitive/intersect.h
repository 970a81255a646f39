#pragma once
#include "engine/core/precision.h"
#include "engine/core/search_ray.h"
#include "engine/primitive/triangle.h"

namespace firstray::inline v0 {

/// The test of a search ray and a triangle, in the precision asked for: hits with t_min < t <= t_last. A function of
/// its own for all kernels: inlined there, it made them so large that the compiler stopped inlining its arithmetic.
template <typename Real>
TriangleHit<Real> intersect_precisely(const RootTriangle<Real>& triangle, const SearchRay<Real>& ray,
                                      Precision precision, Real t_last);

}  // namespace firstray::inline v0
