#pragma once
#include <cstdint>

#include "engine/core/executor.h"
#include "engine/grid/bin.h"
#include "engine/grid/grid.h"
#include "engine/grid/pack_lists.h"
#include "engine/strategy/root_geometry.h"
#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// What shapes a grid.
struct GridOptions {
    float density = 0.15f;     ///< cells of the top grid per primitive, > 0
    float subdensity = 0.25f;  ///< cells of a subgrid per primitive in it, > 0
    int max_list = 1024;       ///< a voxel with more primitives gets a subgrid, if that makes progress
    int depth = 3;             ///< levels of grids, >= 1
    PackOrder order = PackOrder::along_curve;  ///< by_surface pays in grids that are kept
};

/// The shape that the user chose, defaults filled in.
GridOptions grid_options(const StrategyOptions& options);

/// What building works with; its memory is used again.
struct BuildScratch {
    BinScratch bin;
    RawVector<std::uint32_t> chosen;  ///< entries that go into cells
    CellLists top;
    std::vector<ListToFill> to_fill;
    std::uint64_t bytes() const;
};

/// Builds the recursive grid over entries, in their own system, anew. The result does not depend on the executor.
/// executor    null: on this thread
/// into        what it held before is gone, its memory is used again
/// peak_bytes  raised to the most memory held at any time while building, entries and result included
void build_grid(GridEntries& entries, const GridOptions& options, const Executor* executor, BuildScratch& scratch,
                GridStructure& into, std::uint64_t& peak_bytes);
GridStructure build_grid(GridEntries entries, const GridOptions& options, const Executor* executor,
                         std::uint64_t& peak_bytes);

/// The top grid of build_grid alone. In its structure stands only what is kept out of the cells; the word of a cell
/// where something is listed is list(cell).
struct TopGrid {
    GridStructure structure;
    CellLists lists;         ///< by cell
    double allowance = 0.0;  ///< references that a reference may become in subgrids
};
TopGrid build_top(GridEntries& entries, const GridOptions& options, const Executor* executor);

/// What build_grid puts into a cell of the top grid, as a structure of its own in the same system: a subgrid, or one
/// cell where there are too few entries or nothing is gained. Any number of threads.
GridStructure build_voxel(const TopGrid& top, std::uint32_t cell, const GridEntries& entries,
                          const GridOptions& options);

}  // namespace firstray::inline v0
