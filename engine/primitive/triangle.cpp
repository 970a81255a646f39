#include "engine/primitive/triangle.h"

#include "engine/primitive/exact.h"

namespace firstray::inline v0 {
namespace {

/// -1, 0 or 1: the side on which the ray passes the edge from `from` to `to`, given the rounded value.
int side_sign(double side, double error, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& origin,
              const glm::dvec3& direction)
{
    if (error >= least_bound<double> && side > error) return 1;
    if (error >= least_bound<double> && side < -error) return -1;
    return exact_side(to, from, origin, direction);
}

bool passes_inside(const RootTriangle<double>& triangle, const TriangleSides<double>& s, const glm::dvec3& origin,
                   const glm::dvec3& direction)
{
    const double distance = largest_component<double>(triangle.v[0] - origin) + triangle.edge;
    const double length = largest_component<double>(direction);
    const double error = side_error<double> * (triangle.edge * distance * length);
    const auto& v = triangle.v;
    const int u = side_sign(s.u, error, v[1], v[2], origin, direction);
    const int vv = side_sign(s.v, error, v[2], v[0], origin, direction);
    const int w = side_sign(s.w, error, v[0], v[1], origin, direction);
    const bool positive = u >= 0 && vv >= 0 && w >= 0, negative = u <= 0 && vv <= 0 && w <= 0;
    return positive != negative;  // both: the ray lies in the triangle's plane, or the triangle has no area
}

double plane_t(const RootTriangle<double>& triangle, const glm::dvec3& origin, const glm::dvec3& direction)
{
    const TrianglePlane<double> plane = triangle_plane(triangle.v, origin, direction, 1.0);
    const double t = plane.height / plane.slope;
    if (plane.is_sloped(largest_component<double>(direction))) return t;
    double t_corner[3];
    for (int corner = 0; corner < 3; ++corner)
        t_corner[corner] = glm::dot(triangle.v[corner] - origin, direction) / glm::dot(direction, direction);
    const auto [nearest, farthest] = std::minmax({t_corner[0], t_corner[1], t_corner[2]});
    return std::isfinite(t) ? std::clamp(t, nearest, farthest) : nearest;
}

}  // namespace

TriangleHit<double> intersect(const RootTriangle<double>& triangle, const glm::dvec3& origin,
                              const glm::dvec3& direction, const HitRange<double>& range)
{
    const double t = plane_t(triangle, origin, direction);
    if (!range.contains(t)) return {};
    const TriangleSides<double> s = triangle_sides(triangle.v, origin, direction);
    if (!passes_inside(triangle, s, origin, direction)) return {};
    const double sum = (s.u + s.v) + s.w;
    return sum != 0.0 ? TriangleHit<double>{true, t, s.v / sum, s.w / sum}
                      : TriangleHit<double>{true, t, 1.0 / 3, 1.0 / 3};
}

float plane_t_in_double(const RootTriangle<float>& triangle, const glm::vec3& origin, const glm::vec3& direction)
{
    return static_cast<float>(plane_t(widened(triangle), glm::dvec3(origin), glm::dvec3(direction)));
}

bool passes_inside_exactly(const RootTriangle<float>& triangle, const glm::vec3& origin, const glm::vec3& direction,
                           float& u, float& v)
{
    const RootTriangle<double> wide = widened(triangle);
    const glm::dvec3 o(origin), d(direction);
    const TriangleSides<double> s = triangle_sides(wide.v, o, d);
    if (!passes_inside(wide, s, o, d)) return false;
    const double sum = (s.u + s.v) + s.w;
    u = static_cast<float>(sum != 0.0 ? s.v / sum : 1.0 / 3);
    v = static_cast<float>(sum != 0.0 ? s.w / sum : 1.0 / 3);
    return true;
}

}  // namespace firstray::inline v0
