#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "obb/options.h"

namespace firstray::inline v0::obb {

struct PrimitiveRange {
    PrimitiveId first = 0;
    std::uint32_t count = 0;
};

/// Primitives that stand in one box.
struct BoxPlan {
    std::uint32_t group = 0;  ///< all are of this group: they never move against each other, unless it deforms
    std::string name;         ///< of their transform
    std::vector<PrimitiveRange> primitives;  ///< ascending

    std::uint32_t count() const
    {
        std::uint32_t count = 0;
        for (const PrimitiveRange& range : primitives) count += range.count;
        return count;
    }
};

/// All boxes under one topmost dynamic transform: they stand together in a supergrid.
struct Cluster {
    std::uint32_t node = 0;  ///< that transform; the root for what deforms under none
    std::string name;
    std::uint32_t first_box = 0, boxes = 0;
};

/// Which primitives stand in which box. The static scenery (group 0) stands in none.
struct Hierarchy {
    std::vector<BoxPlan> boxes;  ///< cluster by cluster
    std::vector<Cluster> clusters;
};

/// source  Create, in Lext and Akenine-Moller 2001, section 4, as it is meant: each transform's own primitives make a
///         grid, and the grids below a dynamic transform that has none above it make a supergrid
Hierarchy plan_hierarchy(const Scene& scene, Groups groups);

}  // namespace firstray::inline v0::obb
