#pragma once
#include "bench/peers/embree_query.h"

namespace firstray::peers {

/// Embree's types and functions for `width` rays at once.
template <int width>
struct PacketOf;
template <>
struct PacketOf<4> {
    using Rays = RTCRay4;
    using RayHits = RTCRayHit4;
    static constexpr auto intersect = &rtcIntersect4;
    static constexpr auto occluded = &rtcOccluded4;
};
template <>
struct PacketOf<8> {
    using Rays = RTCRay8;
    using RayHits = RTCRayHit8;
    static constexpr auto intersect = &rtcIntersect8;
    static constexpr auto occluded = &rtcOccluded8;
};
template <>
struct PacketOf<16> {
    using Rays = RTCRay16;
    using RayHits = RTCRayHit16;
    static constexpr auto intersect = &rtcIntersect16;
    static constexpr auto occluded = &rtcOccluded16;
};

/// Which lanes are traced, in Embree's words: -1 or 0.
template <int width>
struct alignas(4 * width) Lanes {
    int valid[width];
};

/// Sets what is the same in all packets of a tile with a common apex. Embree leaves it as it is.
template <int width>
void prepare(const RayTile<float>& tile, unsigned mask, typename PacketOf<width>::Rays& rays)
{
    for (int i = 0; i < width; ++i) {
        rays.org_x[i] = tile.apex.x;
        rays.org_y[i] = tile.apex.y;
        rays.org_z[i] = tile.apex.z;
        rays.time[i] = 0.0f;
        rays.mask[i] = mask;
        rays.flags[i] = 0;
    }
}

/// Loads the tile's rays from `first` on, a multiple of width. Lanes behind the last ray get what the tile has there,
/// and are not traced.
template <int width>
Lanes<width> load(const RayTile<float>& tile, int first, typename PacketOf<width>::Rays& rays)
{
    static_assert(RayTile<float>::capacity % width == 0);
    Lanes<width> lanes;
    for (int i = 0; i < width; ++i) {
        const auto lane = static_cast<std::size_t>(first + i);
        const glm::vec3 direction = tile.direction_of(first + i);
        const float t_min = tile.t_min[lane], t_max = tile.t_max[lane];
        const ClosedInterval interval = inside(t_min, t_max);
        rays.dir_x[i] = direction.x;
        rays.dir_y[i] = direction.y;
        rays.dir_z[i] = direction.z;
        rays.tnear[i] = interval.begin;
        rays.tfar[i] = interval.end;
        rays.id[i] = static_cast<unsigned>(first + i);
        lanes.valid[i] = -static_cast<int>((first + i < tile.count) & is_searchable(direction, t_min, t_max));
    }
    return lanes;
}

/// Strategy::closest for a tile with a common, finite apex.
/// body_of  as of trace_closest
template <int width, typename BodyOf>
void closest_in_packets(RTCScene scene, RayTile<float>& tile, const BodyOf& body_of)
{
    RTCIntersectContext context = context_with(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    typename PacketOf<width>::RayHits query;
    prepare<width>(tile, mask_bits(tile.mask), query.ray);
    for (int first = 0; first < tile.count; first += width) {
        const Lanes<width> lanes = load<width>(tile, first, query.ray);
        for (int i = 0; i < width; ++i) query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        PacketOf<width>::intersect(lanes.valid, scene, &context, &query);
        for (int i = 0; i < width && first + i < tile.count; ++i) {
            const auto lane = static_cast<std::size_t>(first + i);
            tile.primitive[lane] = no_primitive;
            if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            tile.t_max[lane] = query.ray.tfar[i];
            tile.u[lane] = query.hit.u[i];
            tile.v[lane] = query.hit.v[i];
            tile.primitive[lane] = body_of(query.hit.instID[0][i]).primitive(query.hit.geomID[i], query.hit.primID[i]);
        }
    }
}

/// Strategy::occluded for a tile with a common, finite apex.
/// met, flags  as of trace_occluded
template <int width>
void occluded_in_packets(RTCScene scene, RayTile<float>& tile, PrimitiveId met, RTCIntersectContextFlags flags)
{
    ShadowContext context = shadow_context(tile, flags);
    typename PacketOf<width>::Rays rays;
    prepare<width>(tile, shadow_mask_bits(tile), rays);
    for (int first = 0; first < tile.count; first += width) {
        const Lanes<width> lanes = load<width>(tile, first, rays);
        PacketOf<width>::occluded(lanes.valid, scene, &context, &rays);
        for (int i = 0; i < width && first + i < tile.count; ++i) {
            const bool is_met = lanes.valid[i] && rays.tfar[i] < 0.0f;  // minus infinity where something was met
            tile.primitive[static_cast<std::size_t>(first + i)] = is_met ? met : no_primitive;
        }
    }
}

}  // namespace firstray::peers
