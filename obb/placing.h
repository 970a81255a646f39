#pragma once
#include <glm/glm.hpp>

#include <span>

#include "engine/core/aabb.h"
#include "engine/core/transform.h"
#include "obb/box.h"

namespace firstray::inline v0::obb {

/// Where a box stands in a frame: a function of the pose alone, so that nothing drifts.
struct BoxPlace {
    bool is_there = false;  ///< visible, and with something in it
    DAabb bounds;           ///< in the box's own system, which `local` means
    Transform local_from_root{}, root_from_local{};
    double largest = 0.0;  ///< coordinate of the box in the root system
    float loose = 1.0f;    ///< how much larger errors of sides are in the box's system than in the root's
};

/// node_from_root  inverse of root_from_node, which is not singular
BoxPlace place_box(const BoxSystem& box, const Transform& root_from_node, const Transform& node_from_root);

/// The place of a box that stands in the root system itself.
BoxPlace place_in_root(const Box& box);

/// What the box of a group is made for, and how that differs from what it was made for first: a function of the pose
/// alone, so that frames do not depend on those before them, in steps, so that boxes are seldom made anew.
struct Fit {
    bool is_distorted = false;  ///< so much that it gets a box for this pose only
    int scale = 0;              ///< exponent of two by which the system is larger
    int blur = 0;               ///< exponent of four by which the blur is larger
    bool operator==(const Fit&) const = default;
};

/// place  of the box that was made first
/// blur   that it was made with
Fit fit_of(const BoxPlace& place, float blur);

/// Axes for the box around the boxes of a cluster: those of the smallest around them now, as columns, in the system of
/// the cluster's node. They are chosen once; later boxes only fit their extents to it.
glm::dmat3 choose_axes(std::span<const BoxPlace> places, const glm::dmat3& node_from_root);

/// An oriented box around boxes.
struct ClusterBox {
    glm::dmat3 axes{1.0};  ///< orthonormal, right-handed
    DAabb bounds;          ///< along the axes
};

/// The least box around those boxes that are there, along given axes: columns, any that are not singular.
ClusterBox fit_cluster(const glm::dmat3& axes, std::span<const BoxPlace> places);

}  // namespace firstray::inline v0::obb
