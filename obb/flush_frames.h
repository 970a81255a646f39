#pragma once
#include <vector>

#include "obb/frame.h"

namespace firstray::obb {

/// A smallest box has two neighbouring sides that each lie flush with an edge of the points' hull. (J. O'Rourke,
/// "Finding Minimal Enclosing Boxes", 1985, for the volume. For the surface, too: if a turn about an axis makes and
/// breaks no contact, the area's second derivative is negative where its first is zero, so every such turn must be
/// blocked.) Tries all pairs of edges, each at some of the angles it leaves free. Its time grows with the fifth power
/// of the points. points   at least one, not in a plane axes     of a box that suits the points' overall shape returns
/// at most `count` frames, the best first
std::vector<Frame> flush_frames(const PointSet& points, const glm::dmat3& axes, std::size_t count);

}  // namespace firstray::obb
