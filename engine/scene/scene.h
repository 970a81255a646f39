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

namespace firstray::inline v0 {

inline constexpr std::uint32_t none = 0xffffffffu;  ///< "no such index" in every index below

/// Whitted's surface: see the shading rule in render/shade.h.
struct Material {
    glm::vec3 ambient{0.2f}, diffuse{0.8f}, specular{0.0f};  ///< shares of light
    float shine = 0.0f;                                      ///< Phong exponent, >= 0
    float transmittance = 0.0f;                              ///< 0 opaque ... 1 clear
    float ior = 0.0f;  ///< index of refraction; 0 and 1 both mean that rays go straight on

    bool transmits() const { return transmittance > 0.0f; }  ///< lets light through
    bool operator==(const Material&) const = default;        ///< all is equal
};

/// A point light without fall-off; `animation` may move it.
struct Light {
    glm::dvec3 position{0.0};        ///< world
    glm::vec3 colour{1.0f};          ///< RGB
    std::uint32_t animation = none;  ///< in Scene::animations
};

/// The view as the scene file gives it; the animation "camera" overrides eye and axes.
struct View {
    glm::dvec3 from{0.0}, at{0.0, 0.0, -1.0}, up{0.0, 1.0, 0.0};  ///< world
    double angle = 45.0;                                          ///< full vertical field of view, degrees, in (0, 180)
    double hither = 1.0;            ///< distance of the near plane along the view axis, > 0
    int width = 512, height = 512;  ///< pixels
};

/// A transform in the scene graph. Node 0 is the root (identity). Parents come before their children.
struct Node {
    std::uint32_t parent = none;     ///< in Scene::nodes
    bool dynamic = false;            ///< moved by its animation; a static node's `parent_from_node` never changes
    Transform parent_from_node;      ///< of a static node
    std::uint32_t animation = none;  ///< of a dynamic node; none: identity for ever
    std::string name;                ///< of a dynamic node
};

/// Primitives that stand together in the file: one mesh, one polygon, one sphere. All have one node and one material.
struct Part {
    std::uint32_t node = 0;        ///< the innermost transform, static or dynamic
    std::uint32_t group = 0;       ///< in Scene::groups
    std::uint32_t material = 0;    ///< in Scene::materials
    std::uint32_t texture = none;  ///< in Scene::textures
    PrimitiveId first = 0;         ///< its primitives are [first, first + count)
    std::uint32_t count = 0;       ///< primitives
    std::uint32_t mesh = none;     ///< number that Meshes gave it
};

/// The primitives directly under one dynamic node that move as one (static nodes fold into their nearest dynamic
/// ancestor); node 0's group is the static scenery. Deforming triangles form a group of their own.
/// Its primitives are [first, first + triangles + quadrics), triangles first.
struct Group {
    std::uint32_t node = 0;  ///< root, or a dynamic node: vertices and quadrics are stored in this node's system
    bool deforming = false;  ///< made of deforming triangles: vertices depend on time in the node's own system too
    bool live = false;       ///< deforming, without keys: the vertices are read from Scene::shared at every update
    PrimitiveId first = 0;   ///< of its primitives
    std::uint32_t triangles = 0, quadrics = 0;     ///< how many
    std::uint32_t first_triangle = 0;              ///< in Scene::triangles
    std::uint32_t first_quadric = 0;               ///< in Scene::quadrics
    std::uint32_t first_vertex = 0, vertices = 0;  ///< see Scene::position
    std::uint32_t first_deforming = 0;  ///< in Scene::deforming; one per triangle of a deforming group with keys

