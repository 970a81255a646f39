#pragma once
#include <glm/glm.hpp>

#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/aff/lexer.h"
#include "engine/aff/reader.h"
#include "engine/scene/scene.h"

namespace firstray::inline v0 {

/// Triangles of one statement, in the system of the innermost open transform; indices count from 0 in these lists.
struct TriangleList {
    std::vector<glm::dvec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<TriangleIndices> triangles;
    std::uint32_t texture = none;
};

/// Collects a scene in file order: knows the open transforms and the current material, bakes static transforms, and in
/// the end sorts primitives by group.
class SceneBuilder {
public:
    explicit SceneBuilder(const ReadLimits& limits);

    Scene scene;        ///< settings (view, lights, times ...) are written here directly
    Material material;  ///< of what is added next. One global state: braces and includes do not restore it

    void count(std::string_view statement);
    /// Throws LimitError if `primitives` more would be too many; to be asked before reading them.
    void check_room(std::size_t primitives, const Lexer& in) const;
    /// The same of vertices, or of normals or texture coordinates, whose lists are `list` long.
    void check_vertices(std::size_t more, std::size_t list, const Lexer& in) const;

    void open_static(const Transform& parent_from_node, const Lexer& in);
    void open_dynamic(const std::string& name, const Lexer& in);
    void close() { open_.pop_back(); }
    std::size_t depth() const { return open_.size() - 1; }  ///< transforms open
    bool inside_dynamic() const { return open_.back().owner != 0; }
    /// From the innermost open transform to the nearest dynamic one around it, or to the world.
    const Transform& owner_from_open() const { return open_.back().owner_from_node; }

    /// in  where its name was read
    std::uint32_t texture(const std::string& name, const Lexer& in);
    void add(TriangleList list, const Lexer& in);
    void add(Quadric quadric, const Lexer& in);  ///< group_from_quadric: open_from_quadric
    void add(std::vector<DeformingKey> keys, std::vector<DeformingNormals> normals, const Lexer& in);
    void set_animation(Animation animation);                      ///< replaces an earlier one of the same name
    void add_light(const Light& light, const std::string& name, const Lexer& in);  ///< name: empty unless animated

    /// The finished scene. The builder is used up.
    Scene finish();

private:
    struct Open {
        std::uint32_t node = 0;   // innermost transform
        std::uint32_t owner = 0;  // its nearest dynamic ancestor (or itself), or the root
        Transform owner_from_node;
    };
    /// What will be a group; `first` of the parts and vertex indices count from 0 here.
    struct Draft {
        std::vector<glm::dvec3> positions;
        std::vector<TriangleIndices> triangles;
        std::vector<Quadric> quadrics;
        std::vector<DeformingTriangle> deforming;
        std::vector<Part> triangle_parts, quadric_parts;
    };

    Draft& draft(bool deforming) { return drafts_[{open_.back().owner, deforming}]; }
    void push_node(Node node, const Open& open, const Lexer& in);
    glm::dvec3 baked(const glm::dvec3& point, const Lexer& in) const;
    std::uint32_t add_normal(const glm::dvec3& normal);
    Part make_part(std::size_t first, std::size_t count, std::uint32_t texture);
    std::uint32_t material_index();
    void append_group(std::uint32_t node, bool deforming, Draft draft);
    void append_parts(const std::vector<Part>& parts, PrimitiveId first);
    std::uint32_t animation_named(const std::string& name) const;

    struct MaterialHash {
        std::size_t operator()(const Material& material) const;
    };

    const ReadLimits& limits_;
    std::uint64_t primitives_ = 0, vertices_ = 0;
    std::vector<Open> open_{Open{}};
    std::map<std::pair<std::uint32_t, bool>, Draft> drafts_;  // by owner and deforming: the order of groups
    std::unordered_map<Material, std::uint32_t, MaterialHash> materials_;
    std::unordered_map<std::string, std::uint32_t> textures_, animations_;
    std::vector<std::pair<std::size_t, std::string>> animated_lights_;  // index and name
};

}  // namespace firstray::inline v0
