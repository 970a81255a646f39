#pragma once
#include "obb/fit/near_points.h"

namespace firstray::inline v0::obb {

/// Improves a frame along the valleys of the cost, where descend() stalls: turns the box so that two of the hull's
/// edges that it nearly touches lie flush with its sides, and stay so.
/// points   around axes near start's; start's cost is theirs
/// returns  a frame that is no worse
Frame slide(const NearPoints& points, const Frame& start);

}  // namespace firstray::inline v0::obb
