#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/strategy/group_bounds.h"
#include "lazy/group_grids.h"
#include "lazy/lazy_grid.h"
#include "lazy/search.h"
#include "tests/support/test_rays.h"

namespace firstray::test {

/// Appends a static scene's primitives as a group that moves.
inline void add_mover(Scene& scene, const Scene& piece)
{
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    Group group = piece.groups[0];
    group.node = size(scene.nodes);
    group.first = size(scene.part_of_primitive);
    group.first_triangle = size(scene.triangles);
    group.first_quadric = size(scene.quadrics);
    group.first_vertex = size(scene.positions);
    scene.nodes.emplace_back();
    scene.nodes.back().parent = 0;
    scene.nodes.back().dynamic = true;
    for (TriangleIndices triangle : piece.triangles) {
        triangle.vertex += group.first_vertex;
        scene.triangles.push_back(triangle);
    }
    for (const std::uint32_t part : piece.part_of_primitive)
        scene.part_of_primitive.push_back(size(scene.parts) + part);
    for (Part part : piece.parts) {
        part.node = group.node;
        part.group = size(scene.groups);
        part.material += size(scene.materials);
        part.first += group.first;
        scene.parts.push_back(part);
    }
    scene.groups.push_back(group);
    scene.materials.insert(scene.materials.end(), piece.materials.begin(), piece.materials.end());
    scene.positions.insert(scene.positions.end(), piece.positions.begin(), piece.positions.end());
    scene.quadrics.insert(scene.quadrics.end(), piece.quadrics.begin(), piece.quadrics.end());
}

/// A random scene with so many random groups in it that poses may move.
inline Scene scene_with_movers(std::uint64_t seed, int scenery, int movers, int in_each)
{
    Random random(seed * 1000);
    Scene scene = random_scene(seed, scenery);
    for (int i = 0; i < movers; ++i)
        add_mover(scene, random_scene(seed * 1000 + static_cast<std::uint64_t>(i), in_each, random.in_cube(8.0)));
    return scene;
}

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
