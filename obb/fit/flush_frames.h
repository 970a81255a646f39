#pragma once
#include <vector>

#include "obb/fit/frame.h"

namespace firstray::inline v0::obb {

/// Frames with two neighbouring sides that each lie flush with an edge of the points' hull, as a smallest box has:
/// while contacts stay the same, the area's second derivative by a turn about one of the box's axes is negative
/// wherever its first is zero, so at a minimum every such turn must be blocked. Tries all pairs of edges, each at some
/// of the angles that it leaves free. Its time grows with the fifth power of the number of points.
/// points   at least one, not in a plane
/// axes     of a box that suits the points' overall shape
/// returns  at most `count`, the best first
/// source   for the volume: J. O'Rourke, "Finding Minimal Enclosing Boxes", 1985
std::vector<Frame> flush_frames(const PointSet& points, const glm::dmat3& axes, std::size_t count);

}  // namespace firstray::inline v0::obb
