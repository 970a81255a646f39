#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

#include "engine/core/aabb.h"

namespace firstray::inline v0::obb {

/// Points as runs of coordinates, which is what loops over all of them want.
struct PointSet {
    std::vector<double> x, y, z;

    std::size_t size() const { return x.size(); }
    glm::dvec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    void reserve(std::size_t count);
    void push_back(const glm::dvec3& p);
};

/// The two points that lie farthest along and against a direction.
struct ExtremePair {
    std::size_t least = 0, most = 0;
};

/// Bounds of the points in the system of `axes` (columns). Here and in what follows there is at least one point.
DAabb bounds_along(const PointSet& points, const glm::dmat3& axes);

double width_along(const PointSet& points, const glm::dvec3& direction);

ExtremePair extreme_pair(const PointSet& points, const glm::dvec3& direction);

/// The linear map into the space where a box along `axes` is a cube of about unit size, to suit searches of thin sets.
glm::dmat3 cube_from_world(const glm::dmat3& axes, const DAabb& box);

/// The extreme points along directions that are spread evenly in a space where the points' box along `axes` is a cube:
/// thin sets then keep as many points across as along. At most 2 * directions points; all when there are few.
PointSet extreme_points(const PointSet& points, const glm::dmat3& axes, int directions);

/// Leaves out of a large set most points that others stand before, seen from the middle of its box along `axes`: keeps
/// the farthest of every small cone. Small sets come back whole.
PointSet outer_points(const PointSet& points, const glm::dmat3& axes);

}  // namespace firstray::inline v0::obb
