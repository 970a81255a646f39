#include "engine/primitive/triangle.h"

#include "engine/primitive/exact.h"

namespace firstray {
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
    const glm::dvec3 apart = glm::abs(triangle.v[0] - origin), along = glm::abs(direction);
    const double distance = std::max(std::max(apart.x, apart.y), apart.z) + triangle.edge;
    const double length = std::max(std::max(along.x, along.y), along.z);
    const double error = side_error<double> * (triangle.edge * distance * length);
    const auto& v = triangle.v;
    const int u = side_sign(s.u, error, v[1], v[2], origin, direction);
    const int w = side_sign(s.w, error, v[0], v[1], origin, direction);
    const int vv = side_sign(s.v, error, v[2], v[0], origin, direction);
    const bool positive = u >= 0 && vv >= 0 && w >= 0, negative = u <= 0 && vv <= 0 && w <= 0;
    return positive != negative;  // both: the ray lies in the triangle's plane, or the triangle has no area
}

TriangleHit<double> place_hit(const RootTriangle<double>& triangle, const TriangleSides<double>& s,
                              const glm::dvec3& origin, const glm::dvec3& direction)
{
    const double sum = (s.u + s.v) + s.w;
    const double u = sum != 0.0 ? s.v / sum : 1.0 / 3, v = sum != 0.0 ? s.w / sum : 1.0 / 3;
    const double squared = glm::dot(direction, direction);
    double t_corner[3];
    for (int corner = 0; corner < 3; ++corner)
        t_corner[corner] = glm::dot(triangle.v[corner] - origin, direction) / squared;
    const auto [nearest, farthest] = std::minmax({t_corner[0], t_corner[1], t_corner[2]});
    double t = s.height / s.slope;
    if (!std::isfinite(t)) t = (1.0 - u - v) * t_corner[0] + u * t_corner[1] + v * t_corner[2];
    return {true, std::clamp(t, nearest, farthest), u, v};
}

}  // namespace

TriangleHit<double> intersect(const RootTriangle<double>& triangle, const glm::dvec3& origin,
                              const glm::dvec3& direction)
{
    const TriangleSides<double> s = triangle_sides(triangle.v, origin, direction);
    if (!passes_inside(triangle, s, origin, direction)) return {};
    return place_hit(triangle, s, origin, direction);
}

TriangleHit<float> intersect_in_double(const RootTriangle<float>& triangle, const glm::vec3& origin,
                                       const glm::vec3& direction, bool inside_known)
{
    const RootTriangle<double> exact = {
        {glm::dvec3(triangle.v[0]), glm::dvec3(triangle.v[1]), glm::dvec3(triangle.v[2])}, triangle.edge};
    const glm::dvec3 o(origin), d(direction);
    const TriangleSides<double> s = triangle_sides(exact.v, o, d);
    if (!inside_known && !passes_inside(exact, s, o, d)) return {};
    const TriangleHit<double> hit = place_hit(exact, s, o, d);
    return {true, static_cast<float>(hit.t), static_cast<float>(hit.u), static_cast<float>(hit.v)};
}

}  // namespace firstray
