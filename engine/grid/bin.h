#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/core/aligned.h"
#include "engine/core/executor.h"
#include "engine/grid/entries.h"
#include "engine/grid/grid.h"

namespace firstray::inline v0 {

/// A list of entries for each cell, in one array: cell c's are entries[first[c]] to entries[first[c + 1]], ascending.
struct CellLists {
    std::vector<std::uint32_t> first;  ///< one more than cells
    RawVector<std::uint32_t> entries;

    std::span<const std::uint32_t> of(std::uint32_t cell) const
    {
        return {entries.data() + first[cell], entries.data() + first[cell + 1]};
    }
    std::uint64_t bytes() const { return 4 * (first.capacity() + entries.capacity()); }
};

/// The cells, lowest and highest, that a box (widened by pad) reaches, clamped to the grid.
struct CellRange {
    glm::ivec3 lo, hi;
    std::uint64_t cells() const
    {
        const glm::ivec3 n = hi - lo + 1;
        return static_cast<std::uint64_t>(n.x) * static_cast<std::uint64_t>(n.y) * static_cast<std::uint64_t>(n.z);
    }
};
CellRange cells_of(const Grid& grid, const Aabb& box, float pad);

/// The cells that the boxes of the given entries reach, one range for each.
/// executor  null: on this thread
RawVector<CellRange> ranges_of(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen,
                               const Executor* executor);

/// Lists each of the given entries in every cell that it overlaps: triangles exactly (plus pad), others by their boxes.
/// ranges    ranges_of() the same
/// executor  null: on this thread
CellLists bin(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen,
              std::span<const CellRange> ranges, const Executor* executor);

/// An estimate, from boxes alone, of how many references bin() would make: a triangle of many cells is taken for a
/// surface.
std::uint64_t estimate_references(std::span<const CellRange> ranges);

}  // namespace firstray::inline v0
