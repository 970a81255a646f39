#pragma once
#include <cmath>

#include "engine/core/ray_tile.h"

namespace firstray::inline v0 {

/// Coordinates beyond this are out of range: rays that start there meet nothing, triangles with such a corner are not
/// there. So float's products of two lengths stay finite, and double's of as many as are needed.
inline constexpr double farthest_place = 1e18;

template <typename Vec>
bool is_in_range(const Vec (&corners)[3])
{
    for (const Vec& corner : corners)
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(static_cast<double>(corner[axis])) <= farthest_place)) return false;
    return true;
}

/// One ray of a tile as searches want it: known to be in range, and with a direction whose largest component is not
/// extreme. Directions outside [2^-32, 2^32) are scaled by a power of two, which changes t exactly and nothing else, so
/// that products of three lengths stay in range.
template <typename Real>
struct SearchRay {
    using Vec = glm::vec<3, Real, glm::defaultp>;
    Vec origin, direction;
    Real t_min, t_max;
    int exponent = 0;  ///< the tile's direction is `direction` * 2^exponent

    /// t as the tile counts it; infinite where that is out of range.
    Real tile_t(Real t) const { return exponent == 0 ? t : std::ldexp(t, -exponent); }
};

/// Fills `ray` from a lane; false when it can meet nothing (origin out of range, NaN, infinite or zero direction, empty
/// interval).
template <typename Real>
[[gnu::always_inline]] inline bool make_search_ray(const RayTile<Real>& tile, int lane, SearchRay<Real>& ray)
{
    ray.origin = tile.origin_of(lane);
    ray.direction = tile.direction_of(lane);
    ray.t_min = tile.t_min[static_cast<std::size_t>(lane)];
    ray.t_max = tile.t_max[static_cast<std::size_t>(lane)];
    ray.exponent = 0;
    const auto along = glm::abs(ray.direction), apart = glm::abs(ray.origin);
    const Real length = std::max(std::max(along.x, along.y), along.z);
    if (!std::isfinite(along.x) || !std::isfinite(along.y) || !std::isfinite(along.z)) return false;
    constexpr auto farthest = static_cast<Real>(farthest_place);
    if (!(apart.x <= farthest && apart.y <= farthest && apart.z <= farthest)) return false;
    if (!(length > Real(0)) || !(ray.t_min < ray.t_max)) return false;
    if (length >= Real(0x1p-32) && length < Real(0x1p32)) return true;
    ray.exponent = std::ilogb(length);
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = std::ldexp(ray.direction[axis], -ray.exponent);
    ray.t_min = std::ldexp(ray.t_min, ray.exponent);
    ray.t_max = std::ldexp(ray.t_max, ray.exponent);
    return ray.t_min < ray.t_max;
}

/// The nearest hit found so far.
template <typename Real>
struct Hit {
    Real t, u = 0, v = 0;
    PrimitiveId id = no_primitive;

    /// Whether a hit at t on a primitive comes before this one: the order is (t, id), and at first t is an open end.
    bool is_beaten_by(Real other_t, PrimitiveId other_id) const
    {
        return other_t < t || (other_t == t && id != no_primitive && other_id < id);
    }
};

/// Puts a ray's answer into its lane; an answer whose t the tile cannot express is none.
template <typename Real>
[[gnu::always_inline]] inline void store_hit(const SearchRay<Real>& ray, const Hit<Real>& hit, RayTile<Real>& tile, int lane)
{
    const auto i = static_cast<std::size_t>(lane);
    const Real t = ray.tile_t(hit.t);
    if (hit.id == no_primitive || !std::isfinite(t)) return;
    tile.t_max[i] = t;
    tile.primitive[i] = hit.id;
    tile.u[i] = hit.u;
    tile.v[i] = hit.v;
}

}  // namespace firstray::inline v0
