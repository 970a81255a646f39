#pragma once
#include "bench/peers/embree.h"
#include "bench/peers/embree_packets.h"

namespace firstray::peers {

/// Loads ray i.
/// mask     Embree's
/// returns  false where it meets nothing, whatever the scene
inline bool load(const RayTile<float>& tile, int i, unsigned mask, RTCRay& ray)
{
    const auto lane = static_cast<std::size_t>(i);
    const glm::vec3 origin = tile.origin_of(i), direction = tile.direction_of(i);
    if (!is_finite(origin) || !is_searchable(direction, tile.t_min[lane], tile.t_max[lane])) return false;
    const ClosedInterval interval = inside(tile.t_min[lane], tile.t_max[lane]);
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tnear = interval.begin, ray.tfar = interval.end;
    ray.time = 0.0f;
    ray.mask = mask;
    ray.id = static_cast<unsigned>(i);
    ray.flags = 0;
    return true;
}

template <typename BodyOf>
void closest_one_by_one(RTCScene scene, RayTile<float>& tile, const BodyOf& body_of)
{
    RTCIntersectContext context = context_with(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    for (int i = 0; i < tile.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        tile.primitive[lane] = no_primitive;
        RTCRayHit query;
        if (!load(tile, i, mask_bits(tile.mask), query.ray)) continue;
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
        tile.t_max[lane] = query.ray.tfar;
        tile.u[lane] = query.hit.u;
        tile.v[lane] = query.hit.v;
        tile.primitive[lane] = body_of(query.hit.instID[0]).primitive(query.hit.geomID, query.hit.primID);
    }
}

inline void occluded_one_by_one(RTCScene scene, RayTile<float>& tile, PrimitiveId met)
{
    ShadowContext context = shadow_context(tile, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    for (int i = 0; i < tile.count; ++i) {
        RTCRay ray;
        bool is_met = false;
        if (load(tile, i, shadow_mask_bits(tile), ray)) {
            rtcOccluded1(scene, &context, &ray);
            is_met = ray.tfar < 0.0f;  // minus infinity where something was met
        }
        tile.primitive[static_cast<std::size_t>(i)] = is_met ? met : no_primitive;
    }
}

/// Rays that a strategy traces at once where they have a common apex.
inline int packet_width(const Device& device, const Options& options)
{
    return options.rays == Rays::packets ? device.packet_width() : 1;
}

/// Rays of this tile to trace at once: packets are for a common apex, which must be finite.
inline int packet_width(const RayTile<float>& tile, int widest)
{
    return tile.common_apex && is_finite(tile.apex) ? widest : 1;
}

/// Strategy::closest.
/// widest   rays to trace at once where they have a common apex: 1, 4, 8 or 16
/// body_of  a callable from the hit's instance id (RTC_INVALID_GEOMETRY_ID where there are no instances) to the Body
template <typename BodyOf>
void trace_closest(RTCScene scene, int widest, RayTile<float>& tile, const BodyOf& body_of)
{
    const FlushSubnormals flush;
    switch (packet_width(tile, widest)) {
        case 16:
            return closest_in_packets<16>(scene, tile, body_of);
        case 8:
            return closest_in_packets<8>(scene, tile, body_of);
        case 4:
            return closest_in_packets<4>(scene, tile, body_of);
        default:
            return closest_one_by_one(scene, tile, body_of);
    }
}

/// Strategy::occluded.
/// widest  as of trace_closest
/// met     what is named as the primitive of rays that meet something
/// flags   of packets
inline void trace_occluded(RTCScene scene, int widest, RayTile<float>& tile, PrimitiveId met,
                           RTCIntersectContextFlags flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT)
{
    const FlushSubnormals flush;
    switch (packet_width(tile, widest)) {
        case 16:
            return occluded_in_packets<16>(scene, tile, met, flags);
        case 8:
            return occluded_in_packets<8>(scene, tile, met, flags);
        case 4:
            return occluded_in_packets<4>(scene, tile, met, flags);
        default:
            return occluded_one_by_one(scene, tile, met);
    }
}

/// The lowest id among primitives of visible groups, or no_primitive.
inline PrimitiveId lowest_visible(const Pose& pose)
{
    for (const Group& group : pose.scene->groups)
        if (group.primitives() > 0 && pose.is_visible(group)) return group.first;
    return no_primitive;
}

}  // namespace firstray::peers
