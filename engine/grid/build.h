#pragma once
#include <cstdint>

#include "engine/core/executor.h"
#include "engine/grid/grid.h"
#include "engine/strategy/root_geometry.h"

namespace firstray {

/// What shapes a grid.
struct GridOptions {
    float density = 0.15f;     ///< cells of the top grid per primitive, > 0
    float subdensity = 0.25f;  ///< cells of a subgrid per primitive in it, > 0
    int max_list = 1024;       ///< a voxel with more primitives gets a subgrid, if that makes progress
    int depth = 3;             ///< levels of grids, >= 1
};

/// Builds the recursive grid over all primitives of `geometry`, anew. The result does not depend on the executor.
/// peak_bytes  raised to the most memory held at any time while building, the result included
template <typename Real>
GridStructure build_grid(const RootGeometry<Real>& geometry, const GridOptions& options, const Executor* executor,
                         std::uint64_t& peak_bytes);

}  // namespace firstray
