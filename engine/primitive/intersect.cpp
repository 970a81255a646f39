#include "engine/primitive/intersect.h"

#include <type_traits>

namespace firstray {

template <typename Real>
TriangleHit<Real> intersect_precisely(const RootTriangle<Real>& triangle, const SearchRay<Real>& ray,
                                      Precision precision, Real t_last)
{
    if constexpr (std::is_same_v<Real, float>)
        return intersect(triangle, ray.origin, ray.direction, precision != Precision::fast, {ray.t_min, t_last});
    else
        return intersect(triangle, ray.origin, ray.direction, {ray.t_min, t_last});
}

template TriangleHit<float> intersect_precisely(const RootTriangle<float>&, const SearchRay<float>&, Precision, float);
template TriangleHit<double> intersect_precisely(const RootTriangle<double>&, const SearchRay<double>&, Precision,
                                                 double);

}  // namespace firstray
