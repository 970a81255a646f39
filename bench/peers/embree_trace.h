#pragma once
#include <bit>
#include <cstdint>
#include <limits>

#include "bench/peers/embree_body.h"
#include "engine/core/ray_tile.h"

namespace firstray::peers {

/// The mask under which Embree tests what a RayMask admits.
inline unsigned mask_bits(RayMask mask)
{
    if (mask == RayMask::all) return all_bits;
    return mask == RayMask::opaque ? opaque_bit : transmitting_bit;
}

/// Whether a ray can meet anything: Embree's answer is undefined for rays that are not finite.
inline bool is_searchable(const glm::vec3& origin, const glm::vec3& direction, float t_min, float t_max)
{
    const glm::vec3 not_finite = (origin - origin) + (direction - direction);  // infinity - infinity is NaN
    return not_finite == glm::vec3(0.0f) && direction != glm::vec3(0.0f) && t_min < t_max && t_max > 0.0f;
}

/// The closed interval of floats inside the open (t_min, t_max), t_max > 0; Embree wants it to begin at 0 or later.
/// A renderer that goes on behind a hit counts on it: a hit at t_min, found again, would be found for ever.
inline void set_interval(RTCRay& ray, float t_min, float t_max)
{
    const auto neighbour = [](float t, int step) {  // of a positive float, in order of size
        return std::bit_cast<float>(std::bit_cast<std::int32_t>(t) + step);
    };
    ray.tnear = t_min > 0.0f ? neighbour(t_min, +1) : std::numeric_limits<float>::min();
    ray.tfar = neighbour(t_max, -1);
}

/// Loads lane i.
/// returns  false where the lane meets nothing, whatever the scene
inline bool load(const RayTile<float>& rays, int i, unsigned mask, RTCRay& ray)
{
    const auto lane = static_cast<std::size_t>(i);
    const glm::vec3 origin = rays.origin_of(i), direction = rays.direction_of(i);
    if (!is_searchable(origin, direction, rays.t_min[lane], rays.t_max[lane])) return false;
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    set_interval(ray, rays.t_min[lane], rays.t_max[lane]);
    ray.time = 0.0f;
    ray.mask = mask;
    ray.id = ray.flags = 0;
    return true;
}

inline RTCIntersectContext context_for(const RayTile<float>& rays)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = rays.common_apex ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

/// Strategy::closest by rtcIntersect1.
/// body_of  a callable from the hit's instance id (RTC_INVALID_GEOMETRY_ID where there are no instances) to the Body
template <typename BodyOf>
void trace_closest(RTCScene scene, RayTile<float>& rays, const BodyOf& body_of)
{
    const FlushSubnormals flush;
    const unsigned mask = mask_bits(rays.mask);
    RTCIntersectContext context = context_for(rays);
    for (int i = 0; i < rays.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        rays.primitive[lane] = no_primitive;
        RTCRayHit query;
        if (!load(rays, i, mask, query.ray)) continue;
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
        rays.t_max[lane] = query.ray.tfar;
        rays.u[lane] = query.hit.u;
        rays.v[lane] = query.hit.v;
        rays.primitive[lane] = body_of(query.hit.instID[0]).primitive(query.hit.geomID, query.hit.primID);
    }
}

/// Strategy::occluded by rtcOccluded1.
/// met  what is named as the primitive of rays that meet something
inline void trace_occluded(RTCScene scene, RayTile<float>& rays, PrimitiveId met)
{
    const FlushSubnormals flush;
    const unsigned mask = mask_bits(rays.mask);
    RTCIntersectContext context = context_for(rays);
    for (int i = 0; i < rays.count; ++i) {
        RTCRay ray;
        bool is_met = false;
        if (load(rays, i, mask, ray)) {
            rtcOccluded1(scene, &context, &ray);
            is_met = ray.tfar < 0.0f;  // minus infinity where something was met
        }
        rays.primitive[static_cast<std::size_t>(i)] = is_met ? met : no_primitive;
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