    std::uint32_t primitives() const { return triangles + quadrics; }  ///< of both kinds
};

/// A sphere, cone or cylinder, canonical in a system of its own.
struct Quadric {
    /// Its shape, in the canonical system.
    enum class Kind : std::uint8_t {
        sphere,  ///< x^2 + y^2 + z^2 = 1
        cone     ///< x^2 + y^2 = (r0 + (r1 - r0) z)^2, 0 <= z <= 1, no caps; r0 = r1 is a cylinder
    };
    Kind kind = Kind::sphere;      ///< shape
    bool inside_only = false;      ///< only rays that come from inside see it (a negative radius in the file)
    double r0 = 1.0, r1 = 1.0;     ///< of a cone, at z = 0 and 1
    Transform group_from_quadric;  ///< from the canonical system
};

/// One key of a deforming triangle, without its normals: carrying reads all keys, but no normals.
struct DeformingKey {
    double time = 0.0;       ///< seconds
    glm::dvec3 position[3];  ///< of the corners
};

/// Normals at a key of a deforming triangle, as written, not normalised.
struct DeformingNormals {
    glm::vec3 corner[3];  ///< of the corners
};

/// A triangle given at several times ("tpa"); its keys are [first_key, first_key + keys) of Scene::deforming_keys. The
/// i-th one of a group has the group's vertices 3 i, 3 i + 1 and 3 i + 2.
struct DeformingTriangle {
    std::uint32_t first_key = 0, keys = 0;  ///< in Scene::deforming_keys
};

/// Per triangle: vertices (Scene::position), and indices into normals and uvs or `none`.
struct TriangleIndices {
    glm::uvec3 vertex{0};     ///< numbers as Scene::position
    glm::uvec3 normal{none};  ///< in Scene::normals
    glm::uvec3 uv{none};      ///< in Scene::uvs
};

/// Vertices that stay where the caller has them: Scene::position(first) to position(first + count - 1).
struct SharedVertices {
    std::uint32_t first = 0, count = 0;    ///< vertices, by number
    std::uint32_t through = 0;             ///< vertices shared up to here, these included
    const glm::vec3* positions = nullptr;  ///< outlives the scene
};

/// What the reader met, for `info` and for checks: how often each statement was executed.
struct Census {
    std::vector<std::pair<std::string, std::uint64_t>> statements;  ///< e.g. {"fm", 1849}, in order of first use
    std::uint64_t files = 0;                                        ///< distinct files read
    std::uint64_t bytes = 0;                                        ///< of those
    std::uint64_t digest = 0;  ///< of the text that was read, includes as often as they are executed
    std::uint64_t count(std::string_view statement) const;          ///< 0 where it was not met
};

/// A whole animation, as data. Never changes after it was read; any number of threads may read it.
struct Scene {
    std::string name;    ///< main file's stem, e.g. "Robot"
    std::string folder;  ///< textures are found here

    View view;                              ///< as the file gives it
    glm::vec3 background{0.0f};             ///< what rays see that hit nothing
    glm::vec3 ambient{1.0f};                ///< light from everywhere
    std::vector<Light> lights;              ///< in file order
    double start = 0.0, end = 0.0;          ///< seconds
    int frames = 1;                         ///< >= 1
    std::uint32_t camera_animation = none;  ///< in animations

    std::vector<Node> nodes;            ///< nodes[0] is the root
    std::vector<Animation> animations;  ///< one per name
    std::vector<Material> materials;    ///< distinct
    std::vector<std::string> textures;  ///< distinct file names as written
    std::vector<std::string> texture_places;  ///< where each is named first, "file:line:column: "; or empty
    std::vector<Group> groups;          ///< group 0 is the static scenery (perhaps empty); others are never empty
    std::vector<Part> parts;            ///< ordered by `first`; together they cover all primitives

    std::vector<glm::dvec3> positions;         ///< in the system of their group's node, static nodes already applied
    std::vector<SharedVertices> shared;        ///< ascending; their vertices have no place in `positions`
    std::vector<glm::vec3> normals;            ///< likewise, unit length unless the file's are zero
    std::vector<glm::vec2> uvs;                ///< texture coordinates
    std::vector<TriangleIndices> triangles;    ///< by Scene::triangle_slot; groups stand in order
    std::vector<Quadric> quadrics;             ///< groups stand in order
    std::vector<DeformingTriangle> deforming;  ///< groups stand in order
    std::vector<DeformingKey> deforming_keys;  ///< triangle by triangle
    std::vector<DeformingNormals> deforming_normals;  ///< likewise, by key

    std::vector<std::uint32_t> part_of_primitive;  ///< by PrimitiveId

    /// World point that is the root system's (0,0,0): zero unless the scene lies far from the world's origin compared
    /// to its size. Chosen once, from the pose at `start`, so that coordinates relative to it round finely.
    glm::dvec3 origin{0.0};

    Census census;  ///< what the reader met

    /// A vertex by its number, which `triangles` name; groups stand in order. Where nothing is shared:
    /// positions[vertex].
    glm::dvec3 position(std::uint32_t vertex) const
    {
        return shared.empty() ? positions[vertex] : position_among_shared(vertex);
    }
    std::size_t vertex_count() const;  ///< shared ones included

    std::size_t primitive_count() const { return part_of_primitive.size(); }                 ///< triangles and quadrics
    const Part& part(PrimitiveId id) const { return parts[part_of_primitive[id]]; }          ///< it belongs to
    const Material& material(PrimitiveId id) const { return materials[part(id).material]; }  ///< it is of
    const Group& group(PrimitiveId id) const { return groups[part(id).group]; }              ///< it moves with
    /// Index in `triangles` of a primitive that is a triangle.
    std::uint32_t triangle_slot(PrimitiveId id) const
    {
        const Group& g = group(id);
        return id - g.first + g.first_triangle;
    }
    bool is_triangle(PrimitiveId id) const
    {
        const Group& g = group(id);
        return id - g.first < g.triangles;
    }  ///< or quadric

    /// Time of frame i in [0, frames): start + i (end - start) / (frames - 1).
    double time_of(int frame) const;

private:
    glm::dvec3 position_among_shared(std::uint32_t vertex) const;
};

}  // namespace firstray::inline v0
