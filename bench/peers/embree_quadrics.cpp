#include "bench/peers/embree_quadrics.h"

#include <algorithm>
#include <limits>

namespace firstray::peers {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The nearest t in (tnear, tfar] along the one ray that Embree hands over (peers trace single rays), or infinity.
float nearest(void* user, unsigned index, RTCRayN* ray)
{
    const RootQuadric& quadric = static_cast<const RootQuadric*>(user)[index];
    const glm::dvec3 origin(RTCRayN_org_x(ray, 1, 0), RTCRayN_org_y(ray, 1, 0), RTCRayN_org_z(ray, 1, 0));
    const glm::dvec3 direction(RTCRayN_dir_x(ray, 1, 0), RTCRayN_dir_y(ray, 1, 0), RTCRayN_dir_z(ray, 1, 0));
    const auto t = static_cast<float>(firstray::intersect(quadric, origin, direction,
                                                          static_cast<double>(RTCRayN_tnear(ray, 1, 0)),
                                                          std::numeric_limits<double>::infinity()));
    return t <= RTCRayN_tfar(ray, 1, 0) ? t : infinity;
}

void intersect(const RTCIntersectFunctionNArguments* args)
{
    if (!args->valid[0]) return;
    RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, 1);
    const float t = nearest(args->geometryUserPtr, args->primID, ray);
    if (t == infinity) return;
    RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, 1);
    RTCRayN_tfar(ray, 1, 0) = t;
    RTCHitN_u(hit, 1, 0) = RTCHitN_v(hit, 1, 0) = 0.0f;
    RTCHitN_primID(hit, 1, 0) = args->primID;
    RTCHitN_geomID(hit, 1, 0) = args->geomID;
    RTCHitN_instID(hit, 1, 0, 0) = args->context->instID[0];
}

void occluded(const RTCOccludedFunctionNArguments* args)
{
    if (!args->valid[0]) return;
    if (nearest(args->geometryUserPtr, args->primID, args->ray) < infinity)
        RTCRayN_tfar(args->ray, 1, 0) = -infinity;  // Embree's sign that something was met
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
