#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/core/aligned.h"
#include "engine/core/executor.h"
#include "engine/primitive/triangle_pack.h"
#include "engine/strategy/root_geometry.h"

namespace firstray::inline v0 {

/// A triangle as packs are filled with it.
struct PlacedTriangle {
    std::uint32_t corner[3];  ///< in GridEntries::points()
    std::uint32_t id;         ///< with transmitting_bit
};

/// What is put into grids, in order: triangles in float, then quadrics. An *entry* is an index into these. Corners of
/// triangles are read where the geometry keeps them, which must outlive this, or are held here.
struct GridEntries {
    RawVector<std::uint32_t> ids;         ///< PrimitiveIds; of triangles with transmitting_bit
    std::uint32_t triangles = 0;          ///< how many come first
    std::vector<Aabb> quadric_boxes;      ///< by entry less `triangles`
    const glm::vec3* vertices = nullptr;  ///< the geometry's, if corners are; what follows the last may be read
    const glm::uvec3* corners = nullptr;  ///< into vertices, by PrimitiveId; null: they stand in own_vertices, by entry
    RawVector<glm::vec3> own_vertices;    ///< three for each triangle; with room for one more
    Aabb room;                            ///< the top grid covers this too ...
    float most_room = std::numeric_limits<float>::infinity();  ///< ... unless that multiplies its surface by more
    float blur = 0.0f;  ///< how far the primitives that are tested may be from these, per coordinate
    float pad = 0.0f;   ///< boxes count as wider by it, on all sides; set by build_grid

    std::uint32_t count() const { return static_cast<std::uint32_t>(ids.size()); }
    bool is_triangle(std::uint32_t entry) const { return entry < triangles; }
    const glm::vec3* points() const { return corners ? vertices : own_vertices.data(); }
    PlacedTriangle placed(std::uint32_t entry) const
    {
        if (!corners) return {{3 * entry, 3 * entry + 1, 3 * entry + 2}, ids[entry]};
        const glm::uvec3& corner = corners[ids[entry] & ~transmitting_bit];
        return {{corner.x, corner.y, corner.z}, ids[entry]};
    }
    RootTriangle<float> triangle(std::uint32_t entry) const;
    Aabb box(std::uint32_t entry) const;
    std::uint64_t bytes() const
    {
        return 4 * ids.capacity() + sizeof(Aabb) * quadric_boxes.capacity() +
               sizeof(glm::vec3) * own_vertices.capacity();
    }
};

/// Triangles that are read sixteen at a time: behind them the last is repeated, to fill up its sixteen.
class PlacedTriangles {
public:
    /// What was there is gone.
    void resize(std::size_t count)
    {
        count_ = count;
        resize_for_overwrite(triangles_, count + pack_size);
    }
    void repeat_last()
    {
        std::fill_n(triangles_.begin() + static_cast<std::ptrdiff_t>(count_), pack_size, triangles_[count_ - 1]);
    }

    std::size_t count() const { return count_; }
    PlacedTriangle& operator[](std::size_t i) { return triangles_[i]; }
    const PlacedTriangle& operator[](std::size_t i) const { return triangles_[i]; }
    /// Sixteen, and more up to the end.
    const PlacedTriangle* from(std::size_t i) const { return triangles_.data() + i; }

private:
    RawVector<PlacedTriangle> triangles_;
    std::size_t count_ = 0;
};

/// Looks up where some triangles stand.
void look_up(const GridEntries& entries, std::span<const std::uint32_t> triangles, PlacedTriangle* into);

/// The same, and asks for their corners: who reads them soon need not wait.
void place(const GridEntries& entries, std::span<const std::uint32_t> triangles, PlacedTriangles& into);

/// Primitives of groups that are carried, in the root system.
/// into  what it held before is gone, its memory is used again
template <typename Real>
void make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor,
                  GridEntries& into);
template <typename Real>
GridEntries make_entries(const RootGeometry<Real>& geometry, const PrimitiveList& primitives, const Executor* executor);

/// Appends a triangle that is held here; all of them must come before the first quadric.
void add_triangle(GridEntries& entries, const RootTriangle<float>& triangle, PrimitiveId id, bool transmits);
void add_quadric(GridEntries& entries, const RootQuadric& quadric);

}  // namespace firstray::inline v0
