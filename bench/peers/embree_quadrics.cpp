#include "bench/peers/embree_quadrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace firstray::peers {
namespace {

struct DRay {
    glm::dvec3 origin, direction;
};

struct Roots {
    double t[2];  ///< in order; NaN where the line misses
};

/// Roots of a t^2 + 2 b t + c, without cancellation.
Roots solve(double a, double b, double c)
{
    const double q = -(b + std::copysign(std::sqrt(b * b - a * c), b));
    return {{std::min(q / a, c / q), std::max(q / a, c / q)}};
}

/// Radius of the surface about its z axis, as a line r + slope z. A sphere is handled beside it.
double radius_at(const PlacedQuadric& quadric, double z)
{
    return quadric.r0 + (quadric.r1 - quadric.r0) * z;
}

Roots crossings(const PlacedQuadric& quadric, const DRay& ray)
{
    const glm::dvec3 &p = ray.origin, &d = ray.direction;
    if (quadric.kind == Quadric::Kind::sphere) return solve(glm::dot(d, d), glm::dot(p, d), glm::dot(p, p) - 1.0);
    const double slope = quadric.r1 - quadric.r0, r = radius_at(quadric, p.z), dr = slope * d.z;
    return solve(d.x * d.x + d.y * d.y - dr * dr, p.x * d.x + p.y * d.y - r * dr, p.x * p.x + p.y * p.y - r * r);
}

/// Whether the quadric is there and visible where the ray crosses its surface.
bool visible_at(const PlacedQuadric& quadric, const DRay& ray, double t)
{
    const glm::dvec3 p = ray.origin + t * ray.direction, &d = ray.direction;
    const bool sphere = quadric.kind == Quadric::Kind::sphere;
    if (!sphere && !(p.z >= 0.0 && p.z <= 1.0)) return false;
    if (!quadric.inside_only) return true;
    const double slope = quadric.r1 - quadric.r0;
    const double gradient_z = sphere ? p.z : -slope * radius_at(quadric, p.z);
    return p.x * d.x + p.y * d.y + gradient_z * d.z > 0.0;  // on its way out
}

/// The nearest visible crossing in (t_min, t_max), or infinity.
double nearest(const PlacedQuadric& quadric, const DRay& body_ray, double t_min, double t_max)
{
    // Starting where the line is nearest to the quadric's own origin: far rays would lose the surface in rounding.
    DRay ray{quadric.quadric_from_body.point(body_ray.origin), quadric.quadric_from_body.vector(body_ray.direction)};
    const double start = -glm::dot(ray.origin, ray.direction) / glm::dot(ray.direction, ray.direction);
    ray.origin += start * ray.direction;
    for (const double t : crossings(quadric, ray).t)
        if (start + t > t_min && start + t < t_max && visible_at(quadric, ray, t)) return start + t;
    return std::numeric_limits<double>::infinity();
}

/// Embree calls with N = 1 for the single rays that the peers trace.
struct Lane {
    RTCRayN* ray;
    const PlacedQuadric& quadric;

    double search() const
    {
        const DRay body_ray{{RTCRayN_org_x(ray, 1, 0), RTCRayN_org_y(ray, 1, 0), RTCRayN_org_z(ray, 1, 0)},
                            {RTCRayN_dir_x(ray, 1, 0), RTCRayN_dir_y(ray, 1, 0), RTCRayN_dir_z(ray, 1, 0)}};
        return nearest(quadric, body_ray, RTCRayN_tnear(ray, 1, 0), RTCRayN_tfar(ray, 1, 0));
    }
};

const PlacedQuadric& quadric_of(void* user, unsigned index)
{
    return static_cast<const PlacedQuadric*>(user)[index];
}

void intersect(const RTCIntersectFunctionNArguments* args)
{
    if (!args->valid[0]) return;
    RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, 1);
    const double t = Lane{ray, quadric_of(args->geometryUserPtr, args->primID)}.search();
    if (!(static_cast<float>(t) < RTCRayN_tfar(ray, 1, 0))) return;
    RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, 1);
    RTCRayN_tfar(ray, 1, 0) = static_cast<float>(t);
    RTCHitN_u(hit, 1, 0) = RTCHitN_v(hit, 1, 0) = 0.0f;
    RTCHitN_primID(hit, 1, 0) = args->primID;
    RTCHitN_geomID(hit, 1, 0) = args->geomID;
    RTCHitN_instID(hit, 1, 0, 0) = args->context->instID[0];
}

void occluded(const RTCOccludedFunctionNArguments* args)
{
    if (!args->valid[0]) return;
    const double t = Lane{args->ray, quadric_of(args->geometryUserPtr, args->primID)}.search();
    if (std::isfinite(t)) RTCRayN_tfar(args->ray, 1, 0) = -std::numeric_limits<float>::infinity();  // Embree's "met"
}

/// The box of a disc (or, with three axes, of a ball) carried by `linear`: half its extent along each world axis.
glm::dvec3 half_extent(const glm::dmat3& linear, int axes)
{
    glm::dvec3 squares{0.0};
    for (int axis = 0; axis < axes; ++axis) squares += linear[axis] * linear[axis];
    return glm::sqrt(squares);
}

DAabb box_of(const PlacedQuadric& quadric)
{
    const Transform& place = quadric.body_from_quadric;
    DAabb box;
    const auto grow = [&](const glm::dvec3& centre, const glm::dvec3& half) {
        box.grow(centre - half);
        box.grow(centre + half);
    };
    if (quadric.kind == Quadric::Kind::sphere) {
        grow(place.offset, half_extent(place.linear, 3));
    } else {
        const glm::dvec3 disc = half_extent(place.linear, 2);
        grow(place.offset, quadric.r0 * disc);
        grow(place.offset + place.linear[2], quadric.r1 * disc);
    }
    return box;
}

void bounds(const RTCBoundsFunctionArguments* args)
{
    const DAabb box = box_of(quadric_of(args->geometryUserPtr, args->primID));
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

PlacedQuadric place(const Quadric& quadric, const Transform& body_from_group)
{
    const Transform body_from_quadric = body_from_group * quadric.group_from_quadric;
    return {quadric.kind, quadric.inside_only, quadric.r0, quadric.r1, body_from_quadric, inverse(body_from_quadric)};
}

void set_quadrics(RTCGeometry geometry, const std::vector<PlacedQuadric>& quadrics)
{
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(quadrics.size()));
    rtcSetGeometryUserData(geometry, const_cast<PlacedQuadric*>(quadrics.data()));  // only read
    rtcSetGeometryBoundsFunction(geometry, &bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &intersect);
    rtcSetGeometryOccludedFunction(geometry, &occluded);
}

}  // namespace firstray::peers
