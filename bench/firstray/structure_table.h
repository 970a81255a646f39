#pragma once
#include <span>
#include <string>

#include "bench/measure/frame_stats.h"
#include "engine/strategy/outline.h"

namespace firstray::command {

/// The grids and boxes of an outline, outer before inner, an object each. Subgrids are only counted: in the innermost
/// box, grid or supergrid that they are in.
/// origin  world point that is the root system's (0,0,0)
Json describe_structure(std::span<const StructureBox> outline, const glm::dvec3& origin);

/// The same as aligned lines under a heading, names indented by level.
std::string structure_table(const Json& structure);

}  // namespace firstray::command
