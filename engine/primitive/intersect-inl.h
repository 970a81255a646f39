// The test of a search ray and a triangle. Included once per instruction set.
#if defined(FIRSTRAY_INTERSECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_INTERSECT_INL_H_
#undef FIRSTRAY_INTERSECT_INL_H_
#else
#define FIRSTRAY_INTERSECT_INL_H_
#endif

#include <hwy/highway.h>

#include <type_traits>

#include "engine/core/precision.h"
#include "engine/core/search_ray.h"
#include "engine/primitive/triangle_pack.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// The test of a search ray and a triangle, in the precision asked for: hits with t_min < t <= t_last. A function of
/// its own for all kernels: inlined there, it made them so large that the compiler stopped inlining its arithmetic. For
/// each instruction set, since single rays spend a fifth of their time here.
template <typename Real>
HWY_NOINLINE TriangleHit<Real> intersect_precisely(const RootTriangle<Real>& triangle, const SearchRay<Real>& ray,
                                                   Precision precision, Real t_last)
{
    if constexpr (std::is_same_v<Real, float>)
        return intersect(triangle, ray.origin, ray.direction, precision != Precision::fast, {ray.t_min, t_last});
    else
        return intersect(triangle, ray.origin, ray.direction, {ray.t_min, t_last});
}

/// The same for a triangle in a pack, read where it is needed.
inline HWY_NOINLINE TriangleHit<float> intersect_in_pack(const TrianglePack& pack, int lane,
                                                         const SearchRay<float>& ray, Precision precision, float t_last)
{
    return intersect(pack.triangle(lane), ray.origin, ray.direction, precision != Precision::fast, {ray.t_min, t_last});
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
