#pragma once
#include "engine/core/precision.h"
#include "engine/core/ray_tile.h"
#include "engine/grid/grid.h"
#include "engine/strategy/root_geometry.h"

namespace firstray::inline v0 {

/// Where rays search.
template <typename Real>
struct SearchTarget {
    const GridStructure* structure;
    const RootGeometry<Real>* geometry;
    Precision precision;
};

/// The two queries of Strategy, on a grid that is built whole. Any number of threads.
void search_closest(const SearchTarget<float>& target, RayTile<float>& tile);
void search_closest(const SearchTarget<double>& target, RayTile<double>& tile);
void search_any(const SearchTarget<float>& target, RayTile<float>& tile);
void search_any(const SearchTarget<double>& target, RayTile<double>& tile);

}  // namespace firstray::inline v0
