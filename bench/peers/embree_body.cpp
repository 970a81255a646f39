#include "bench/peers/embree_body.h"

#include "bench/peers/embree_query.h"

namespace firstray::peers {
namespace {

static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12, "Embree reads them as packed triples");

unsigned mask_of(unsigned slot)
{
    return slot == Body::opaque_triangles || slot == Body::opaque_quadrics ? opaque_bit : transmitting_bit;
}

bool holds_triangles(unsigned slot)
{
    return slot == Body::opaque_triangles || slot == Body::transmitting_triangles;
}

Body::Slot slot_of(const Scene& scene, PrimitiveId id, bool triangle)
{
    const bool transmits = scene.material(id).transmits();
    if (triangle) return transmits ? Body::transmitting_triangles : Body::opaque_triangles;
    return transmits ? Body::transmitting_quadrics : Body::opaque_quadrics;
}

/// Lets rays pass what transmits where they are asked to.
void pass_transmitting(const RTCFilterFunctionNArguments* args)
{
    for (unsigned i = 0; i < args->N; ++i)
        if (args->valid[i] && note_passing(args->context, args->ray, args->N, i)) args->valid[i] = 0;
}

template <typename T>
std::uint64_t bytes_of(const std::vector<T>& values)
{
    return values.capacity() * sizeof(T);
}

}  // namespace

Body::Body(const Device& device, const BuildChoice& choice)
    : device_(device), choice_(choice), scene_(device.new_scene(choice))
{
}

void Body::clear()
{
    for (unsigned slot = 0; slot < slots; ++slot) {
        Part& part = parts_[slot];
        if (part.geometry) rtcDetachGeometry(scene_.get(), slot);
        part.geometry.reset();
        part.primitives.clear();
        part.indices.clear();
        part.quadrics.clear();
        part.owners.clear();
    }
    vertex_count_ = 0;
}

void Body::list(const Scene& scene, std::span<const std::uint32_t> groups)
{
    clear();
    for (std::uint32_t owner = 0; owner < groups.size(); ++owner) {
        const Group& group = scene.groups[groups[owner]];
        list_group(scene, group, owner, static_cast<std::uint32_t>(vertex_count_));
        vertex_count_ += group.vertices;
    }
    vertices_.resize(vertex_count_ + 1);
    for (Part& part : parts_) part.quadrics.resize(part.owners.size());
    for (unsigned slot = 0; slot < slots; ++slot)
        if (!parts_[slot].primitives.empty()) attach(Slot(slot));
}

void Body::list_group(const Scene& scene, const Group& group, std::uint32_t owner, std::uint32_t first_vertex)
{
    for (std::uint32_t i = 0; i < group.primitives(); ++i) {
        const PrimitiveId id = group.first + i;
        const bool triangle = i < group.triangles;
        Part& part = parts_[slot_of(scene, id, triangle)];
        part.primitives.push_back(id);
        if (triangle)
            part.indices.push_back(scene.triangles[group.first_triangle + i].vertex - group.first_vertex +
                                   first_vertex);
        else
            part.owners.push_back(owner);
    }
}

void Body::attach(Slot slot)
{
    Part& part = parts_[slot];
    const bool triangles = holds_triangles(slot);
    part.geometry =
        device_.new_geometry(triangles ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_USER, choice_.quality);
    RTCGeometry geometry = part.geometry.get();
    if (triangles) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices_.data(), 0,
                                   sizeof(glm::vec3), vertex_count_);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, part.indices.data(), 0,
                                   sizeof(glm::uvec3), part.indices.size());
        if (mask_of(slot) == transmitting_bit) rtcSetGeometryOccludedFilterFunction(geometry, &pass_transmitting);
    } else {
        set_quadrics(geometry, part.quadrics);
    }
    rtcSetGeometryMask(geometry, mask_of(slot));
    rtcAttachGeometryByID(scene_.get(), geometry, slot);
}

void Body::touch()
{
    for (unsigned slot = 0; slot < slots; ++slot)
        if (parts_[slot].geometry && holds_triangles(slot))
            rtcUpdateGeometryBuffer(parts_[slot].geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
}

void Body::place_quadrics(const Scene& scene, std::span<const Transform> body_from_group)
{
    for (Part& part : parts_)
        for (std::size_t i = 0; i < part.owners.size(); ++i) {
            const PrimitiveId id = part.primitives[i];
            const Group& group = scene.group(id);
            const Quadric& quadric = scene.quadrics[id - group.first - group.triangles + group.first_quadric];
            part.quadrics[i] =
                place_quadric(quadric, body_from_group[part.owners[i]], id, scene.material(id).transmits());
        }
}

void Body::commit()
{
    for (const Part& part : parts_)
        if (part.geometry) rtcCommitGeometry(part.geometry.get());
    device_.commit(scene_.get());
}

unsigned Body::mask() const
{
    unsigned mask = 0;
    for (unsigned slot = 0; slot < slots; ++slot)
        if (parts_[slot].geometry) mask |= mask_of(slot);
    return mask;
}

std::uint64_t Body::primitives() const
{
    std::uint64_t count = 0;
    for (const Part& part : parts_) count += part.primitives.size();
    return count;
}

std::uint64_t Body::bytes() const
{
    std::uint64_t bytes = bytes_of(vertices_);
    for (const Part& part : parts_)
        bytes += bytes_of(part.primitives) + bytes_of(part.indices) + bytes_of(part.quadrics) + bytes_of(part.owners);
    return bytes;
}

}  // namespace firstray::peers
