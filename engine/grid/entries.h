#pragma once
#include <cstdint>

#include "engine/core/aabb.h"
#include "engine/core/aligned.h"
#include "engine/core/executor.h"
#include "engine/strategy/root_geometry.h"

namespace firstray::inline v0 {

/// What is put into grids, in order: triangles in float, then quadrics. An *entry* is an index into these.
struct GridEntries {
    RawVector<Aabb> boxes;                     ///< of all entries
    RawVector<RootTriangle<float>> triangles;  ///< of the first entries; the others are quadrics
    RawVector<std::uint32_t> ids;              ///< of all entries: PrimitiveId; of triangles with transmitting_bit
    Aabb room;                                 ///< the top grid covers at least this
    float blur = 0.0f;  ///< how far the primitives that are tested may be from these, per coordinate
    float pad = 0.0f;   ///< boxes count as wider by it, on all sides; set by build_grid

    std::uint32_t count() const { return static_cast<std::uint32_t>(boxes.size()); }
    bool is_triangle(std::uint32_t entry) const { return entry < triangles.size(); }
    std::uint64_t bytes() const
    {
        return boxes.capacity() * sizeof(Aabb) + triangles.capacity() * sizeof(RootTriangle<float>) +
               4 * ids.capacity();
    }
};

/// Primitives of groups that are carried, in the root system.
template <typename Real>
GridEntries make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor);

/// Appends a triangle; all of them must come before the first quadric.
void add_triangle(GridEntries& entries, const RootTriangle<float>& triangle, PrimitiveId id, bool transmits);
void add_quadric(GridEntries& entries, const RootQuadric& quadric);

}  // namespace firstray::inline v0
