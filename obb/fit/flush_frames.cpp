#include "obb/fit/flush_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace firstray::inline v0::obb {
namespace {

/// Of the half turn that a side flush with one edge can make, with few edges and with more.
constexpr int many_angles = 48, some_angles = 16;
constexpr std::size_t few_edges = 15;

/// Whether an edge and some third point span a plane that has all points on one side.
bool is_hull_edge(const PointSet& points, std::size_t from, std::size_t to)
{
    const glm::dvec3 edge = points[to] - points[from];
    for (std::size_t third = 0; third < points.size(); ++third) {
        if (third == from || third == to) continue;
        const glm::dvec3 normal = glm::cross(edge, points[third] - points[from]);
        const double slack = 1e-9 * glm::dot(normal, normal);
        double least = 0.0, most = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double side = glm::dot(normal, points[i] - points[from]);
            least = std::min(least, side);
            most = std::max(most, side);
        }
        if (least >= -slack || most <= slack) return true;
    }
    return false;
}

/// Directions of the edges of the points' hull, and perhaps of more where points are coplanar; parallel ones once.
std::vector<glm::dvec3> hull_edges(const PointSet& points)
{
    std::vector<glm::dvec3> edges;
    for (std::size_t from = 0; from < points.size(); ++from)
        for (std::size_t to = from + 1; to < points.size(); ++to) {
            const double length = glm::length(points[to] - points[from]);
            if (!(length > 0.0)) continue;
            const glm::dvec3 edge = (points[to] - points[from]) / length;
            const auto is_parallel = [&](const glm::dvec3& other) {
                return glm::length(glm::cross(edge, other)) < 1e-9;
            };
            if (std::none_of(edges.begin(), edges.end(), is_parallel) && is_hull_edge(points, from, to))
                edges.push_back(edge);
        }
    return edges;
}

/// The best of the sampled frames that are flush with two edges.
Frame best_flush_frame(const PointSet& points, const glm::dmat3& cube, const glm::dvec3& a, const glm::dvec3& b,
                       int angles)
{
    Frame best{glm::dmat3(1.0), std::numeric_limits<double>::infinity()};
    // spread in the space where the points' box is a cube: normals go back by the transpose
    const glm::dvec3 a_cube = glm::normalize(cube * a), u_cube = any_perpendicular(a_cube);
    const glm::dvec3 u = u_cube * cube, v = glm::cross(a_cube, u_cube) * cube;
    for (int i = 0; i < angles; ++i) {
        const double angle = std::numbers::pi * i / angles;
        const glm::dvec3 first = glm::normalize(std::cos(angle) * u + std::sin(angle) * v);
        const glm::dvec3 second = glm::cross(first, b);
        const double length = glm::length(second);
        if (length < 1e-3) continue;
        const Frame frame = frame_along(points, {first, second / length, glm::cross(first, second) / length});
        if (frame.cost < best.cost) best = frame;
    }
    return best;
}

}  // namespace

std::vector<Frame> flush_frames(const PointSet& points, const glm::dmat3& axes, std::size_t count)
{
    const glm::dmat3 cube = cube_from_world(axes, bounds_along(points, axes));
    const std::vector<glm::dvec3> edges = hull_edges(points);
    const int angles = edges.size() <= few_edges ? many_angles : some_angles;
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t k = i; k < edges.size(); ++k)
            frames.push_back(best_flush_frame(points, cube, edges[i], edges[k], angles));
    std::sort(frames.begin(), frames.end(), cheaper);
    if (frames.size() > count) frames.resize(count);
    return frames;
}

}  // namespace firstray::inline v0::obb
