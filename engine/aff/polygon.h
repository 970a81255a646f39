#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace firstray::inline v0 {

inline constexpr std::size_t max_concave_corners = 1024;  ///< cutting ears takes up to the cube of it

/// Cuts a planar polygon into triangles, as indices of its corners: a fan from the first corner when it is convex, by
/// cutting ears when it is not. There are always corners - 2 triangles, wound as the polygon is; those of a polygon
/// that is degenerate, not planar or crosses itself cover it as well as may be. corners  at least 3; at most
/// max_concave_corners unless convex
std::vector<glm::uvec3> triangulate(std::span<const glm::dvec3> corners);

bool is_convex(std::span<const glm::dvec3> corners);

}  // namespace firstray::inline v0
