#pragma once
#include <glm/glm.hpp>

#include "engine/core/aabb.h"
#include "engine/core/search_ray.h"
#include "engine/core/transform.h"
#include "engine/scene/scene.h"

namespace firstray::inline v0 {

/// A sphere, cone or cylinder as it stands in the root system. Intersected exactly, not tessellated, in double in every
/// precision (there are few of them, and a root of a quadratic loses half its digits in float).
struct RootQuadric {
    Quadric quadric;
    Transform quadric_from_root;
    DAabb bounds;  ///< in the root system, closed; empty where it is out of range: then it is not there
    PrimitiveId id = no_primitive;
    bool transmits = false;
};

/// shape  what the scene says of it; root_from_group  where its group stands, not singular
RootQuadric place_quadric(const Quadric& shape, const Transform& root_from_group, PrimitiveId id, bool transmits);

/// The nearest t in the open interval (t_min, t_max) at which the ray meets the surface, or infinity.
double intersect(const RootQuadric& quadric, const glm::dvec3& origin, const glm::dvec3& direction, double t_min,
                 double t_max);

/// The nearest t beyond t_min at which a search ray meets the surface, rounded to the ray's precision; infinity where
/// it does not. Not cut off at t_max: whether the rounded t counts must not depend on what was found before.
template <typename Real>
Real intersect_rounded(const RootQuadric& quadric, const SearchRay<Real>& ray)
{
    return static_cast<Real>(intersect(quadric, glm::dvec3(ray.origin), glm::dvec3(ray.direction),
                                       static_cast<double>(ray.t_min), std::numeric_limits<double>::infinity()));
}

}  // namespace firstray::inline v0
