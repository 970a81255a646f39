#pragma once
#include <vector>

#include "obb/fit/frame.h"

namespace firstray::inline v0::obb {

/// Frames along the edges and normals of large triangles between points. Compares all pairs: for small sets.
/// points  at least one
std::vector<Frame> triangle_frames(const PointSet& points);

/// Turns frames in a grid of steps within `range` about `start`, and returns those that are no worse than their
/// neighbours, as far as a table of widths tells: at most `count`, the best first, their costs exact.
/// points  at least one
std::vector<Frame> sweep(const PointSet& points, const Frame& start, const glm::dvec3& range, std::size_t count);

}  // namespace firstray::inline v0::obb
