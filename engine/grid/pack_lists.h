#pragma once
#include <span>

#include "engine/grid/bin.h"
#include "engine/grid/entry_kernels.h"
#include "engine/grid/grid.h"

namespace firstray::inline v0 {

/// A voxel's entries and box, waiting to be put into packs.
struct ListToFill {
    std::span<const std::uint32_t> entries;
    Aabb box;
};

Aabb cell_box(const Grid& grid, std::uint32_t cell);
Aabb clipped(const Aabb& box, const Aabb& to);

/// Room that lists need in a structure, counted before it is made.
struct PackCounts {
    std::uint32_t packs = 0, boxes = 0, quadrics = 0;
};

/// The places in a structure, behind those counted already, of a list of these entries.
VoxelList reserve_list(std::span<const std::uint32_t> listed, const GridEntries& entries, PackCounts& counts);

std::span<const std::uint32_t> triangles_of(const VoxelList& list, const ListToFill& to_fill);

/// Puts a list's entries into its places, which must exist, and notes what they are. Different lists may be filled at
/// the same time.
/// triangles  triangles_of(list, to_fill), placed
void fill_list(VoxelList& list, const ListToFill& to_fill, const PlacedTriangles& triangles, const GridEntries& entries,
               PackOrder order, GridStructure& structure);

}  // namespace firstray::inline v0
