#pragma once
#include "engine/core/precision.h"
#include "engine/core/ray_tile.h"
#include "engine/grid/boxed_grid.h"
#include "engine/strategy/root_geometry.h"
#include "lazy/group_grids.h"
#include "lazy/lazy_grid.h"

namespace firstray::inline v0::lazy {

/// Where rays search.
template <typename Real>
struct SearchTarget {
    const Scene* scene;
    const RootGeometry<Real>* geometry;
    Precision precision;
    const LazyGrid* scenery;         ///< null where there is none
    const BoxedGrid* around;         ///< the scenery's top grid with the boxes of groups in it
    const BoxedGrid* outer;          ///< boxes that every ray looks for; null where there are none
    const GroupGrids<Real>* groups;  ///< what is in the boxes; an item's number is the group's
};

/// The two queries of Strategy. Any number of threads.
void search_closest(const SearchTarget<float>& target, RayTile<float>& tile);
void search_closest(const SearchTarget<double>& target, RayTile<double>& tile);
void search_any(const SearchTarget<float>& target, RayTile<float>& tile);
void search_any(const SearchTarget<double>& target, RayTile<double>& tile);

}  // namespace firstray::inline v0::lazy
