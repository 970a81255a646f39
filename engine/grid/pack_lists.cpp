#include "engine/grid/pack_lists.h"

#include <algorithm>

namespace firstray::inline v0 {
namespace {

std::size_t count_triangles(std::span<const std::uint32_t> listed, const GridEntries& entries)
{
    if (listed.empty() || entries.is_triangle(listed.back())) return listed.size();
    const auto end = std::partition_point(listed.begin(), listed.end(),
                                          [&](std::uint32_t entry) { return entries.is_triangle(entry); });
    return static_cast<std::size_t>(end - listed.begin());
}

bool any_transmits(const PlacedTriangles& triangles)
{
    std::uint32_t any = 0;
    for (std::size_t i = 0; i < triangles.count(); ++i) any |= triangles[i].id;
    return (any & transmitting_bit) != 0;
}

}  // namespace

Aabb cell_box(const Grid& grid, std::uint32_t cell)
{
    const auto index = static_cast<int>(cell);
    const glm::vec3 place(index % grid.dims.x, index / grid.dims.x % grid.dims.y, index / (grid.dims.x * grid.dims.y));
    return {grid.lo + grid.cell * place, grid.lo + grid.cell * (place + 1.0f)};
}

Aabb clipped(const Aabb& box, const Aabb& to)
{
    // A box that reaches `to` only through the pad is drawn to the nearest side, so that the result is never empty.
    return {glm::clamp(box.lo, to.lo, to.hi), glm::clamp(box.hi, to.lo, to.hi)};
}

VoxelList reserve_list(std::span<const std::uint32_t> listed, const GridEntries& entries, PackCounts& counts)
{
    const std::size_t triangles = count_triangles(listed, entries);
    VoxelList list;
    list.packs = static_cast<std::uint32_t>((triangles + pack_size - 1) / pack_size);
    list.quadrics = static_cast<std::uint32_t>(listed.size() - triangles);
    list.first_pack = counts.packs;
    list.first_boxes = counts.boxes;
    list.first_quadric = counts.quadrics;
    counts.packs += list.packs;
    counts.boxes += list.box_blocks();
    counts.quadrics += list.quadrics;
    return list;
}

std::span<const std::uint32_t> triangles_of(const VoxelList& list, const ListToFill& to_fill)
{
    return to_fill.entries.first(to_fill.entries.size() - list.quadrics);
}

void fill_list(VoxelList& list, const ListToFill& to_fill, const PlacedTriangles& triangles, const GridEntries& entries,
               PackOrder order, GridStructure& structure)
{
    if (triangles.count() > 0) fill_packs(list, entries, triangles, to_fill.box, order, structure);
    for (std::uint32_t q = 0; q < list.quadrics; ++q)
        structure.quadrics[list.first_quadric + q] = entries.ids[to_fill.entries[triangles.count() + q]];
    list.may_transmit = list.quadrics > 0 || any_transmits(triangles);
}

}  // namespace firstray::inline v0
