#include "bench/peers/embree_quadrics.h"

#include <algorithm>
#include <limits>

#include "bench/peers/embree_query.h"

namespace firstray::peers {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The nearest t in (tnear, tfar] along ray i of the n that Embree hands over, or infinity.
float nearest(void* user, unsigned index, RTCRayN* rays, unsigned n, unsigned i)
{
    const RootQuadric& quadric = static_cast<const RootQuadric*>(user)[index];
    const glm::dvec3 origin(RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i));
    const glm::dvec3 direction(RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i));
    const auto t = static_cast<float>(firstray::intersect(quadric, origin, direction,
                                                          static_cast<double>(RTCRayN_tnear(rays, n, i)),
                                                          std::numeric_limits<double>::infinity()));
    return t <= RTCRayN_tfar(rays, n, i) ? t : infinity;
}

void intersect(const RTCIntersectFunctionNArguments* args)
{
    const unsigned n = args->N;
    RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, n);
    RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, n);
    for (unsigned i = 0; i < n; ++i) {
        if (!args->valid[i]) continue;
        const float t = nearest(args->geometryUserPtr, args->primID, rays, n, i);
        if (t == infinity) continue;
        RTCRayN_tfar(rays, n, i) = t;
        RTCHitN_u(hits, n, i) = RTCHitN_v(hits, n, i) = 0.0f;
        RTCHitN_primID(hits, n, i) = args->primID;
        RTCHitN_geomID(hits, n, i) = args->geomID;
        RTCHitN_instID(hits, n, i, 0) = args->context->instID[0];
    }
}

void occluded(const RTCOccludedFunctionNArguments* args)
{
    const unsigned n = args->N;
    const bool transmits = static_cast<const RootQuadric*>(args->geometryUserPtr)[args->primID].transmits;
    for (unsigned i = 0; i < n; ++i)
        if (args->valid[i] && nearest(args->geometryUserPtr, args->primID, args->ray, n, i) < infinity &&
            !(transmits && note_passing(args->context, args->ray, n, i)))
            RTCRayN_tfar(args->ray, n, i) = -infinity;  // Embree's sign that something was met
}

void bounds(const RTCBoundsFunctionArguments* args)
{
    const DAabb& box = static_cast<const RootQuadric*>(args->geometryUserPtr)[args->primID].bounds;
    // Embree walks in float: give way for the rounding of its slab test, relative to the largest coordinate.
    const glm::dvec3 largest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
    const double pad = 1e-6 * std::max({largest.x, largest.y, largest.z});
    RTCBounds& out = *args->bounds_o;
    out.lower_x = static_cast<float>(box.lo.x - pad);
    out.lower_y = static_cast<float>(box.lo.y - pad);
    out.lower_z = static_cast<float>(box.lo.z - pad);
    out.upper_x = static_cast<float>(box.hi.x + pad);
    out.upper_y = static_cast<float>(box.hi.y + pad);
    out.upper_z = static_cast<float>(box.hi.z + pad);
}

}  // namespace

void set_quadrics(RTCGeometry geometry, const std::vector<RootQuadric>& quadrics)
{
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(quadrics.size()));
    rtcSetGeometryUserData(geometry, const_cast<RootQuadric*>(quadrics.data()));  // only read
    rtcSetGeometryBoundsFunction(geometry, &bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &intersect);
    rtcSetGeometryOccludedFunction(geometry, &occluded);
}

}  // namespace firstray::peers
