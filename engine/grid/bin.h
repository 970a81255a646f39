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

/// What bin() works with; its memory is used again.
struct BinScratch {
    /// What a part of the entries comes to.
    struct Piece {
        RawVector<std::uint32_t> cells, entries;  ///< reference by reference
        std::vector<std::uint32_t> places;        ///< by cell: how many, then where the next one goes
        std::uint64_t estimate = 0;
    };
    std::vector<Piece> pieces;
    std::uint64_t bytes() const;
};

/// Lists each of the given entries in every cell that it overlaps, plus pad: triangles exactly, but those of few cells
/// and quadrics by their boxes.
/// most      references at most, by an estimate from boxes in which a triangle of many cells is taken for a surface; a
///           grid of one cell is not limited
/// executor  null: on this thread. The lists do not depend on it.
/// lists     what it held before is gone, its memory is used again
/// returns   whether they are made: false where they would be too long
bool bin(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen, std::uint64_t most,
         const Executor* executor, BinScratch& scratch, CellLists& lists);

}  // namespace firstray::inline v0
