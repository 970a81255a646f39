#pragma once
#include <cstdint>

#include "engine/core/executor.h"
#include "engine/grid/bin.h"
#include "engine/grid/grid.h"
#include "engine/strategy/root_geometry.h"
#include "engine/strategy/strategy.h"

namespace firstray {

/// What shapes a grid.
struct GridOptions {
    float density = 0.15f;     ///< cells of the top grid per primitive, > 0
    float subdensity = 0.25f;  ///< cells of a subgrid per primitive in it, > 0
    int max_list = 1024;       ///< a voxel with more primitives gets a subgrid, if that makes progress
    int depth = 3;             ///< levels of grids, >= 1
};

/// The shape that the user chose, defaults filled in.
GridOptions grid_options(const StrategyOptions& options);

/// Primitives of groups that are carried, in the root system.
template <typename Real>
GridEntries make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor);

/// Appends a triangle; all of them must come before the first quadric.
void add_triangle(GridEntries& entries, const RootTriangle<float>& triangle, PrimitiveId id, bool transmits);
void add_quadric(GridEntries& entries, const RootQuadric& quadric);

/// Builds the recursive grid over entries, in their own system, anew. The result does not depend on the executor.
/// executor    null: on this thread
/// peak_bytes  raised to the most memory held at any time while building, entries and result included
GridStructure build_grid(GridEntries entries, const GridOptions& options, const Executor* executor,
                         std::uint64_t& peak_bytes);

}  // namespace firstray
