#pragma once
#include <span>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/scene/scene.h"

namespace firstray {

/// By group: a box in the system of the group's node around its primitives, at all times where they deform. Empty where
/// a group holds nothing finite.
std::vector<DAabb> group_bounds(const Scene& scene);

/// A box in the root system around the places of all groups but the scenery, at times spread over the animation.
/// bounds  group_bounds(scene)
Aabb room_of_movers(const Scene& scene, std::span<const DAabb> bounds);

/// The room that a grid over the scenery should cover, so that what moves among it is inside: nothing more (an empty
/// box) where that would make it much larger.
Aabb room_for_movers(const Scene& scene, std::span<const DAabb> bounds, const Aabb& scenery);

/// An axis-aligned box around a transformed one.
DAabb transformed(const DAabb& box, const Transform& transform);

}  // namespace firstray
