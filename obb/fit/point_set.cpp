#include "obb/fit/point_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace firstray::inline v0::obb {
namespace {

constexpr std::size_t few_points = 32;     ///< not worth choosing from
constexpr std::size_t many_points = 4096;  ///< more than there are cones below
constexpr int cones_per_side = 24;         ///< of a cube around the points
constexpr double least_thickness = 1e-9;   ///< relative to the longest side; what is thinner counts as flat

/// The i-th of `count` directions that cover a hemisphere evenly, along a Fibonacci spiral.
glm::dvec3 spread_direction(int i, int count)
{
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = (i + 0.5) / count, r = std::sqrt(1.0 - z * z);
    return {r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z};
}

/// Which cone from the origin a point of the cube's space lies in.
std::size_t cone_of(const glm::dvec3& p)
{
    const glm::dvec3 size = glm::abs(p);
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    if (!(size[axis] > 0.0)) return 0;
    const auto cell = [&](double v) {
        return std::min(static_cast<int>((v / size[axis] + 1.0) * (cones_per_side / 2)), cones_per_side - 1);
    };
    const int side = 2 * axis + (p[axis] < 0.0);
    return static_cast<std::size_t>((side * cones_per_side + cell(p[(axis + 1) % 3])) * cones_per_side +
                                    cell(p[(axis + 2) % 3]));
}

}  // namespace

glm::dmat3 cube_from_world(const glm::dmat3& axes, const DAabb& box)
{
    const glm::dvec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z, 1e-300});
    const glm::dvec3 unit = glm::max(size, glm::dvec3(longest * least_thickness));
    return glm::transpose(glm::dmat3(axes[0] / unit.x, axes[1] / unit.y, axes[2] / unit.z));
}

void PointSet::reserve(std::size_t count)
{
    x.reserve(count);
    y.reserve(count);
    z.reserve(count);
}

void PointSet::push_back(const glm::dvec3& p)
{
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
}

DAabb bounds_along(const PointSet& points, const glm::dmat3& axes)
{
    DAabb box;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 p = points[i];
        box.grow(glm::dvec3(glm::dot(p, axes[0]), glm::dot(p, axes[1]), glm::dot(p, axes[2])));
    }
    return box;
}

double width_along(const PointSet& points, const glm::dvec3& direction)
{
    // two at a time: otherwise each waits for the comparison before
    const std::size_t last = points.size() - 1;
    double least = glm::dot(points[last], direction), most = least, other_least = least, other_most = least;
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        const double at = glm::dot(points[i], direction), other = glm::dot(points[i + 1], direction);
        least = at < least ? at : least;
        most = at > most ? at : most;
        other_least = other < other_least ? other : other_least;
        other_most = other > other_most ? other : other_most;
    }
    return std::max(most, other_most) - std::min(least, other_least);
}

ExtremePair extreme_pair(const PointSet& points, const glm::dvec3& direction)
{
    ExtremePair pair;
    double least = glm::dot(points[0], direction), most = least;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double at = glm::dot(points[i], direction);
        if (at < least) least = at, pair.least = i;
        if (at > most) most = at, pair.most = i;
    }
    return pair;
}

PointSet extreme_points(const PointSet& points, const glm::dmat3& axes, int directions)
{
    if (points.size() <= few_points) return points;
    const glm::dmat3 world_from_dual = glm::transpose(cube_from_world(axes, bounds_along(points, axes)));
    std::vector<std::size_t> chosen;
    for (int i = 0; i < directions; ++i) {
        const ExtremePair pair = extreme_pair(points, world_from_dual * spread_direction(i, directions));
        chosen.insert(chosen.end(), {pair.least, pair.most});
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    PointSet extremes;
    extremes.reserve(chosen.size());
    for (const std::size_t i : chosen) extremes.push_back(points[i]);
    return extremes;
}

PointSet outer_points(const PointSet& points, const glm::dmat3& axes)
{
    if (points.size() <= many_points) return points;
    struct Farthest {
        double distance = -1.0;
        std::size_t index = 0;
    };
    const DAabb box = bounds_along(points, axes);
    const glm::dmat3 cube = cube_from_world(axes, box);
    const glm::dvec3 middle = axes * ((box.lo + box.hi) * 0.5);
    std::vector<Farthest> farthest(6 * cones_per_side * cones_per_side);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 p = cube * (points[i] - middle);
        Farthest& in_cone = farthest[cone_of(p)];
        const double distance = glm::dot(p, p);
        if (distance > in_cone.distance) in_cone = {distance, i};
    }
    PointSet outer;
    outer.reserve(farthest.size());
    for (const Farthest& f : farthest)
        if (f.distance >= 0.0) outer.push_back(points[f.index]);
    return outer;
}

}  // namespace firstray::inline v0::obb
