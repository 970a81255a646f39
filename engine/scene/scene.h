#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/core/ray_tile.h"
#include "engine/core/transform.h"
#include "engine/scene/track.h"

namespace firstray {

inline constexpr std::uint32_t none = 0xffffffffu;  ///< "no such index" in every index below

/// Whitted's surface: see the shading rule in render/shade.h.
struct Material {
    glm::vec3 ambient{0.2f}, diffuse{0.8f}, specular{0.0f};
    float shine = 0.0f;          ///< Phong exponent, >= 0
    float transmittance = 0.0f;  ///< 0 opaque ... 1 clear
    float ior = 0.0f;            ///< index of refraction; 0 and 1 both mean that rays go straight on

    bool transmits() const { return transmittance > 0.0f; }
    bool operator==(const Material&) const = default;
};

/// A point light without fall-off; `animation` may move it.
struct Light {
    glm::dvec3 position{0.0};  ///< world
    glm::vec3 colour{1.0f};
    std::uint32_t animation = none;
};

/// The view as the scene file gives it; the animation "camera" overrides eye and axes.
struct View {
    glm::dvec3 from{0.0}, at{0.0, 0.0, -1.0}, up{0.0, 1.0, 0.0};
    double angle = 45.0;  ///< full vertical field of view, degrees, in (0, 180)
    double hither = 1.0;  ///< distance of the near plane along the view axis, > 0
    int width = 512, height = 512;
};

/// A transform in the scene graph. Node 0 is the root (identity). Parents come before their children.
struct Node {
    std::uint32_t parent = none;
    bool dynamic = false;            ///< moved by its animation; a static node's `parent_from_node` never changes
    Transform parent_from_node;      ///< of a static node
    std::uint32_t animation = none;  ///< of a dynamic node; none: identity for ever
    std::string name;                ///< of a dynamic node
};

/// Primitives that stand together in the file: one mesh, one polygon, one sphere. All have one node and one material.
struct Part {
    std::uint32_t node = 0;     ///< the innermost transform, static or dynamic
    std::uint32_t group = 0;
    std::uint32_t material = 0;
    std::uint32_t texture = none;
    PrimitiveId first = 0;      ///< its primitives are [first, first + count)
    std::uint32_t count = 0;
};

/// The primitives directly under one dynamic node that move as one (static nodes fold into their nearest dynamic
/// ancestor); node 0's group is the static scenery. Deforming triangles form a group of their own.
/// Its primitives are [first, first + triangles + quadrics), triangles first.
struct Group {
    std::uint32_t node = 0;  ///< root, or a dynamic node: vertices and quadrics are stored in this node's system
    bool deforming = false;  ///< made of deforming triangles: vertices depend on time in the node's own system too
    PrimitiveId first = 0;
    std::uint32_t triangles = 0, quadrics = 0;
    std::uint32_t first_triangle = 0;                 ///< in Scene::triangles
    std::uint32_t first_quadric = 0;                  ///< in Scene::quadrics
    std::uint32_t first_vertex = 0, vertices = 0;     ///< in Scene::positions
    std::uint32_t first_deforming = 0;                ///< in Scene::deforming; one per triangle of a deforming group

    std::uint32_t primitives() const { return triangles + quadrics; }
};

/// A sphere, cone or cylinder, canonical in a system of its own.
struct Quadric {
    enum class Kind : std::uint8_t {
        sphere,  ///< x^2 + y^2 + z^2 = 1
        cone     ///< x^2 + y^2 = (r0 + (r1 - r0) z)^2, 0 <= z <= 1, no caps; r0 = r1 is a cylinder
    };
    Kind kind = Kind::sphere;
    bool inside_only = false;  ///< only rays that come from inside see it (a negative radius in the file)
    double r0 = 1.0, r1 = 1.0;
    Transform group_from_quadric;
};

/// One key of a deforming triangle. Normals as written, not normalised.
struct DeformingKey {
    double time = 0.0;
    glm::dvec3 position[3];
    glm::vec3 normal[3];
};

/// A triangle given at several times ("tpa"); its keys are [first_key, first_key + keys) of Scene::deforming_keys.
struct DeformingTriangle {
    std::uint32_t first_key = 0, keys = 0;
};

/// Per triangle: indices into Scene::positions, and into normals and uvs or `none`.
struct TriangleIndices {
    glm::uvec3 vertex{0};
    glm::uvec3 normal{none};
    glm::uvec3 uv{none};
};

/// What the reader met, for `info` and for checks: how often each statement was executed.
struct Census {
    std::vector<std::pair<std::string, std::uint64_t>> statements;  ///< e.g. {"fm", 1849}, in order of first use
    std::uint64_t files = 0;                                        ///< distinct files read
    std::uint64_t bytes = 0;                                        ///< of those
    std::uint64_t digest = 0;  ///< of the text that was read, includes as often as they are executed
    std::uint64_t count(std::string_view statement) const;
};

/// A whole animation, as data. Never changes after it was read; any number of threads may read it.
struct Scene {
    std::string name;    ///< main file's stem, e.g. "Robot"
    std::string folder;  ///< textures are found here

    View view;
    glm::vec3 background{0.0f};
    glm::vec3 ambient{1.0f};
    std::vector<Light> lights;
    double start = 0.0, end = 0.0;  ///< seconds
    int frames = 1;                 ///< >= 1
    std::uint32_t camera_animation = none;

    std::vector<Node> nodes;  ///< nodes[0] is the root
    std::vector<Animation> animations;
    std::vector<Material> materials;    ///< distinct
    std::vector<std::string> textures;  ///< distinct file names as written
    std::vector<std::string> texture_places;  ///< where each is named first, "file:line:column: "; or empty
    std::vector<Group> groups;          ///< group 0 is the static scenery (perhaps empty); others are never empty
    std::vector<Part> parts;            ///< ordered by `first`; together they cover all primitives

    std::vector<glm::dvec3> positions;  ///< in the system of their group's node, static nodes already applied
    std::vector<glm::vec3> normals;     ///< likewise, unit length unless the file's are zero
    std::vector<glm::vec2> uvs;
    std::vector<TriangleIndices> triangles;    ///< by Scene::triangle_slot; groups stand in order
    std::vector<Quadric> quadrics;
    std::vector<DeformingTriangle> deforming;  ///< their `triangles` entries have a vertex triple of their own each
    std::vector<DeformingKey> deforming_keys;

    std::vector<std::uint32_t> part_of_primitive;  ///< by PrimitiveId

    /// World point that is the root system's (0,0,0): zero unless the scene lies far from the world's origin compared
    /// to its size. Chosen once, from the pose at `start`, so that coordinates relative to it round finely.
    glm::dvec3 origin{0.0};

    Census census;

    std::size_t primitive_count() const { return part_of_primitive.size(); }
    const Part& part(PrimitiveId id) const { return parts[part_of_primitive[id]]; }
    const Material& material(PrimitiveId id) const { return materials[part(id).material]; }
    const Group& group(PrimitiveId id) const { return groups[part(id).group]; }
    /// Index in `triangles` of a primitive that is a triangle.
    std::uint32_t triangle_slot(PrimitiveId id) const
    {
        const Group& g = group(id);
        return id - g.first + g.first_triangle;
    }
    bool is_triangle(PrimitiveId id) const { const Group& g = group(id); return id - g.first < g.triangles; }

    /// Time of frame i in [0, frames): start + i (end - start) / (frames - 1).
    double time_of(int frame) const;
};

}  // namespace firstray
