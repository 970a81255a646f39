#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace firstray::inline v0 {

/// Where a mesh's vertices are read.
enum class Vertices : std::uint8_t {
    copied,  ///< copied when the mesh is added
    shared,  ///< in the caller's memory, which stays as it is for as long as the scene is in use
    live     ///< in the caller's memory, which may change between a trace and the next update: the mesh deforms
};

/// Triangles in the system of the group that they are added to. Counter-clockwise or not: both sides are hit.
struct Mesh {
    std::span<const glm::vec3> positions{};  ///< of the corners
    std::span<const glm::uvec3> indices{};   ///< a triangle's three positions; copied
    Vertices vertices = Vertices::copied;    ///< of `positions`
    Material material{};                     ///< for rays, only whether it transmits light matters (RayMask)
};

/// Makes a scene of a program's own meshes. What moves as one is a group; everything else is scenery. Where groups are
/// is said each frame, see BasicTracer::update.
class Meshes {
public:
    static constexpr std::uint32_t scenery = 0;  ///< the group that stands still

    /// A group that has a transform of its own.
    /// name     for people, e.g. in the outline of a structure
    /// returns  its number; they count from 1
    std::uint32_t add_group(std::string name = {});

    /// Adds a mesh to a group. Positions that no triangle names may be anything; those between others that are named
    /// cost memory and, where they move, time.
    /// returns  its number; they count from 0
    /// throws   Error (Fault::usage) for an index or a group that does not exist and for a vertex that is not finite;
    ///          LimitError for more vertices or triangles than 32 bits can count. Nothing is added then.
    std::uint32_t add(const Mesh& mesh, std::uint32_t group = scenery);

    std::uint32_t groups() const { return static_cast<std::uint32_t>(names_.size()); }   ///< the scenery included
    std::uint32_t meshes() const { return static_cast<std::uint32_t>(drafts_.size()); }  ///< added so far

    /// The scene so far. It holds copies of all but shared and live vertices.
    Scene scene() const;

private:
    /// A mesh and the positions that it uses: of a copied one, `copy`.
    struct Draft {
        std::uint32_t group = 0;
        Vertices vertices = Vertices::copied;
        Material material;
        std::vector<glm::vec3> copy;
        std::span<const glm::vec3> lent;  ///< of one that is not copied
        std::vector<glm::uvec3> indices;  ///< into these positions

        std::span<const glm::vec3> positions() const { return vertices == Vertices::copied ? copy : lent; }
    };

    static void append(const Draft& draft, std::uint32_t number, Scene& scene);
    void append_group(std::uint32_t group, bool live, Scene& scene) const;

    std::vector<std::string> names_{"scenery"};
    std::vector<Draft> drafts_;
    std::uint64_t vertices_ = 0, triangles_ = 0;
};

}  // namespace firstray::inline v0
