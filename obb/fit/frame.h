#pragma once
#include <glm/glm.hpp>

#include "obb/fit/point_set.h"

namespace firstray::inline v0::obb {

/// A box's axes (columns: orthonormal, right-handed) and what the search minimises.
struct Frame {
    glm::dmat3 axes{1.0};
    double cost = 0.0;
};

/// Half the surface area of a box of this size.
inline double cost_of(const glm::dvec3& size)
{
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

inline bool cheaper(const Frame& a, const Frame& b)
{
    return a.cost < b.cost;
}

/// The box of `points`, at least one, along `axes`.
inline Frame frame_along(const PointSet& points, const glm::dmat3& axes)
{
    return {axes, cost_of(bounds_along(points, axes).size())};
}

/// Any unit vector at right angles to a unit vector.
glm::dvec3 any_perpendicular(const glm::dvec3& v);

/// Axes along `edge` and across it towards `across`, both of any length, zero and parallel included.
glm::dmat3 axes_along(const glm::dvec3& edge, const glm::dvec3& across);

/// Axes turned about `turn`, given in their own system; its length is the tangent of half the angle.
glm::dmat3 turned(const glm::dmat3& axes, const glm::dvec3& turn);

/// How far to turn about each axis of a box of this size, as turned(), to pass by every frame that may be smaller: thin
/// boxes are turned little where that would thicken them much, cubes by up to 45 degrees.
glm::dvec3 turn_range(const glm::dvec3& size);

}  // namespace firstray::inline v0::obb
