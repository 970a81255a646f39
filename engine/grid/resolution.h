#pragma once
#include <glm/glm.hpp>

#include <cstddef>

namespace firstray::inline v0 {

inline constexpr int max_grid_dim = 1024;

/// Chooses how many cells a grid over a box has along each axis, so that cells are nearly cubes and there are about
/// `density` of them per primitive: d_a * cbrt(density * prim_count / volume) along an axis of length d_a.
/// size        lengths of the box, >= 0; an axis along which it is flat, or flatter than a cell, gets 1 cell, and so do
///             all where a length is not finite
/// prim_count  primitives to hold
/// density     cells per primitive, > 0
/// returns     cells along x, y, z, each in [1, max_grid_dim]
/// source      J. Cleary et al., "Multiprocessor Ray Tracing", Computer Graphics Forum 5(1), 1986; with pinned axes as
/// in
///             T. Ize, P. Shirley, S. Parker, "Grid Creation Strategies for Efficient Ray Tracing", RT 2007
glm::ivec3 choose_grid_dims(const glm::vec3& size, std::size_t prim_count, float density);

}  // namespace firstray::inline v0
