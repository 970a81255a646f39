#include "engine/render/surface.h"

#include <algorithm>
#include <cmath>

namespace firstray::inline v0 {
namespace {

/// The place in a triangle's texture, if it has one, at barycentric weights.
TexturePlace place_in_texture(const Scene& scene, const Part& part, std::span<const Texture> textures,
                              const RayHit& hit)
{
    if (part.texture == none) return {};
    const glm::uvec3& corner = scene.triangles[scene.triangle_slot(hit.primitive)].uv;
    if (corner[0] == none) return {};
    const auto u = static_cast<float>(hit.u), v = static_cast<float>(hit.v);
    const glm::vec2 uv = (1.0f - u - v) * scene.uvs[corner[0]] + u * scene.uvs[corner[1]] + v * scene.uvs[corner[2]];
    return textures[part.texture].at(uv);
}

/// The point comes from the corners, not from t: it then lies in the triangle's plane however coarse t is.
void place_on_triangle(const Pose& pose, const RayHit& hit, Surface& s)
{
    const auto corners = triangle_corners(pose, hit.primitive);
    s.point = (1.0 - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
    s.geometric = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(s.geometric);
    // Corners that only rounding moved apart make a triangle that can be hit but has no normal here.
    s.geometric = length > 0.0 ? s.geometric * (1.0 / length) : -s.direction;
    s.normal = shading_normal(pose, hit.primitive, hit.u, hit.v, s.geometric);
    for (const glm::dvec3& corner : corners) s.extent = std::max(s.extent, largest_coordinate(corner));
}

/// Likewise, the point is pulled onto the quadric along its radius: off a small sphere far away, t is worth little.
void place_on_quadric(const Pose& pose, const RayHit& hit, Surface& s)
{
    const Scene& scene = *pose.scene;
    const Group& group = scene.group(hit.primitive);
    const Quadric& quadric = scene.quadrics[group.first_quadric + (hit.primitive - group.first - group.triangles)];
    const Transform root_from_quadric = pose.root_from_node[group.node] * quadric.group_from_quadric;
    glm::dvec3 p = inverse(root_from_quadric).point(hit.origin + hit.t * hit.direction);
    if (quadric.kind == Quadric::Kind::sphere) {
        p = glm::normalize(p);
    } else if (const double radius = std::hypot(p.x, p.y); radius > 0.0) {
        const double onto = (quadric.r0 + (quadric.r1 - quadric.r0) * p.z) / radius;
        p = {p.x * onto, p.y * onto, p.z};
    }
    s.point = root_from_quadric.point(p);
    s.geometric = s.normal = quadric_normal(pose, hit.primitive, s.point);
    s.extent = largest_coordinate(root_from_quadric.offset);
}

}  // namespace

Surface surface_at(const Pose& pose, std::span<const Texture> textures, const RayHit& hit)
{
    const Scene& scene = *pose.scene;
    const Part& part = scene.part(hit.primitive);
    Surface s;
    s.origin = hit.origin;
    s.direction = glm::normalize(hit.direction);
    s.material = &scene.materials[part.material];
    if (scene.is_triangle(hit.primitive)) {
        place_on_triangle(pose, hit, s);
        s.place = place_in_texture(scene, part, textures, hit);
    } else {
        place_on_quadric(pose, hit, s);
    }
    s.extent = std::max(s.extent, largest_coordinate(s.point));
    s.from_outside = glm::dot(s.geometric, hit.direction) < 0.0;
    if (!s.from_outside) s.geometric = -s.geometric;
    if (glm::dot(s.normal, hit.direction) > 0.0) s.normal = -s.normal;
    return s;
}

}  // namespace firstray::inline v0
