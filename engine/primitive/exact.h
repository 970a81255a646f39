#pragma once
#include <glm/glm.hpp>

namespace firstray::inline v0 {

/// The exact sign (-1, 0 or 1) of det(a - origin, b - origin, direction): on which side of the ray's line the edge from
/// a to b passes. Exactly opposite when a and b change places. Slow (microseconds); for what filters cannot decide.
/// Exact while no product of three of the numbers leaves the range of double; floats below 1e38 always qualify.
/// source  J. Shewchuk, "Adaptive Precision Floating-Point Arithmetic", DCG 18(3), 1997 (expansions)
int exact_side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace firstray::inline v0
