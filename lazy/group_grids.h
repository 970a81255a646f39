#pragma once
#include <memory>
#include <span>

#include "engine/grid/build.h"
#include "engine/strategy/root_geometry.h"
#include "lazy/lazy_grid.h"
#include "lazy/ledger.h"

namespace firstray::inline v0::lazy {

/// The number under which one grid holds all groups that move.
inline constexpr std::uint32_t everything_that_moves = 0;

/// A lazy grid for each group that moves. Not even a vertex of a group is carried before the first ray enters its box.
template <typename Real>
class GroupGrids {
public:
    /// scene, geometry, ledger, chooser  must outlive this
    /// chooser  null: the first ray has a group's grid made
    GroupGrids(const Scene& scene, const RootGeometry<Real>& geometry, const GridOptions& options, Ledger& ledger,
               Chooser* chooser = nullptr);
    ~GroupGrids();

    /// A group's grid, made now if it was not; null while another thread makes it, where there is no memory for it, or
    /// where a list is chosen: then the group's primitives are to be tested one by one. Any number of threads.
    /// rays  that are about to search it
    const LazyGrid* grid(std::uint32_t group, std::uint64_t rays = 1) const
    {
        const LazyGrid* made = grids_[group].get();
        if (!made) return enter_first(group, rays);
        if (chooser_) chooser_->count_gridded(group, rays);
        return made;
    }
    /// The same, and nothing is made.
    const LazyGrid* made(std::uint32_t group) const { return grids_[group].get(); }

    /// False: nothing that goes by this number transmits light.
    bool may_transmit(std::uint32_t group) const { return gathered_ || geometry_.group_transmits(group); }

    /// LazyGrid::keep() of a group's grid; 0 where there is none. Runs alone.
    std::uint64_t keep(std::uint32_t group);

    /// Makes the grid of everything that moves anew, from primitives that are carried. Voxels that nothing that moved
    /// has left or entered are kept; returns how many built ones are not. Runs alone.
    /// room  where all of it goes: the cells then stay what they are
    std::uint64_t gather(const PrimitiveList& primitives, const Aabb& room, const Executor* executor);

    /// Gives up a group's grid; returns how many voxels of it were built. Runs alone.
    std::uint64_t drop(std::uint32_t group);

private:
    const LazyGrid* enter_first(std::uint32_t group, std::uint64_t rays) const;
    bool carry(std::uint32_t group) const;
    std::unique_ptr<LazyGrid> make(std::uint32_t group) const;
    VoxelChoice choice_in(std::uint32_t group) const;
    GridOptions shape_of(std::size_t primitives) const;

    const Scene& scene_;
    const RootGeometry<Real>& geometry_;
    GridOptions options_;
    Ledger& ledger_;
    Chooser* chooser_;
    std::unique_ptr<MadeOnce<LazyGrid>[]> grids_;  ///< by group
    bool gathered_ = false;                        ///< one grid holds all groups
};

}  // namespace firstray::inline v0::lazy
