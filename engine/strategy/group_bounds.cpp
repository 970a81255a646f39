#include "engine/strategy/group_bounds.h"

#include <cmath>

#include "engine/core/search_ray.h"
#include "engine/primitive/quadric.h"
#include "engine/scene/pose.h"

namespace firstray::inline v0 {
namespace {

/// Poses of the animation at which moving things are looked up.
constexpr int sampled_poses = 32;

/// A grid over the scenery may have at most so many times the scenery's own surface.
constexpr float most_room = 1.5f;

bool is_finite(const glm::dvec3& p)
{
    return std::isfinite(p.x + p.y + p.z);
}

DAabb bounds_of(const Scene& scene, const Group& group)
{
    DAabb box;
    const auto grow = [&](const glm::dvec3& p) {
        if (is_finite(p)) box.grow(p);
    };
    if (group.deforming && !group.live) {
        for (std::uint32_t i = 0; i < group.triangles; ++i) {
            const DeformingTriangle& triangle = scene.deforming[group.first_deforming + i];
            for (std::uint32_t key = 0; key < triangle.keys; ++key)
                for (const glm::dvec3& p : scene.deforming_keys[triangle.first_key + key].position) grow(p);
        }
    } else {
        for (std::uint32_t i = 0; i < group.vertices; ++i) grow(scene.position(group.first_vertex + i));
    }
    for (std::uint32_t i = 0; i < group.quadrics; ++i)
        box.grow(place_quadric(scene.quadrics[group.first_quadric + i], {}, 0, false).bounds);
    return box;
}

}  // namespace

std::vector<DAabb> group_bounds(const Scene& scene)
{
    std::vector<DAabb> bounds;
    for (const Group& group : scene.groups) bounds.push_back(bounds_of(scene, group));
    return bounds;
}

void follow_live_groups(const Scene& scene, std::span<DAabb> bounds)
{
    for (std::size_t i = 0; i < scene.groups.size(); ++i)
        if (scene.groups[i].live) bounds[i] = bounds_of(scene, scene.groups[i]);
}

DAabb transformed(const DAabb& box, const Transform& transform)
{
    const glm::dvec3 centre = transform.point((box.lo + box.hi) * 0.5), half = box.size() * 0.5;
    DAabb result;
    for (int axis = 0; axis < 3; ++axis) {
        double reach = 0.0;
        for (int j = 0; j < 3; ++j) reach += std::abs(transform.linear[j][axis]) * half[j];
        result.lo[axis] = centre[axis] - reach;
        result.hi[axis] = centre[axis] + reach;
    }
    return result;
}

Aabb room_of_movers(const Scene& scene, std::span<const DAabb> bounds)
{
    Aabb room;
    for (int i = 0; i < sampled_poses && scene.groups.size() > 1; ++i) {
        const Pose sample = pose(scene, scene.start + (scene.end - scene.start) * i / (sampled_poses - 1));
        for (std::size_t g = 1; g < scene.groups.size(); ++g) {
            if (!sample.is_visible(scene.groups[g]) || bounds[g].empty()) continue;
            const DAabb box = transformed(bounds[g], sample.root_from_node[scene.groups[g].node]);
            const glm::dvec3 end(farthest_place);  // nothing is met beyond
            room.grow(Aabb{glm::vec3(glm::clamp(box.lo, -end, end)), glm::vec3(glm::clamp(box.hi, -end, end))});
        }
    }
    return room;
}

template <typename Real>
GridEntries scenery_entries(const RootGeometry<Real>& geometry, const Aabb& movers, const Executor* executor)
{
    geometry.touch(0, executor);
    PrimitiveList primitives;
    geometry.list(0, primitives);
    GridEntries entries = make_entries(geometry, primitives, executor);
    entries.room = movers;
    entries.most_room = most_room;
    return entries;
}

template GridEntries scenery_entries(const RootGeometry<float>&, const Aabb&, const Executor*);
template GridEntries scenery_entries(const RootGeometry<double>&, const Aabb&, const Executor*);

}  // namespace firstray::inline v0
