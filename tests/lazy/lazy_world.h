#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/strategy/group_bounds.h"
#include "lazy/group_grids.h"
#include "lazy/lazy_grid.h"
#include "lazy/search.h"
#include "tests/support/movers.h"

namespace firstray::test {

/// Everything that lazy rays search, with its parts open to view: the scenery's grid, and all groups' boxes beside it.
class LazyWorld {
public:
    RootGeometry<float> geometry;
    lazy::LazyGrid scenery;
    lazy::GroupGrids<float> groups;

    /// ledger, scene, pose  must outlive this
    LazyWorld(const Scene& scene, const Pose& pose, const GridOptions& options, lazy::Ledger& ledger)
        : geometry(scene),
          scenery(entries(pose), options, ledger, nullptr),
          groups(scene, geometry, options, ledger),
          scene_(scene)
    {
        around_.structure = scenery.top();
        place(pose);
    }

    /// What the strategy does between frames.
    void update(const Pose& pose)
    {
        geometry.update_on_touch(pose);
        for (std::uint32_t group = 1; group < scene_.groups.size(); ++group)
            if (geometry.has_moved(group)) groups.drop(group);
        place(pose);
    }
    void closest(RayTile<float>& tile) const { search_closest(target(), tile); }
    void occluded(RayTile<float>& tile) const { search_any(target(), tile); }

    /// Voxels and groups' grids that there are.
    std::uint64_t built() const
    {
        std::uint64_t sum = scenery.counts().built;
        for (std::uint32_t group = 1; group < scene_.groups.size(); ++group)
            if (const lazy::LazyGrid* grid = groups.made(group)) sum += 1 + grid->counts().built;
        return sum;
    }

private:
    lazy::SearchTarget<float> target() const
    {
        return {&scene_, &geometry, Precision::robust, &scenery, &around_, has_items_ ? &outer_ : nullptr, &groups};
    }
    GridEntries entries(const Pose& pose)
    {
        geometry.update_on_touch(pose);
        geometry.touch(0);
        PrimitiveList primitives;
        geometry.list(0, primitives);
        return make_entries(geometry, primitives, nullptr);
    }
    void place(const Pose& pose)
    {
        const std::vector<DAabb> bounds = group_bounds(scene_);
        std::vector<Item> items;
        for (std::uint32_t group = 1; group < scene_.groups.size(); ++group) {
            const Transform& place = pose.root_from_node[scene_.groups[group].node];
            items.push_back(make_item(group, inverse(place), place, bounds[group], 1e-3));
        }
        has_items_ = !items.empty();
        outer_ = has_items_ ? grid_of_items(items, false) : BoxedGrid{};
    }

    const Scene& scene_;
    BoxedGrid around_, outer_;
    bool has_items_ = false;
};

/// Lanes whose nearest hits are not the same, bit for bit.
template <typename Real>
int differing_hits(const RayTile<Real>& a, const RayTile<Real>& b)
{
    int different = a.count != b.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::min(a.count, b.count)); ++i) {
        const bool hit = a.primitive[i] != no_primitive;
        different += a.primitive[i] != b.primitive[i] || a.t_max[i] != b.t_max[i] ||
                     (hit && (a.u[i] != b.u[i] || a.v[i] != b.v[i]));
    }
    return different;
}

}  // namespace firstray::test
