#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>

#include "engine/core/ray_tile.h"
#include "engine/render/texture.h"
#include "engine/scene/pose.h"

namespace firstray::inline v0 {

inline double largest_coordinate(const glm::dvec3& p)
{
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// A ray and the nearest hit along it, root system, in double whatever the tile's precision.
struct RayHit {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0};  ///< any length, in which t counts
    double t = 0.0, u = 0.0, v = 0.0;
    PrimitiveId primitive = no_primitive;
};

/// The place that a ray met, root system. Surfaces have two sides that look alike: both normals are turned to the side
/// that the ray came from.
struct Surface {
    glm::dvec3 point{0.0};
    glm::dvec3 origin{0.0};     ///< of the ray
    glm::dvec3 direction{0.0};  ///< of the ray, unit
    glm::dvec3 geometric{0.0};  ///< unit normal of the primitive
    glm::dvec3 normal{0.0};     ///< unit normal to shade with
    bool from_outside = true;   ///< whether the primitive's own normal pointed to the ray's side
    double extent = 0.0;        ///< largest coordinate, as a magnitude, that `point` was computed from
    const Material* material = nullptr;
    TexturePlace place;       ///< in the texture, if there is one
    glm::vec3 texture{1.0f};  ///< colour of the texture here, once it was looked up
};

/// The surface that a ray met; its texture is still to be looked up.
Surface surface_at(const Pose& pose, std::span<const Texture> textures, const RayHit& hit);

/// Ray i of a tile after Strategy::closest; it must have hit.
template <typename Real>
RayHit ray_hit(const RayTile<Real>& rays, int i)
{
    const auto lane = static_cast<std::size_t>(i);
    return {.origin = glm::dvec3(rays.origin_of(i)),
            .direction = glm::dvec3(rays.direction_of(i)),
            .t = rays.t_max[lane],
            .u = rays.u[lane],
            .v = rays.v[lane],
            .primitive = rays.primitive[lane]};
}

/// How far off a surface a ray must begin or end so that it cannot meet the surface again, per unit of the largest
/// coordinate involved: free of the scene's unit of length. In float, in units of the rounding error 2^-24 of that
/// coordinate: the vertices tested are off by up to 1 per axis, so is the ray's origin, a shadow ray's direction by 2
/// (it can be twice as long), and t by a few. Of 3 M random hits seen from random places, rays meet their own triangle
/// again (ppm; triangle tests in double / in float; leaving / shadow rays)
///     2 units  2 / 126, 1 / 1069      4 units  0 / 26, 0 / 8      16 units  0 / 2, 0 / 0
/// In double the vertices tested are those that the point was computed from, and 8 units of 2^-53 do.
template <typename Real>
inline constexpr double self_hit_margin = std::is_same_v<Real, float> ? 0x1p-20 : 0x1p-50;

/// Where a ray that leaves the surface in `direction` begins: off it, on the side that the ray leaves to.
template <typename Real>
glm::dvec3 start_of_ray(const Surface& surface, const glm::dvec3& direction)
{
    const double off = self_hit_margin<Real> * surface.extent;
    return surface.point + (glm::dot(direction, surface.geometric) < 0.0 ? -off : off) * surface.geometric;
}

/// A ray that leaves a surface and begins, for the eye, at a point that others have in common: apex + t * direction,
/// from t_min on.
template <typename Real>
struct RayFromApex {
    glm::vec<3, Real, glm::defaultp> apex, direction;
    Real t_min;
};

/// The ray that leaves the surface as if it came straight from `apex`; nothing where rounding the apex would turn it
/// visibly (apexes that are near, or far away for the size of the scene), or where it leaves the surface too low to be
/// told from it.
template <typename Real>
std::optional<RayFromApex<Real>> ray_from_apex(const Surface& surface, const glm::dvec3& apex)
{
    constexpr double nearest = 0x1p-8, farthest = 16.0, lowest = 0x1p-6;
    const glm::vec<3, Real, glm::defaultp> rounded(apex);
    const glm::dvec3 along = surface.point - glm::dvec3(rounded);
    const double extent = std::max(surface.extent, largest_coordinate(apex)), length = glm::length(along);
    const double height = std::abs(glm::dot(along, surface.geometric));
    if (!(extent <= farthest * surface.extent && length >= nearest * extent && height >= lowest * length)) return {};
    return RayFromApex<Real>{rounded, decltype(rounded)(along),
                             static_cast<Real>(1.0 + self_hit_margin<Real> * extent / height)};
}

/// Where a ray that comes from a light ends: off the surface, on the viewer's side.
template <typename Real>
glm::dvec3 end_of_shadow_ray(const Surface& surface, const glm::dvec3& light)
{
    const double extent = std::max(surface.extent, largest_coordinate(light));
    return surface.point + self_hit_margin<Real> * extent * surface.geometric;
}

}  // namespace firstray::inline v0
