#pragma once
#include <cstdint>
#include <vector>

#include "engine/core/precision.h"
#include "engine/core/ray_tile.h"
#include "engine/grid/boxed_grid.h"
#include "engine/strategy/root_geometry.h"
#include "obb/box.h"

namespace firstray::inline v0::obb {

/// Where an item of a boxed grid stands now, and what is in it.
struct Placed {
    const Box* box = nullptr;              ///< null for supergrids
    const BoxPlan* plan = nullptr;         ///< of the box
    const BoxedGrid* supergrid = nullptr;  ///< null for boxes
    bool in_root = true;                   ///< hits in the box are decided in the root system, not in the box's own
    std::uint32_t group = 0;               ///< whose primitives the box holds
    float loose = 1.0f;                    ///< how much larger the test's errors are in the box's system: see FilterRay
    Transform local_from_root;
};

/// Where rays search.
template <typename Real>
struct SearchTarget {
    const Scene* scene;
    const RootGeometry<Real>* geometry;
    Precision precision;
    const BoxedGrid* scenery;           ///< with the boxes that stand among it; null where there is none
    const BoxedGrid* outer;             ///< boxes that every ray looks for; null where there are none
    const std::vector<Placed>* placed;  ///< by item number
};

/// The two queries of Strategy. Any number of threads.
void search_closest(const SearchTarget<float>& target, RayTile<float>& tile);
void search_closest(const SearchTarget<double>& target, RayTile<double>& tile);
void search_any(const SearchTarget<float>& target, RayTile<float>& tile);
void search_any(const SearchTarget<double>& target, RayTile<double>& tile);

}  // namespace firstray::inline v0::obb
