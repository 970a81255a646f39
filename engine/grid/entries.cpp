#include "engine/grid/entries.h"

#include <cmath>

#include "engine/primitive/triangle_pack.h"

namespace firstray::inline v0 {
namespace {

Aabb rounded_outwards(const DAabb& box)
{
    Aabb result;
    for (int axis = 0; axis < 3; ++axis) {
        result.lo[axis] = std::nextafter(static_cast<float>(box.lo[axis]), -std::numeric_limits<float>::infinity());
        result.hi[axis] = std::nextafter(static_cast<float>(box.hi[axis]), std::numeric_limits<float>::infinity());
    }
    return result;
}

void use_corners(GridEntries& entries, const RootGeometry<float>& geometry, const std::vector<PrimitiveId>&,
                 const Executor*)
{
    entries.vertices = geometry.vertices();
    entries.corners = geometry.corners();
}

/// Rounds what is held in double.
void use_corners(GridEntries& entries, const RootGeometry<double>& geometry, const std::vector<PrimitiveId>& triangles,
                 const Executor* executor)
{
    entries.own_vertices.reserve(3 * triangles.size() + 1);
    entries.own_vertices.resize(3 * triangles.size());
    for_pieces(executor, triangles.size(), 8192, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const RootTriangle<double> t = geometry.triangle(triangles[i]);
            for (std::size_t k = 0; k < 3; ++k) entries.own_vertices[3 * i + k] = glm::vec3(t.v[k]);
        }
    });
}

}  // namespace

RootTriangle<float> GridEntries::triangle(std::uint32_t entry) const
{
    const PlacedTriangle at = placed(entry);
    const glm::vec3 &v0 = points()[at.corner[0]], &v1 = points()[at.corner[1]], &v2 = points()[at.corner[2]];
    return {{v0, v1, v2}, longest_edge<float>(v0, v1, v2)};
}

Aabb GridEntries::box(std::uint32_t entry) const
{
    if (!is_triangle(entry)) return quadric_boxes[entry - triangles];
    const RootTriangle<float> t = triangle(entry);
    return {glm::min(glm::min(t.v[0], t.v[1]), t.v[2]), glm::max(glm::max(t.v[0], t.v[1]), t.v[2])};
}

void look_up(const GridEntries& entries, std::span<const std::uint32_t> triangles, PlacedTriangle* into)
{
    for (std::size_t i = 0; i < triangles.size(); ++i) into[i] = entries.placed(triangles[i]);
}

void place(const GridEntries& entries, std::span<const std::uint32_t> triangles, PlacedTriangles& into)
{
    into.resize(triangles.size());
    const glm::vec3* const points = entries.points();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        into[i] = entries.placed(triangles[i]);
        __builtin_prefetch(&points[into[i].corner[0]]);
        __builtin_prefetch(&points[into[i].corner[2]]);
    }
    if (!triangles.empty()) into.repeat_last();
}

template <typename Real>
void make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor,
                  GridEntries& into)
{
    const std::vector<PrimitiveId>& triangles = primitives.triangles;
    into.quadric_boxes.clear();
    resize_for_overwrite(into.ids, triangles.size());
    into.triangles = static_cast<std::uint32_t>(triangles.size());
    for_pieces(executor, triangles.size(), 65536, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            into.ids[i] = triangles[i] | (geometry.transmits(triangles[i]) ? transmitting_bit : 0);
    });
    use_corners(into, geometry, triangles, executor);
    for (const PrimitiveId id : primitives.quadrics) add_quadric(into, geometry.quadric(id));
}

template <typename Real>
GridEntries make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor)
{
    GridEntries entries;
    make_entries(geometry, primitives, executor, entries);
    return entries;
}

void add_triangle(GridEntries& entries, const RootTriangle<float>& triangle, PrimitiveId id, bool transmits)
{
    for (const glm::vec3& corner : triangle.v) entries.own_vertices.push_back(corner);
    if (entries.own_vertices.capacity() == entries.own_vertices.size())
        entries.own_vertices.reserve(2 * entries.own_vertices.size());
    entries.ids.push_back(id | (transmits ? transmitting_bit : 0));
    ++entries.triangles;
}

void add_quadric(GridEntries& entries, const RootQuadric& quadric)
{
    entries.ids.push_back(quadric.id);
    entries.quadric_boxes.push_back(rounded_outwards(quadric.bounds));
}

template void make_entries(const RootGeometry<float>&, const PrimitiveList&, const Executor*, GridEntries&);
template void make_entries(const RootGeometry<double>&, const PrimitiveList&, const Executor*, GridEntries&);
template GridEntries make_entries(const RootGeometry<float>&, const PrimitiveList&, const Executor*);
template GridEntries make_entries(const RootGeometry<double>&, const PrimitiveList&, const Executor*);

}  // namespace firstray::inline v0
