#include "engine/grid/pack_lists.h"

#include <algorithm>
#include <utility>

namespace firstray::inline v0 {
namespace {

/// Places on a Morton curve through a voxel, `bits` an axis.
class MortonCurve {
public:
    MortonCurve(const Aabb& voxel, int bits)
        : lo_(voxel.lo),
          scale_(static_cast<float>(1 << bits) / glm::max(voxel.size(), glm::vec3(1e-30f))),
          last_(static_cast<float>((1 << bits) - 1))
    {
    }
    std::uint32_t place(const glm::vec3& point) const
    {
        const glm::vec3 p = glm::clamp((point - lo_) * scale_, 0.0f, last_);
        return spread(static_cast<std::uint32_t>(p.x)) | (spread(static_cast<std::uint32_t>(p.y)) << 1) |
               (spread(static_cast<std::uint32_t>(p.z)) << 2);
    }

private:
    /// Spreads three bits so that two zeros stand between them.
    static std::uint32_t spread(std::uint32_t x) { return (x & 1u) | (x & 2u) << 2 | (x & 4u) << 4; }

    glm::vec3 lo_, scale_;
    float last_;
};

/// Sorts by counting, which keeps the order of equal ones: a few triangles for each place on the curve are near enough
/// to each other, and comparing takes longer.
template <int bits>
void sort_along_curve(std::span<std::uint32_t> entries_listed, const Aabb& voxel, const GridEntries& entries)
{
    constexpr std::size_t places = std::size_t{1} << (3 * bits);
    const MortonCurve curve(voxel, bits);
    thread_local std::vector<std::uint16_t> place_of;
    thread_local std::vector<std::uint32_t> unsorted;
    place_of.resize(entries_listed.size());
    unsorted.assign(entries_listed.begin(), entries_listed.end());
    std::uint32_t first[places] = {};
    for (std::size_t i = 0; i < unsorted.size(); ++i) {
        const Aabb box = clipped(entries.boxes[unsorted[i]], voxel);
        place_of[i] = static_cast<std::uint16_t>(curve.place((box.lo + box.hi) * 0.5f));
        ++first[place_of[i]];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& place : first) sum += std::exchange(place, sum);
    for (std::size_t i = 0; i < unsorted.size(); ++i) entries_listed[first[place_of[i]]++] = unsorted[i];
}

/// The list's triangles, neighbours in space near each other, lists of at most one pack as they are.
std::span<const std::uint32_t> in_clusters(const ListToFill& list, std::size_t triangles, const GridEntries& entries)
{
    constexpr std::size_t few = 128;  // two triangles for each of 64 places
    if (triangles <= pack_size) return list.entries.first(triangles);
    thread_local std::vector<std::uint32_t> order;
    order.assign(list.entries.begin(), list.entries.begin() + static_cast<std::ptrdiff_t>(triangles));
    if (triangles <= few)
        sort_along_curve<2>(order, list.box, entries);
    else
        sort_along_curve<3>(order, list.box, entries);
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
    const std::span<const std::uint32_t> order = in_clusters(to_fill, triangles, entries);
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

}  // namespace firstray::inline v0
