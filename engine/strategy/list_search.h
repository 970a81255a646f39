#pragma once
#include "engine/core/ray_tile.h"
#include "engine/strategy/root_geometry.h"
#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// Tests all primitives against all rays of a tile; any: the first hit found is enough.
void search_list(const RootGeometry<float>& geometry, Precision precision, bool any, RayTile<float>& tile);
void search_list(const RootGeometry<double>& geometry, Precision precision, bool any, RayTile<double>& tile);

}  // namespace firstray::inline v0
