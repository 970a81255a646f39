#include "engine/scene/pose.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/core/search_ray.h"

namespace firstray::inline v0 {
namespace {

/// The two keys between which a time lies, and how far between them.
struct Between {
    const Scene& scene;
    std::uint32_t a, b;
    double s;

    glm::dvec3 position(int corner) const
    {
        return scene.deforming_keys[a].position[corner] * (1.0 - s) + scene.deforming_keys[b].position[corner] * s;
    }
    /// Normals blend as written: their lengths are weights (museum's face normals are far shorter than its vertex
    /// normals); only the result is normalised.
    glm::dvec3 normal(int corner) const
    {
        const glm::dvec3 n = glm::dvec3(scene.deforming_normals[a].corner[corner]) * (1.0 - s) +
                             glm::dvec3(scene.deforming_normals[b].corner[corner]) * s;
        const double length = glm::length(n);
        return length > 0.0 ? n / length : n;
    }
};

Between keys_at(const Scene& scene, const DeformingTriangle& triangle, double time)
{
    const std::vector<DeformingKey>& keys = scene.deforming_keys;
    const std::uint32_t first = triangle.first_key, last = first + triangle.keys - 1;
    if (time <= keys[first].time) return {scene, first, first, 0.0};
    for (std::uint32_t i = first; i < last; ++i)
        if (time < keys[i + 1].time)
            return {scene, i, i + 1, (time - keys[i].time) / (keys[i + 1].time - keys[i].time)};
    return {scene, last, last, 0.0};
}

bool has_keys(const Group& group)
{
    return group.deforming && !group.live;
}

const DeformingTriangle& deforming_triangle(const Scene& scene, const Group& group, std::uint32_t index)
{
    return scene.deforming[group.first_deforming + index];
}

/// Rounds a place; returns whether it is in range. By component and without branches: every vertex comes here, and a
/// copy of a whole point would wait for its parts to be written.
template <typename Real>
bool put(const glm::dvec3& place, glm::vec<3, Real, glm::defaultp>& out)
{
    constexpr auto farthest = static_cast<Real>(farthest_place);
    const auto x = static_cast<Real>(place.x), y = static_cast<Real>(place.y), z = static_cast<Real>(place.z);
    out.x = x;
    out.y = y;
    out.z = z;
    const int x_is_in = std::abs(x) <= farthest, y_is_in = std::abs(y) <= farthest, z_is_in = std::abs(z) <= farthest;
    return (x_is_in & y_is_in & z_is_in) != 0;
}

template <typename Real>
bool carry(const Pose& pose, const Group& group, glm::vec<3, Real, glm::defaultp>* out, const Executor* executor)
{
    constexpr std::size_t grain = 16384;
    const Scene& scene = *pose.scene;
    const Transform& root_from_node = pose.root_from_node[group.node];
    std::atomic<bool> all_in_range{true};
    if (!has_keys(group)) {
        for_pieces(executor, group.vertices, grain, [&](std::size_t begin, std::size_t end) {
            const auto first = group.first_vertex + static_cast<std::uint32_t>(begin);
            bool all = true;
            for (std::size_t i = begin; i < end; ++i) {
                const glm::dvec3 from = scene.position(first + static_cast<std::uint32_t>(i - begin));
                all &= put(root_from_node.point(from), out[i]);
            }
            if (!all) all_in_range.store(false, std::memory_order_relaxed);
        });
        return all_in_range;
    }
    // The processor foresees which memory comes next, but not over the ends of pages: keys of a triangle so far ahead
    // are asked for, in this loop, because g++ takes a function that does no more for one that does nothing.
    constexpr std::size_t ahead = 16;
    const std::size_t last_key = scene.deforming_keys.size() - 1;
    for_pieces(executor, group.triangles, grain, [&](std::size_t begin, std::size_t end) {
        bool all = true;
        for (std::size_t i = begin; i < end; ++i) {
            const DeformingTriangle& triangle = deforming_triangle(scene, group, static_cast<std::uint32_t>(i));
            const Between keys = keys_at(scene, triangle, pose.time);
            const DeformingKey& a = scene.deforming_keys[std::min(keys.a + ahead * triangle.keys, last_key)];
            const DeformingKey& b = scene.deforming_keys[std::min(keys.b + ahead * triangle.keys, last_key)];
            __builtin_prefetch(&a.position[0].x);  // two keys in a row: a line of cache each
            __builtin_prefetch(&a.position[2].z);
            __builtin_prefetch(&b.position[2].x);
            for (std::size_t k = 0; k < 3; ++k)
                all &= put(root_from_node.point(keys.position(static_cast<int>(k))), out[3 * i + k]);
        }
        if (!all) all_in_range.store(false, std::memory_order_relaxed);
    });
    return all_in_range;
}

/// Grows the box by a circle: half its extent along an axis is the length of that axis' row.
void grow_by_disc(DAabb& box, const Transform& t, double z, double radius)
{
    const glm::dvec3 centre = t.point({0.0, 0.0, z});
    for (int axis = 0; axis < 3; ++axis) {
        const double half = radius * std::hypot(t.linear[0][axis], t.linear[1][axis]);
        box.lo[axis] = std::min(box.lo[axis], centre[axis] - half);
        box.hi[axis] = std::max(box.hi[axis], centre[axis] + half);
    }
}

void grow_by_quadric(DAabb& box, const Quadric& quadric, const Transform& root_from_quadric)
{
    if (quadric.kind == Quadric::Kind::cone) {
        grow_by_disc(box, root_from_quadric, 0.0, quadric.r0);
        grow_by_disc(box, root_from_quadric, 1.0, quadric.r1);
        return;
    }
    const glm::dmat3 rows = glm::transpose(root_from_quadric.linear);
    const glm::dvec3 half(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    box.grow(root_from_quadric.offset - half);
    box.grow(root_from_quadric.offset + half);
}

void pose_nodes(Pose& pose)
{
    const Scene& scene = *pose.scene;
    pose.root_from_node.resize(scene.nodes.size());
    pose.visible.assign(scene.nodes.size(), 1);
    pose.root_from_node[0].offset = -scene.origin;
    for (std::uint32_t i = 1; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const Animation* animation = node.animation == none ? nullptr : &scene.animations[node.animation];
        const Transform moved = animation ? animation->at(pose.time) : node.parent_from_node;
        pose.root_from_node[i] = pose.root_from_node[node.parent] * moved;
        pose.visible[i] = pose.visible[node.parent] && (!animation || animation->visible_at(pose.time));
        if (pose.visible[i] && is_singular(pose.root_from_node[i])) {
            pose.visible[i] = 0;
            pose.singular_nodes.push_back(i);
        }
    }
}

/// What the animation does not say comes from the view: with a translation alone the direction stays the view's.
CameraPose pose_camera(const Scene& scene, double time)
{
    CameraPose camera;
    camera.eye = scene.view.from;
    camera.forward = glm::normalize(scene.view.at - scene.view.from);
    camera.up = scene.view.up;
    if (scene.camera_animation != none) {
        const Animation& animation = scene.animations[scene.camera_animation];
        if (!animation.translation.empty()) camera.eye = animation.translation.at(time);
        if (!animation.rotation.empty()) {  // the unrotated camera looks along -z, y is up
            const glm::dmat3 rotation = animation.rotation.at(time);
            camera.forward = -rotation[2];
            camera.up = rotation[1];
        }
    }
    camera.eye -= scene.origin;
    camera.right = glm::normalize(glm::cross(camera.forward, camera.up));
    camera.up = glm::cross(camera.right, camera.forward);
    return camera;
}

glm::dvec3 pose_light(const Scene& scene, const Light& light, double time)
{
    const bool moved = light.animation != none && !scene.animations[light.animation].translation.empty();
    return (moved ? scene.animations[light.animation].translation.at(time) : light.position) - scene.origin;
}

/// `n` at length 1, or else `otherwise` at length 1, or else an axis: never a NaN.
glm::dvec3 unit(const glm::dvec3& n, const glm::dvec3& otherwise)
{
    const auto has_direction = [](double length) { return length > 0.0 && std::isfinite(length); };
    if (const double length = glm::length(n); has_direction(length)) return n / length;
    if (const double length = glm::length(otherwise); has_direction(length)) return otherwise / length;
    return {0.0, 0.0, 1.0};
}

}  // namespace

Pose pose(const Scene& scene, double time)
{
    Pose result;
    result.scene = &scene;
    result.time = time;
    pose_nodes(result);
    result.camera = pose_camera(scene, time);
    for (const Light& light : scene.lights) result.lights.push_back(pose_light(scene, light, time));
    return result;
}

bool carry_vertices(const Pose& pose, const Group& group, glm::vec3* out, const Executor* executor)
{
    return carry(pose, group, out, executor);
}

bool carry_vertices(const Pose& pose, const Group& group, glm::dvec3* out, const Executor* executor)
{
    return carry(pose, group, out, executor);
}

DAabb bounds(const Pose& pose)
{
    const Scene& scene = *pose.scene;
    DAabb box;
    std::vector<glm::dvec3> vertices;
    for (const Group& group : scene.groups) {
        if (!pose.is_visible(group)) continue;
        vertices.resize(group.vertices);
        carry_vertices(pose, group, vertices.data());
        for (const glm::dvec3& vertex : vertices) box.grow(vertex);
        for (std::uint32_t i = 0; i < group.quadrics; ++i) {
            const Quadric& quadric = scene.quadrics[group.first_quadric + i];
            grow_by_quadric(box, quadric, pose.root_from_node[group.node] * quadric.group_from_quadric);
        }
    }
    return box;
}

std::array<glm::dvec3, 3> triangle_corners(const Pose& pose, PrimitiveId id)
{
    const Scene& scene = *pose.scene;
    const Group& group = scene.group(id);
    const Transform& root_from_node = pose.root_from_node[group.node];
    std::array<glm::dvec3, 3> corners;
    if (has_keys(group)) {
        const Between keys = keys_at(scene, deforming_triangle(scene, group, id - group.first), pose.time);
        for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = root_from_node.point(keys.position(k));
        return corners;
    }
    const glm::uvec3& vertex = scene.triangles[scene.triangle_slot(id)].vertex;
    for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = root_from_node.point(scene.position(vertex[k]));
    return corners;
}

glm::dvec3 shading_normal(const Pose& pose, PrimitiveId id, double u, double v, const glm::dvec3& geometric)
{
    const Scene& scene = *pose.scene;
    const Group& group = scene.group(id);
    const double weight[3] = {1.0 - u - v, u, v};
    glm::dvec3 normal(0.0);  // in the node's system
    if (has_keys(group)) {
        const Between keys = keys_at(scene, deforming_triangle(scene, group, id - group.first), pose.time);
        for (int k = 0; k < 3; ++k) normal += weight[k] * keys.normal(k);
    } else {
        const glm::uvec3& index = scene.triangles[scene.triangle_slot(id)].normal;
        if (index.x == none) return geometric;
        for (int k = 0; k < 3; ++k) normal += weight[k] * glm::dvec3(scene.normals[index[k]]);
    }
    return unit(normal_matrix(pose.root_from_node[group.node]) * normal, geometric);
}

glm::dvec3 quadric_normal(const Pose& pose, PrimitiveId id, const glm::dvec3& point)
{
    const Scene& scene = *pose.scene;
    const Group& group = scene.group(id);
    const Quadric& quadric = scene.quadrics[group.first_quadric + (id - group.first - group.triangles)];
    const Transform root_from_quadric = pose.root_from_node[group.node] * quadric.group_from_quadric;
    const glm::dvec3 p = inverse(root_from_quadric).point(point);
    glm::dvec3 gradient = p;
    if (quadric.kind == Quadric::Kind::cone) {
        const double slope = quadric.r1 - quadric.r0;
        gradient.z = -slope * (quadric.r0 + slope * p.z);
    }
    const glm::dmat3 normals = normal_matrix(root_from_quadric);
    return unit(normals * gradient, normals[2]);  // a cone's tip has no normal: its axis
}

}  // namespace firstray::inline v0
