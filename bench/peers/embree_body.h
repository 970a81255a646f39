#pragma once
#include <array>
#include <span>
#include <vector>

#include "bench/peers/embree_device.h"
#include "bench/peers/embree_quadrics.h"
#include "engine/scene/pose.h"

namespace firstray::peers {

/// Ray and geometry masks: Embree tests a geometry where they share a bit.
enum MaskBits : unsigned { opaque_bit = 1, transmitting_bit = 2, all_bits = opaque_bit | transmitting_bit };

/// An Embree scene over the primitives of some groups, all in one system ("body"). A geometry holds primitives that are
/// of one kind and look alike to a RayMask, so there are at most four; those without primitives are not attached.
class Body {
public:
    /// A geometry's id in the scene.
    enum Slot : unsigned { opaque_triangles, transmitting_triangles, opaque_quadrics, transmitting_quadrics, slots };

    Body(const Device& device, const BuildChoice& choice);

    /// Lists the primitives anew. To be followed by placing vertices and quadrics, then commit().
    void list(const Scene& scene, std::span<const std::uint32_t> groups);
    /// Room for the vertices of the listed groups, one behind the other, in the order they were listed. Call touch()
    /// after writing.
    std::span<glm::vec3> vertices() { return {vertices_.data(), vertex_count_}; }
    void touch();
    /// Places the quadrics of the listed groups.
    /// body_from_group  by index into `groups` of list()
    void place_quadrics(const Scene& scene, std::span<const Transform> body_from_group);
    /// Builds.
    /// throws Error
    void commit();

    RTCScene scene() const { return scene_.get(); }
    unsigned mask() const;  ///< bits of the geometries that are there
    PrimitiveId primitive(unsigned geometry, unsigned index) const { return parts_[geometry].primitives[index]; }
    std::uint64_t primitives() const;
    std::uint64_t bytes() const;  ///< ours; Embree's are the device's

private:
    struct Part {
        GeometryHandle geometry;  // null where it is not attached
        std::vector<PrimitiveId> primitives;
        std::vector<glm::uvec3> indices;    // triangles: into vertices_
        std::vector<RootQuadric> quadrics;  // quadrics
        std::vector<std::uint32_t> owners;  // quadrics: which of the listed groups has each
    };
    void clear();
    void list_group(const Scene& scene, const Group& group, std::uint32_t owner, std::uint32_t first_vertex);
    void attach(Slot slot);

    const Device& device_;
    BuildChoice choice_;
    SceneHandle scene_;
    std::array<Part, slots> parts_;
    std::vector<glm::vec3> vertices_;  // one more than vertex_count_: Embree reads 16 bytes for the last one
    std::size_t vertex_count_ = 0;
};

}  // namespace firstray::peers
