#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/core/made_once.h"
#include "engine/grid/boxed_grid.h"
#include "engine/grid/build.h"
#include "engine/strategy/root_geometry.h"
#include "lazy/flat_list.h"
#include "lazy/lazy_grid.h"

namespace firstray::inline v0::lazy {

/// What does not move: a lazy grid, or not even that where a chooser thinks that lists will do.
template <typename Real>
class Scenery {
public:
    struct Made {
        LazyGrid grid;
        BoxedGrid around{};  ///< its top grid, with boxes of groups in it
        BoxedGrid outer{};   ///< boxes that it has no room for
    };

    /// bounds   group_bounds(scene)
    /// chooser  null: the grid is made by the first update
    /// All but options must outlive this.
    Scenery(const Scene& scene, const RootGeometry<Real>& geometry, std::span<const DAabb> bounds,
            const GridOptions& options, Ledger& ledger, Chooser* chooser);

    /// Makes what is to be there before rays fly; returns how many primitives were put into a grid. Runs alone.
    std::uint64_t update(const Executor* executor);

    /// Puts boxes of what moves where they are now: those of the grid, too, that rays may have made. After update();
    /// runs alone.
    void place(std::vector<Item> items);
    /// Boxes that every ray looks for.
    /// scenery  what enter() returned
    const BoxedGrid& outer(const Made* scenery) const { return scenery ? scenery->outer : outer_; }

    /// The grid, or null: there is none, or none yet.
    const Made* made() const { return made_.get(); }
    Made* made_alone() { return made_.get_alone(); }

    /// The same for rays that are about to search it together, who may have it made. Null where anything stands: they
    /// are to search the flat list. Any number of threads.
    const Made* enter(std::uint64_t rays) const;
    /// The primitives in packs: there from an update without a grid to the first one with it.
    const GridStructure& flat_list() const { return flat_list_.structure; }
    /// What the chooser compares, by what is known now.
    Alternatives alternatives() const;
    /// Room for what moves: room_of_movers().
    const Aabb& movers() const { return movers_; }
    /// No coordinate of the grid is larger, whether it is made or will be.
    double largest() const { return largest_; }
    std::uint64_t bytes() const;
    bool is_empty() const { return primitives_ == 0; }

private:
    std::unique_ptr<Made> make(const Executor* executor) const;
    std::unique_ptr<Made> make_for_rays() const;

    const RootGeometry<Real>& geometry_;
    Aabb movers_;
    double largest_;
    GridOptions options_;
    Ledger& ledger_;
    Chooser* chooser_;
    std::uint64_t primitives_;
    FlatList flat_list_;
    std::vector<Item> items_;
    BoxedGrid outer_;  ///< boxes of all items, while there is no grid
    mutable MadeOnce<Made> made_;
};

}  // namespace firstray::inline v0::lazy
