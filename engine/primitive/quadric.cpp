#include "engine/primitive/quadric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace firstray::inline v0 {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A ray in the quadric's own system; its origin has been moved to where it is nearest to the system's origin, at
/// `shift` along the ray: the quadratic's coefficients then do not cancel, however far away the ray starts.
struct LocalRay {
    glm::dvec3 origin, direction;
    double shift;
};

/// Moves a ray that starts so far away that its place in the quadric's system would be blurred close to the quadric:
/// along the ray and with one rounding, so that it stays on it. Returns t of where it starts now.
double go_near(const DAabb& bounds, const glm::dvec3& direction, glm::dvec3& start)
{
    constexpr double far_away = 0x1p25;  // sizes: double then tells places to a 2^28th of the size
    const glm::dvec3 size = bounds.size(), way = 0.5 * (bounds.lo + bounds.hi) - start;
    const auto largest = [](const glm::dvec3& v) {
        return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
    };
    if (!(largest(way) > far_away * largest(size))) return 0.0;
    const double t = glm::dot(way, direction) / glm::dot(direction, direction);
    if (!std::isfinite(t)) return 0.0;
    for (int axis = 0; axis < 3; ++axis) start[axis] = std::fma(t, direction[axis], start[axis]);
    return t;
}

LocalRay to_local(const RootQuadric& q, const glm::dvec3& origin, const glm::dvec3& direction)
{
    glm::dvec3 start = origin;
    const double gone = go_near(q.bounds, direction, start);
    const glm::dvec3 o = q.quadric_from_root.point(start), d = q.quadric_from_root.vector(direction);
    const double squared = glm::dot(d, d);
    const double shift = squared > 0.0 ? -glm::dot(o, d) / squared : 0.0;
    return {o + shift * d, d, gone + shift};
}

/// Both roots of a t^2 + 2 b t + c = 0, smaller first; infinities where there are none.
std::pair<double, double> roots(double a, double b, double c)
{
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0)) return {infinity, infinity};
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    const double first = a != 0.0 ? q / a : infinity, second = q != 0.0 ? c / q : first;
    return std::minmax(first, second);
}

std::pair<double, double> sphere_roots(const LocalRay& ray)
{
    return roots(glm::dot(ray.direction, ray.direction), glm::dot(ray.origin, ray.direction),
                 glm::dot(ray.origin, ray.origin) - 1.0);
}

std::pair<double, double> cone_roots(const LocalRay& ray, double r0, double growth)
{
    const glm::dvec3 &o = ray.origin, &d = ray.direction;
    const double radius = r0 + growth * o.z, change = growth * d.z;
    return roots(d.x * d.x + d.y * d.y - change * change, o.x * d.x + o.y * d.y - radius * change,
                 o.x * o.x + o.y * o.y - radius * radius);
}

/// The outward direction at a point of the surface, any length, in the quadric's own system.
glm::dvec3 outward(const Quadric& q, const glm::dvec3& p)
{
    if (q.kind == Quadric::Kind::sphere) return p;
    const double growth = q.r1 - q.r0;
    return {p.x, p.y, -growth * (q.r0 + growth * p.z)};
}

bool is_on_surface(const Quadric& q, const glm::dvec3& p)
{
    return q.kind == Quadric::Kind::sphere || (p.z >= 0.0 && p.z <= 1.0);
}

}  // namespace

RootQuadric place_quadric(const Quadric& shape, const Transform& root_from_group, PrimitiveId id, bool transmits)
{
    const Transform root_from_quadric = root_from_group * shape.group_from_quadric;
    RootQuadric placed{shape, inverse(root_from_quadric), {}, id, transmits};
    // A circle of radius r about the third axis, or a unit ball, reaches as far along a root axis as the row's length.
    const auto grow_circle = [&](double z, double r, double r_z) {
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dmat3& m = root_from_quadric.linear;
            const double reach = std::sqrt(r * r * (m[0][axis] * m[0][axis] + m[1][axis] * m[1][axis]) +
                                           r_z * r_z * m[2][axis] * m[2][axis]);
            const double centre = root_from_quadric.offset[axis] + z * m[2][axis];
            placed.bounds.lo[axis] = std::min(placed.bounds.lo[axis], centre - reach);
            placed.bounds.hi[axis] = std::max(placed.bounds.hi[axis], centre + reach);
        }
    };
    if (shape.kind == Quadric::Kind::sphere) {
        grow_circle(0.0, 1.0, 1.0);
    } else {
        grow_circle(0.0, std::abs(shape.r0), 0.0);
        grow_circle(1.0, std::abs(shape.r1), 0.0);
    }
    if (!(largest_coordinate(placed.bounds) <= farthest_place)) placed.bounds = {};
    return placed;
}

double intersect(const RootQuadric& placed, const glm::dvec3& origin, const glm::dvec3& direction, double t_min,
                 double t_max)
{
    if (placed.bounds.empty()) return infinity;
    const Quadric& q = placed.quadric;
    const LocalRay ray = to_local(placed, origin, direction);
    const auto [near, far] = q.kind == Quadric::Kind::sphere ? sphere_roots(ray) : cone_roots(ray, q.r0, q.r1 - q.r0);
    for (const double root : {near, far}) {
        const double t = root + ray.shift;
        if (!(t > t_min && t < t_max) || !std::isfinite(t)) continue;
        const glm::dvec3 p = ray.origin + root * ray.direction;
        if (!is_on_surface(q, p)) continue;
        if (q.inside_only && glm::dot(outward(q, p), ray.direction) <= 0.0) continue;
        return t;
    }
    return infinity;
}

}  // namespace firstray::inline v0
