#include "lazy/flat_list.h"

#include <algorithm>

#include "engine/grid/entries.h"

namespace firstray::inline v0::lazy {
namespace {

/// Primitives that are rounded and packed at a time: they stay in the first cache in between.
constexpr std::size_t portion = 256;

/// Puts up to sixteen entries into a pack; returns their box.
Aabb fill(TrianglePack& pack, const GridEntries& entries, std::size_t first)
{
    Aabb box;
    for (int lane = 0; lane < pack_size; ++lane) {
        const std::size_t entry = first + static_cast<std::size_t>(lane);
        if (entry >= entries.count()) {
            pack.clear(lane);
            continue;
        }
        pack.set(lane, entries.triangle(static_cast<std::uint32_t>(entry)), entries.ids[entry]);
        box.grow(entries.box(static_cast<std::uint32_t>(entry)));
    }
    return box;
}

void set_boxes(GridStructure& structure, const std::vector<Aabb>& boxes)
{
    for (std::size_t p = 0; p < structure.boxes.size() * pack_size; ++p) {
        const Aabb box = p < boxes.size() ? boxes[p] : Aabb();  // what is behind the last is empty
        structure.boxes[p / pack_size].set(p % pack_size, {box.lo - structure.pad, box.hi + structure.pad});
    }
}

/// A line that meets a convex body meets one inside it with the ratio of their surfaces as probability.
/// source  J. Goldsmith, J. Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", 1987
double packs_met(const std::vector<Aabb>& boxes, const Aabb& bounds)
{
    const auto half_area = [](const glm::vec3& d) { return static_cast<double>(d.x * d.y + d.y * d.z + d.z * d.x); };
    double sum = 0.0;
    for (const Aabb& box : boxes) sum += half_area(box.size());
    return sum / std::max(half_area(bounds.size()), 1e-300);
}

}  // namespace

template <typename Real>
FlatList make_flat_list(const RootGeometry<Real>& geometry, const PrimitiveList& primitives)
{
    FlatList list;
    GridStructure& structure = list.structure;
    std::vector<Aabb> boxes;
    Aabb bounds;
    const std::size_t packs = (primitives.triangles.size() + pack_size - 1) / pack_size;
    structure.packs.reserve(packs);
    boxes.reserve(packs);
    PrimitiveList some;
    for (auto next = primitives.triangles.begin(); next != primitives.triangles.end();) {
        const auto end = next + std::min<std::ptrdiff_t>(portion, primitives.triangles.end() - next);
        some.triangles.assign(next, end);
        next = end;
        const GridEntries entries = make_entries(geometry, some, nullptr);
        for (std::size_t first = 0; first < entries.count(); first += pack_size) {
            boxes.push_back(fill(structure.packs.emplace_back(), entries, first));
            bounds.grow(boxes.back());
        }
    }
    some = {{}, primitives.quadrics};
    for (const Aabb& box : make_entries(geometry, some, nullptr).quadric_boxes) bounds.grow(box);
    structure.quadrics = primitives.quadrics;

    if (bounds.empty()) bounds = {glm::vec3(0.0f), glm::vec3(0.0f)};
    structure.largest = largest_coordinate(bounds);
    structure.pad = std::max(structure.largest * pad_factor, 1e-30f);
    structure.grids.push_back({.lo = bounds.lo - structure.pad, .cell = bounds.size() + 2.0f * structure.pad});
    structure.cells.push_back(CellWord::list(0));
    structure.lists.push_back({.packs = static_cast<std::uint32_t>(structure.packs.size()),
                               .quadrics = static_cast<std::uint32_t>(structure.quadrics.size())});
    structure.boxes.resize(structure.lists[0].box_blocks());
    set_boxes(structure, boxes);
    structure.depth = 1;
    structure.references = primitives.size();
    structure.largest_list = static_cast<std::uint32_t>(primitives.size());
    list.packs_met = packs_met(boxes, bounds);
    return list;
}

template FlatList make_flat_list(const RootGeometry<float>&, const PrimitiveList&);
template FlatList make_flat_list(const RootGeometry<double>&, const PrimitiveList&);

}  // namespace firstray::inline v0::lazy
