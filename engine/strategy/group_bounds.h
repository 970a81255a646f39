#pragma once
#include <span>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/grid/entries.h"
#include "engine/scene/scene.h"

namespace firstray::inline v0 {

/// By group: a box in the system of the group's node around its primitives, at all times where they deform, as they are
/// now where they are live. Empty where a group holds nothing finite.
std::vector<DAabb> group_bounds(const Scene& scene);

/// Brings the boxes of live groups to where their vertices are now.
/// bounds  group_bounds(scene)
void follow_live_groups(const Scene& scene, std::span<DAabb> bounds);

/// A box in the root system around the places of all groups but the scenery, at times spread over the animation.
/// bounds  group_bounds(scene)
Aabb room_of_movers(const Scene& scene, std::span<const DAabb> bounds);

/// What a grid over the scenery is built from; the scenery is carried now. The grid has room for what moves among it,
/// where that does not make it much larger. Runs alone.
/// movers  room_of_movers(...)
template <typename Real>
GridEntries scenery_entries(const RootGeometry<Real>& geometry, const Aabb& movers, const Executor* executor);

/// An axis-aligned box around a transformed one.
DAabb transformed(const DAabb& box, const Transform& transform);

}  // namespace firstray::inline v0
