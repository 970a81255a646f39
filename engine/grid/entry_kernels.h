#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/core/aabb.h"
#include "engine/grid/entries.h"
#include "engine/grid/grid.h"

namespace firstray::inline v0 {

// What building does to every triangle, sixteen at a time. All instruction sets give the same.

/// The triangles with the largest boxes of those offered, ascending, and the first of equal ones.
class LargestTriangles {
public:
    struct Triangle {
        float half_area;
        std::uint32_t entry;
        bool operator<(const Triangle& other) const
        {
            return half_area != other.half_area ? half_area > other.half_area : entry < other.entry;
        }
    };
    void offer(const Triangle& triangle);
    /// Those offered with less or as much count no more.
    float least() const { return count_ < pack_size ? -1.0f : found_[pack_size - 1].half_area; }
    std::span<const Triangle> found() const { return {found_.data(), static_cast<std::size_t>(count_)}; }

private:
    std::array<Triangle, pack_size> found_;  ///< largest first
    int count_ = 0;
};

/// The box of some entries.
/// largest  if not null, is offered those that are triangles
Aabb bounds_of(const GridEntries& entries, std::span<const std::uint32_t> chosen, LargestTriangles* largest);
/// The box of all of them.
Aabb bounds_of(const GridEntries& entries, const Executor* executor, LargestTriangles* largest = nullptr);

/// Finds cells with multiplications: the rounding of a cell's inverse is a small part of the pad.
struct CellFinder {
    glm::vec3 lo, scale, last;
    glm::ivec3 dims;
    float pad;

    CellFinder(const Grid& grid, float wide)
        : lo(grid.lo), scale(1.0f / grid.cell), last(grid.dims - 1), dims(grid.dims), pad(wide)
    {
    }
};

/// The cells that sixteen boxes, widened by the pad, reach, clamped to the grid.
struct RangeBlock {
    alignas(64) std::int32_t lo[3][pack_size], hi[3][pack_size];  ///< lowest and highest, by axis
    alignas(64) std::uint32_t lowest[pack_size];                  ///< cells' indices
    alignas(64) std::uint32_t more[pack_size];  ///< a bit for each axis along which it is not the only one
    std::uint32_t wide;                         ///< mask of those with more than two cells along an axis
};

/// The ranges of up to sixteen triangles.
void find_ranges(const GridEntries& entries, std::span<const std::uint32_t> triangles, const CellFinder& finder,
                 RangeBlock& ranges);

/// The cells of what reaches at most two along each axis, counted from the lowest one.
struct FewCells {
    static constexpr std::size_t most = 8;
    alignas(32) std::uint32_t offset[most] = {};
    std::uint32_t count = 0;
};

/// Lists triangles of a block that are not wide, each in all cells that it reaches.
/// few   by RangeBlock::more
/// lane  of the first of them in the block
/// cells, entries  references; there is room for FewCells::most of each triangle
/// returns         how many they are; what stands behind them is overwritten
std::size_t list_few_cells(const FewCells (&few)[8], const RangeBlock& ranges, std::size_t lane,
                           std::span<const std::uint32_t> triangles, std::uint32_t* cells, std::uint32_t* entries);

/// How a voxel's triangles are put into packs.
enum class PackOrder {
    along_curve,  ///< quick
    by_surface    ///< see order_by_surface
};

/// Sorts a voxel's triangles into clusters of sixteen and copies them to its list's packs, which must be there, with
/// their boxes, clipped to the voxel. Different lists may be filled at the same time.
void fill_packs(const VoxelList& list, const GridEntries& entries, const PlacedTriangles& triangles, const Aabb& voxel,
                PackOrder order, GridStructure& structure);

}  // namespace firstray::inline v0
