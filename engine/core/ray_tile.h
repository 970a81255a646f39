#pragma once
#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace firstray::inline v0 {

/// Scene-wide index of a primitive; ids run group by group, so order by id is order by (group, primitive).
using PrimitiveId = std::uint32_t;
inline constexpr PrimitiveId no_primitive = 0xffffffffu;  ///< where nothing is hit

/// Which primitives a ray can meet.
enum class RayMask : std::uint8_t {
    all,
    opaque,       ///< transmittance 0
    transmitting  ///< transmittance > 0
};

/// Whether a mask admits a primitive, by whether it transmits light.
inline bool admits(RayMask mask, bool transmits)
{
    return mask == RayMask::all || (mask == RayMask::transmitting) == transmits;
}

/// Whether a mask may admit any of some primitives, by whether any of them may transmit light.
inline bool may_admit(RayMask mask, bool may_transmit)
{
    return mask != RayMask::transmitting || may_transmit;
}

/// What a ray cost: filled only where a tile asks for it.
struct RayCost {
    std::uint32_t cells = 0;        ///< cells entered, empty ones included
    std::uint32_t tests = 0;        ///< primitives tested, lanes of padding not counted
    std::uint64_t nanoseconds = 0;  ///< wall-clock time spent searching
};

/// Up to 1,024 rays, structure of arrays, with room for what is found along them.
/// A ray is apex + t * direction[i] (or origin[i] + t * direction[i] where there is no common apex), t in the open
/// interval (t_min, t_max). Coordinates are the root system's: world minus the scene's origin (Scene::origin).
/// Directions need not be normalised; t counts in their lengths. A ray with a NaN, an infinite or zero direction, or an
/// origin beyond 1e18 meets nothing.
template <typename Real>
struct RayTile {
    using Vec = glm::vec<3, Real, glm::defaultp>;  ///< a point or direction
    static constexpr int capacity = 1024;          ///< most rays in a tile
    using Lane = std::array<Real, capacity>;       ///< a number per ray

    int count = 0;                ///< rays in use, [0, capacity]
    bool common_apex = false;     ///< all rays start at `apex`; `origin` is then not read
    RayMask mask = RayMask::all;  ///< of all rays in the tile
    Vec apex{0};                  ///< where all rays start, if common_apex

    alignas(64) Lane origin[3];     ///< x, y, z
    alignas(64) Lane direction[3];  ///< x, y, z
    alignas(64) Lane t_min;         ///< the near end
    alignas(64) Lane t_max;  ///< in: the far end, infinity allowed; out, by closest: t of the nearest hit, if any

    /// Set by closest: no_primitive where nothing was hit. Set by occluded: any primitive met, or no_primitive.
    alignas(64) std::array<PrimitiveId, capacity> primitive;
    alignas(64) Lane u;  ///< triangle: weight of vertex 1; quadrics: 0
    alignas(64) Lane v;  ///< triangle: weight of vertex 2; quadrics: 0

    /// `count` entries that the search adds to, or null: counting then costs nothing. Rays whose cost is asked for go
    /// one by one, since a beam's cannot be told apart.
    RayCost* cost = nullptr;

    /// `count` entries, 1 each, or null: for occluded with RayMask::opaque. A search that can tell by the way clears
    /// those of rays that certainly meet nothing that transmits. Entries of rays that are occluded mean nothing.
    std::uint8_t* may_pass = nullptr;

    Vec origin_of(int i) const { return common_apex ? apex : get(origin, i); }  ///< of ray i
    Vec direction_of(int i) const { return get(direction, i); }                 ///< of ray i
    void set_origin(int i, const Vec& o) { set(origin, i, o); }                 ///< of ray i
    void set_direction(int i, const Vec& d) { set(direction, i, d); }           ///< of ray i
    /// t_min and t_max of ray i.
    void set_interval(int i, Real begin, Real end = std::numeric_limits<Real>::infinity())
    {
        t_min[static_cast<std::size_t>(i)] = begin;
        t_max[static_cast<std::size_t>(i)] = end;
    }

private:
    static Vec get(const Lane (&lanes)[3], int i)
    {
        const auto k = static_cast<std::size_t>(i);
        return {lanes[0][k], lanes[1][k], lanes[2][k]};
    }
    static void set(Lane (&lanes)[3], int i, const Vec& v)
    {
        for (int axis = 0; axis < 3; ++axis) lanes[axis][static_cast<std::size_t>(i)] = v[axis];
    }
};

}  // namespace firstray::inline v0
