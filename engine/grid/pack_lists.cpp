#include "engine/grid/pack_lists.h"

#include <algorithm>

namespace firstray {
namespace {

/// Spreads the low 10 bits of x so that two zeros stand between them.
std::uint32_t spread(std::uint32_t x)
{
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
}

/// Position of a box's middle on a Morton curve through `within`, 10 bits an axis.
std::uint32_t morton_key(const Aabb& box, const Aabb& within)
{
    const glm::vec3 size = glm::max(within.size(), glm::vec3(1e-30f));
    const glm::vec3 place = glm::clamp(((box.lo + box.hi) * 0.5f - within.lo) / size, 0.0f, 1.0f) * 1023.0f;
    return spread(static_cast<std::uint32_t>(place.x)) | (spread(static_cast<std::uint32_t>(place.y)) << 1) |
           (spread(static_cast<std::uint32_t>(place.z)) << 2);
}

/// The list's triangles, neighbours in space near each other, lists of at most one pack as they are.
std::vector<std::uint32_t> in_clusters(const ListToFill& list, std::size_t triangles, const GridEntries& entries)
{
    std::vector<std::uint32_t> order(list.entries.begin(),
                                     list.entries.begin() + static_cast<std::ptrdiff_t>(triangles));
    if (triangles <= pack_size) return order;
    std::vector<std::uint64_t> keys(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        const std::uint32_t key = morton_key(clipped(entries.boxes[order[i]], list.box), list.box);
        keys[i] = (std::uint64_t{key} << 32) | order[i];
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < triangles; ++i) order[i] = static_cast<std::uint32_t>(keys[i]);
    return order;
}

void set_box(PackBoxes& boxes, std::uint32_t lane, const Aabb& box, float pad)
{
    for (int axis = 0; axis < 3; ++axis) {
        boxes.lo[axis][lane] = box.lo[axis] - pad;
        boxes.hi[axis][lane] = box.hi[axis] + pad;
    }
}

/// Fills one pack, and gives the box of what the triangles occupy in the voxel.
Aabb fill_pack(TrianglePack& pack, std::span<const std::uint32_t> members, const Aabb& voxel,
               const GridEntries& entries)
{
    Aabb box;
    int lane = 0;
    for (const std::uint32_t entry : members) {
        pack.set(lane++, entries.triangles[entry], entries.ids[entry]);
        box.grow(clipped(entries.boxes[entry], voxel));
    }
    while (lane < pack_size) pack.clear(lane++);
    return box;
}

std::size_t count_triangles(std::span<const std::uint32_t> listed, const GridEntries& entries)
{
    const auto end = std::partition_point(listed.begin(), listed.end(),
                                          [&](std::uint32_t entry) { return entries.is_triangle(entry); });
    return static_cast<std::size_t>(end - listed.begin());
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

void fill_list(const VoxelList& list, const ListToFill& to_fill, const GridEntries& entries, GridStructure& structure)
{
    const std::size_t triangles = count_triangles(to_fill.entries, entries);
    const std::vector<std::uint32_t> order = in_clusters(to_fill, triangles, entries);
    for (std::uint32_t p = 0; p < list.packs; ++p) {
        const std::size_t begin = p * std::size_t{pack_size}, end = std::min(begin + pack_size, triangles);
        const Aabb box = fill_pack(structure.packs[list.first_pack + p], {order.data() + begin, order.data() + end},
                                   to_fill.box, entries);
        if (list.box_blocks() > 0)
            set_box(structure.boxes[list.first_boxes + p / pack_size], p % pack_size, box, entries.pad);
    }
    for (std::uint32_t p = list.packs; p < list.box_blocks() * pack_size; ++p)
        set_box(structure.boxes[list.first_boxes + p / pack_size], p % pack_size, {}, 0.0f);
    for (std::uint32_t q = 0; q < list.quadrics; ++q)
        structure.quadrics[list.first_quadric + q] = entries.ids[to_fill.entries[triangles + q]];
}

}  // namespace firstray
