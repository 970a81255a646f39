#pragma once
#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/executor.h"
#include "engine/scene/scene.h"

namespace firstray::inline v0 {

/// Where a pinhole camera stands, in the root system (world minus Scene::origin), with orthonormal axes.
struct CameraPose {
    glm::dvec3 eye{0.0};                                                          ///< where it stands
    glm::dvec3 forward{0.0, 0.0, -1.0}, right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0};  ///< axes
};

/// Where everything is at one time. "Root" is the root system: world minus Scene::origin.
struct Pose {
    const Scene* scene = nullptr;               ///< what is posed
    double time = 0.0;                          ///< seconds
    std::vector<Transform> root_from_node;      ///< by node
    std::vector<std::uint8_t> visible;          ///< by node; false where it or an ancestor is hidden or singular
    std::vector<std::uint32_t> singular_nodes;  ///< nodes made invisible because their transform is singular
    CameraPose camera;                          ///< where the view is taken from
    std::vector<glm::dvec3> lights;             ///< positions, root system, by Scene::lights

    bool is_visible(const Group& group) const { return visible[group.node] != 0; }  ///< now
};

/// The state at `time`: depends on time alone, never on what was posed before. Runs in double. Thread-safe.
/// The pose refers to the scene, which must outlive it.
Pose pose(const Scene& scene, double time);

/// Vertices of a group carried into the root system: out[i] belongs to Scene::position(group.first_vertex + i).
/// Deforming groups are evaluated at pose.time, live ones as their vertices are now. The one function that makes root
/// vertices, so that every strategy gets the same bits: computed in double, rounded once.
/// out       room for group.vertices points
/// executor  null: on this thread
/// returns   whether all of them are in range (farthest_place)
bool carry_vertices(const Pose& pose, const Group& group, glm::vec3* out, const Executor* executor = nullptr);
/// The same in double.
bool carry_vertices(const Pose& pose, const Group& group, glm::dvec3* out, const Executor* executor = nullptr);

/// Bounds of everything visible, root system; empty for a scene without visible primitives.
DAabb bounds(const Pose& pose);

/// Corners of a triangle in the root system, in double, not rounded: within half a float ulp of what strategies test.
std::array<glm::dvec3, 3> triangle_corners(const Pose& pose, PrimitiveId id);

/// Unit shading normal of a triangle at barycentric weights (1-u-v, u, v), root system, on the side that the file's
/// normals (or, without them, the winding) define.
/// geometric  the triangle's own unit normal in the root system; used where the file has no normals or where they
///            cancel out
glm::dvec3 shading_normal(const Pose& pose, PrimitiveId id, double u, double v, const glm::dvec3& geometric);

/// Unit outward normal of a quadric at a point on it, root system.
glm::dvec3 quadric_normal(const Pose& pose, PrimitiveId id, const glm::dvec3& point);

}  // namespace firstray::inline v0
