#pragma once
#include "engine/grid/grid.h"
#include "engine/strategy/root_geometry.h"

namespace firstray::inline v0::lazy {

/// Primitives in packs, and how many of these a ray that comes by is likely to meet.
struct FlatList {
    GridStructure structure;
    double packs_met = 0.0;
};

/// A grid of one cell whose packs stand in the order of the ids: what a file tells together mostly lies together, so
/// that their boxes keep rays from most packs. It is made in a small part of the time of a top grid, since nothing is
/// sorted.
/// primitives  of groups that are carried
template <typename Real>
FlatList make_flat_list(const RootGeometry<Real>& geometry, const PrimitiveList& primitives);

}  // namespace firstray::inline v0::lazy
