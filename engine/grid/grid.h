#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/aligned.h"
#include "engine/core/ray_tile.h"
#include "engine/primitive/quadric.h"
#include "engine/primitive/triangle_pack.h"

namespace firstray::inline v0 {

/// A box cut into equal cells. Cell (x, y, z) is first_cell + x + dims.x * (y + dims.y * z) of its structure's cells.
struct alignas(16) Grid {
    glm::vec3 lo{0.0f};      ///< lower corner
    float unused_lo = 0.0f;  // the fourth lane of vectors loaded from here: no garbage, which could be slow denormals
    glm::vec3 cell{1.0f};    ///< lengths of a cell, > 0
    float unused_cell = 1.0f;
    glm::ivec3 dims{1};  ///< cells per axis, each in [1, max_grid_dim]
    std::uint32_t first_cell = 0;

    glm::vec3 hi() const { return lo + cell * glm::vec3(dims); }
    /// Length, between those of its sides, of a cell, or of a part of the grid where that is smaller: what is in few
    /// large cells is sorted too.
    float fine_length() const
    {
        constexpr float parts = 16.0f;
        const glm::vec3 size = cell * glm::vec3(dims);
        return std::min(std::cbrt(cell.x * cell.y * cell.z), std::cbrt(size.x * size.y * size.z) / parts);
    }
    std::uint32_t cells() const { return static_cast<std::uint32_t>(dims.x * dims.y * dims.z); }
};

/// What is in a cell: nothing, a list, a grid, or what only the structure's owner knows; one word.
struct CellWord {
    static constexpr std::uint32_t subgrid_bit = 0x80000000u, special_bit = 0x40000000u;
    std::uint32_t bits = 0;

    static CellWord list(std::uint32_t index) { return {index + 1}; }
    static CellWord subgrid(std::uint32_t index) { return {index | subgrid_bit}; }
    static CellWord special(std::uint32_t index) { return {index | special_bit}; }
    bool is_empty() const { return bits == 0; }
    bool is_subgrid() const { return (bits & subgrid_bit) != 0; }
    bool is_special() const { return (bits & special_bit) != 0; }
    std::uint32_t index() const { return bits < special_bit ? bits - 1 : bits & ~(subgrid_bit | special_bit); }
};

/// Packs from which on a voxel's packs have boxes: testing a block of boxes costs about as much as a pack.
inline constexpr std::uint32_t boxed_packs = 2;

/// The primitives of a voxel. Its triangles stand in packs that are spatial clusters with a box each, so that a ray
/// tests sixteen boxes at once and then few packs: a second, cheap level inside the voxel.
struct VoxelList {
    std::uint32_t first_pack = 0, packs = 0;
    std::uint32_t first_boxes = 0;
    std::uint32_t first_quadric = 0, quadrics = 0;
    bool may_transmit = true;  ///< false: nothing in it transmits light, and who looks for that need not look here

    std::uint32_t box_blocks() const { return packs < boxed_packs ? 0 : (packs + pack_size - 1) / pack_size; }
};

/// A recursive grid and all it lists. Grid 0 is the top grid. Coordinates are the root system's, or those of a box.
struct GridStructure {
    std::vector<Grid> grids;
    std::vector<CellWord> cells;
    std::vector<VoxelList> lists;
    RawVector<TrianglePack> packs;
    RawVector<PackBoxes> boxes;
    std::vector<PrimitiveId> quadrics;  ///< of voxels: their PrimitiveIds
    VoxelList large;                    ///< the largest triangles, kept out of the cells: every ray tests them first
    float largest = 0.0f;               ///< largest coordinate in magnitude: all error bounds scale with it
    float blur = 0.0f;        ///< how far the primitives that are tested may be from those listed here, per coordinate
    float pad = 0.0f;         ///< by how much registration and boxes are widened
    std::uint32_t depth = 0;  ///< levels of grids
    std::uint32_t largest_list = 0;  ///< primitives in the fullest voxel
    std::uint64_t references = 0;    ///< listings of primitives in voxels

    std::uint64_t bytes() const;
};

/// Registration and boxes are widened by this part of the largest coordinate: 32 half ulps, where walking, cutting and
/// the overlap test err by at most 16 together.
inline constexpr float pad_factor = 0x1p-19f;

}  // namespace firstray::inline v0
