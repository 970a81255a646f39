#include "engine/grid/entries.h"

#include <cmath>

#include "engine/primitive/triangle_pack.h"

namespace firstray::inline v0 {
namespace {

RootTriangle<float> rounded(const RootTriangle<float>& t)
{
    return t;
}

RootTriangle<float> rounded(const RootTriangle<double>& t)
{
    const glm::vec3 v0(t.v[0]), v1(t.v[1]), v2(t.v[2]);
    return {{v0, v1, v2}, longest_edge<float>(v0, v1, v2)};
}

Aabb bounds_of(const RootTriangle<float>& t)
{
    return {glm::min(glm::min(t.v[0], t.v[1]), t.v[2]), glm::max(glm::max(t.v[0], t.v[1]), t.v[2])};
}

Aabb rounded_outwards(const DAabb& box)
{
    Aabb result;
    for (int axis = 0; axis < 3; ++axis) {
        result.lo[axis] = std::nextafter(static_cast<float>(box.lo[axis]), -std::numeric_limits<float>::infinity());
        result.hi[axis] = std::nextafter(static_cast<float>(box.hi[axis]), std::numeric_limits<float>::infinity());
    }
    return result;
}

}  // namespace

template <typename Real>
GridEntries make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor)
{
    GridEntries entries;
    const std::vector<PrimitiveId>& triangles = primitives.triangles;
    entries.triangles.resize(triangles.size());
    entries.ids.resize(triangles.size());
    entries.boxes.resize(triangles.size());
    for_pieces(executor, triangles.size(), 8192, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const PrimitiveId id = triangles[i];
            const RootTriangle<float> t = rounded(geometry.triangle(id));
            entries.triangles[i] = t;
            entries.ids[i] = id | (geometry.transmits(id) ? transmitting_bit : 0);
            entries.boxes[i] = bounds_of(t);
        }
    });
    for (const PrimitiveId id : primitives.quadrics) add_quadric(entries, geometry.quadric(id));
    return entries;
}

void add_triangle(GridEntries& entries, const RootTriangle<float>& triangle, PrimitiveId id, bool transmits)
{
    entries.triangles.push_back(triangle);
    entries.ids.push_back(id | (transmits ? transmitting_bit : 0));
    entries.boxes.push_back(bounds_of(triangle));
}

void add_quadric(GridEntries& entries, const RootQuadric& quadric)
{
    entries.ids.push_back(quadric.id);
    entries.boxes.push_back(rounded_outwards(quadric.bounds));
}

template GridEntries make_entries(const RootGeometry<float>&, const PrimitiveList&, const Executor*);
template GridEntries make_entries(const RootGeometry<double>&, const PrimitiveList&, const Executor*);

}  // namespace firstray::inline v0
