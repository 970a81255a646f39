#pragma once
#include <cstdint>
#include <vector>

#include "engine/core/precision.h"
#include "engine/core/ray_tile.h"
#include "engine/strategy/root_geometry.h"
#include "obb/box.h"
#include "obb/boxed_grid.h"

namespace firstray::obb {

/// Where an item of a boxed grid stands now, and what is in it.
struct Placed {
    const Box* box = nullptr;              ///< null for supergrids
    const BoxedGrid* supergrid = nullptr;  ///< null for boxes
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
    Hits hits;
    const BoxedGrid* scenery;           ///< with the boxes that stand among it; null where there is none
    const BoxedGrid* outer;             ///< boxes that every ray looks for; null where there are none
    const std::vector<Placed>* placed;  ///< by item number
};

/// Which items a ray has been sent into already.
class Visits {
public:
    void begin_ray(std::size_t items)
    {
        if (last_.size() < items) last_.resize(items);
        ++ray_;
    }
    bool is_first(std::uint32_t item)
    {
        const bool first = last_[item] != ray_;
        last_[item] = ray_;
        return first;
    }

private:
    std::vector<std::uint64_t> last_;  ///< by item: the last ray that was sent into it
    std::uint64_t ray_ = 0;
};

/// The two queries of Strategy. Any number of threads.
void search_closest(const SearchTarget<float>& target, RayTile<float>& tile);
void search_closest(const SearchTarget<double>& target, RayTile<double>& tile);
void search_any(const SearchTarget<float>& target, RayTile<float>& tile);
void search_any(const SearchTarget<double>& target, RayTile<double>& tile);

}  // namespace firstray::obb
