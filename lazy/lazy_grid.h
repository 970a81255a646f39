#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/grid/build.h"
#include "engine/grid/entries.h"
#include "engine/strategy/outline.h"
#include "lazy/ledger.h"
#include "engine/core/made_once.h"

namespace firstray::lazy {

/// How much of a lazy grid there is.
struct VoxelCounts {
    std::uint64_t filled = 0;  ///< voxels that list anything
    std::uint64_t built = 0;   ///< of those: by now
};

/// A recursive grid of which only the top level is there at first. A voxel's triangles are put into packs, and its
/// subgrid is made, when the first ray enters it, by that ray's thread and once; until then its list is what is
/// searched.
/// source  Lext and Akenine-Moller 2001, section 3.2;
///         M. McNeill et al., "Performance of Space Subdivision Techniques in Ray Tracing", 1992
class LazyGrid {
public:
    /// entries  in the root system
    /// ledger   must outlive the grid
    LazyGrid(GridEntries entries, const GridOptions& options, Ledger& ledger, const Executor* executor);
    ~LazyGrid();

    const GridStructure& top() const { return top_.structure; }
    const GridEntries& entries() const { return entries_; }
    std::span<const std::uint32_t> listed(std::uint32_t cell) const { return top_.lists.of(cell); }

    /// What is in a cell that lists anything, built now if it was not; null while another thread builds it, or where
    /// there is no memory for it: then listed() is to be searched. Any number of threads.
    const GridStructure* voxel(std::uint32_t cell) const
    {
        const GridStructure* built = voxels_[cell].get();
        return built ? built : enter_first(cell);
    }
    /// The same, and nothing is built.
    const GridStructure* built(std::uint32_t cell) const { return voxels_[cell].get(); }

    VoxelCounts counts() const;

    /// Between frames: what is built by now counts as kept, and what there was no memory for may be asked for again.
    /// Returns how many voxels are built.
    std::uint64_t keep();

    /// Appends the grid as it stands, what is built and what is not, without what is inside voxels.
    /// heading  its kind, name, level and primitives are kept, the rest is filled in
    void append_outline(StructureBox heading, std::vector<StructureBox>& out) const;
    std::uint64_t bytes() const { return held_; }  ///< without voxels

private:
    const GridStructure* enter_first(std::uint32_t cell) const;
    std::unique_ptr<GridStructure> build(std::uint32_t cell) const;

    GridOptions options_;
    GridEntries entries_;
    TopGrid top_;
    std::unique_ptr<MadeOnce<GridStructure>[]> voxels_;  ///< by cell
    std::vector<std::uint8_t> kept_;  ///< by cell: built before the last keep(); empty before the first
    Ledger& ledger_;
    std::uint64_t held_ = 0;
};

}  // namespace firstray::lazy
