#pragma once
#include <glm/glm.hpp>

#include <vector>

#include "obb/point_set.h"

namespace firstray::obb {

/// A box's axes (columns: orthonormal, right-handed) and what the search minimises: ab + bc + ca of its sides a, b, c.
struct Frame {
    glm::dmat3 axes{1.0};
    double cost = 0.0;
};

/// The box of `points` along `axes`. points  at least one, as in all of the following
Frame frame_along(const PointSet& points, const glm::dmat3& axes);

/// Frames along the edges and normals of large triangles between points. Compares all pairs: for small sets.
std::vector<Frame> triangle_frames(const PointSet& points);

/// How far to turn about each axis of a box of this size (tangents of half the angles) to pass by every frame that may
/// be smaller: thin boxes are turned little where that would thicken them much, cubes by up to 45 degrees.
glm::dvec3 turn_range(const glm::dvec3& size);

/// Frames turned in a grid of steps within `range` about `start`: those that are no worse than their neighbours, best
/// first.
std::vector<Frame> sweep(const PointSet& points, const Frame& start, const glm::dvec3& range);

/// How a search downhill begins and ends.
struct Descent {
    glm::dvec3 step{0.1};    ///< of the first simplex, as turn_range()
    int evaluations = 100;   ///< at most about so many
    double precision = 0.0;  ///< ends when its frames' costs differ by less, relatively
};

/// Goes downhill from a frame (Nelder and Mead's simplex: the cost has kinks wherever a side is flush with an edge, and
/// the best frames lie in them). returns  a frame that is no worse
Frame descend(const PointSet& points, const Frame& start, const Descent& how);

}  // namespace firstray::obb
