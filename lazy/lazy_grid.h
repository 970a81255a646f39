#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/made_once.h"
#include "engine/grid/build.h"
#include "engine/grid/entries.h"
#include "engine/strategy/outline.h"
#include "lazy/chooser.h"
#include "lazy/ledger.h"

namespace firstray::inline v0::lazy {

/// Who chooses which voxels of a grid are built, and where it counts their rays.
struct VoxelChoice {
    Chooser* chooser = nullptr;  ///< null: the first ray has a voxel built
    Chooser::Range places{};
    bool is_scenery = false;  ///< voxels expect what other voxels have had
};

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
    /// ledger   must outlive the grid, so must the chooser
    LazyGrid(GridEntries entries, const GridOptions& options, Ledger& ledger, const Executor* executor,
             const VoxelChoice& choice = {});
    ~LazyGrid();

    const GridStructure& top() const { return top_.structure; }
    const GridEntries& entries() const { return entries_; }
    std::span<const std::uint32_t> listed(std::uint32_t cell) const { return top_.lists.of(cell); }

    /// What is in a cell that lists anything, built now if it was not; null while another thread builds it, where there
    /// is no memory for it, or where a list is chosen: then listed() is to be searched. Any number of threads.
    /// rays  that are about to search it
    const GridStructure* voxel(std::uint32_t cell, std::uint64_t rays = 1) const
    {
        const GridStructure* built = voxels_[cell].get();
        return built ? built : enter_first(cell, rays);
    }
    /// The same, and nothing is built.
    const GridStructure* built(std::uint32_t cell) const { return voxels_[cell].get(); }

    VoxelCounts counts() const;

    /// Between frames: what is built by now counts as kept, and what there was no memory for may be asked for again.
    /// Returns how many voxels are built.
    std::uint64_t keep();

    /// Takes over, from a grid that is given up, the voxels that list what they list here. Both must have the same cells
    /// for that. Returns how many were built and are not taken. Runs alone.
    /// stands  whether a primitive is where it was: `stands(id)`
    template <class Stands>
    std::uint64_t adopt(LazyGrid& old, const Stands& stands)
    {
        std::uint64_t given_up = 0;
        const bool same_cells = has_cells_of(old);
        for (std::uint32_t cell = 0; cell < old.top_.structure.cells.size(); ++cell) {
            if (!old.built(cell)) continue;
            const bool is_same = same_cells && lists_same(old, cell, stands);
            given_up += !is_same;
            if (is_same) voxels_[cell].put(old.voxels_[cell].take());
        }
        return given_up;
    }

    /// Appends the grid as it stands, what is built and what is not, without what is inside voxels.
    /// heading  its kind, name, level and primitives are kept, the rest is filled in
    void append_outline(StructureBox heading, std::vector<StructureBox>& out) const;
    /// What was chosen for the voxels; a chooser is there.
    void report_choices(ChoiceReport& report) const;
    std::uint64_t bytes() const { return held_; }  ///< without voxels

private:
    bool has_cells_of(const LazyGrid& other) const;
    template <class Stands>
    bool lists_same(const LazyGrid& old, std::uint32_t cell, const Stands& stands) const
    {
        const auto now = listed(cell), before = old.listed(cell);
        return std::equal(now.begin(), now.end(), before.begin(), before.end(),
                          [&](std::uint32_t mine, std::uint32_t others) {
                              return entries_.ids[mine] == old.entries_.ids[others] &&
                                     stands(entries_.ids[mine] & ~transmitting_bit);
                          });
    }
    const GridStructure* enter_first(std::uint32_t cell, std::uint64_t rays) const;
    std::unique_ptr<GridStructure> build(std::uint32_t cell) const;

    GridOptions options_;
    GridEntries entries_;
    TopGrid top_;
    std::unique_ptr<MadeOnce<GridStructure>[]> voxels_;  ///< by cell
    std::vector<std::uint8_t> kept_;  ///< by cell: built before the last keep(); empty before the first
    VoxelChoice choice_;
    double filled_ = 0.0;  ///< voxels that list anything; counted where they are chosen among
    Ledger& ledger_;
    std::uint64_t held_ = 0;
};

}  // namespace firstray::inline v0::lazy
