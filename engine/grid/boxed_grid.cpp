#include "engine/grid/boxed_grid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/grid/bin.h"
#include "engine/grid/resolution.h"
#include "engine/strategy/group_bounds.h"

namespace firstray::inline v0 {
namespace {

/// Cells per item of a grid around items alone.
constexpr float items_density = 1.0f;

/// More cells than this are too many to put an item into at every update.
constexpr std::uint64_t most_cells = 4096;

struct Standing {
    std::uint32_t cell, item;  ///< item: index into the span that is inserted
};

std::vector<Standing> cells_of_items(const BoxedGrid& grid, std::span<const Item> items)
{
    const Grid& top = grid.structure.grids[0];
    std::vector<Standing> standing;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        const CellRange range = cells_of(top, items[i].bounds, grid.structure.pad);
        for (int z = range.lo.z; z <= range.hi.z; ++z)
            for (int y = range.lo.y; y <= range.hi.y; ++y)
                for (int x = range.lo.x; x <= range.hi.x; ++x)
                    standing.push_back({static_cast<std::uint32_t>(x + top.dims.x * (y + top.dims.y * z)), i});
    }
    std::sort(standing.begin(), standing.end(), [](const Standing& a, const Standing& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.item < b.item;
    });
    return standing;
}

/// Appends packs of the given items; returns how many.
std::uint32_t append_packs(RawVector<BoxPack>& packs, std::span<const Item> items,
                           const std::vector<std::uint32_t>& chosen)
{
    const std::size_t before = packs.size();
    for (std::size_t first = 0; first < chosen.size(); first += pack_size) {
        BoxPack& pack = packs.emplace_back();
        for (int lane = 0; lane < pack_size; ++lane) {
            const std::size_t i = first + static_cast<std::size_t>(lane);
            if (i < chosen.size())
                pack.set(lane, items[chosen[i]]);
            else
                pack.clear(lane);
        }
    }
    return static_cast<std::uint32_t>(packs.size() - before);
}

}  // namespace

void BoxPack::set(int lane, const Item& what)
{
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) row[i][j][lane] = what.cube_from_root.row[i][j];
        offset[i][lane] = what.cube_from_root.offset[i];
    }
    item[lane] = what.number;
}

void BoxPack::clear(int lane)
{
    set(lane, {.number = none, .bounds = {}, .cube_from_root = {{}, glm::vec3(1e30f)}});
}

bool BoxedGrid::has_room_for(const Item& item) const
{
    const Grid& top = structure.grids[0];
    return glm::all(glm::greaterThanEqual(item.bounds.lo, top.lo)) &&
           glm::all(glm::lessThanEqual(item.bounds.hi, top.hi())) &&
           cells_of(top, item.bounds, structure.pad).cells() <= most_cells;
}

void BoxedGrid::remove_items()
{
    for (const std::uint32_t cell : occupied) structure.cells[cell] = voxels[structure.cells[cell].index()].own;
    occupied.clear();
    voxels.clear();
    packs.clear();
}

void BoxedGrid::insert(std::span<const Item> items)
{
    const std::vector<Standing> standing = cells_of_items(*this, items);
    std::map<std::vector<std::uint32_t>, BoxedVoxel> packed;  // cells where the same items stand share their packs
    std::vector<std::uint32_t> here;
    for (std::size_t i = 0; i < standing.size();) {
        const std::uint32_t cell = standing[i].cell;
        here.clear();
        for (; i < standing.size() && standing[i].cell == cell; ++i) here.push_back(standing[i].item);
        BoxedVoxel& shared = packed[here];
        if (shared.packs == 0) {
            shared.first_pack = static_cast<std::uint32_t>(packs.size());
            shared.packs = append_packs(packs, items, here);
        }
        BoxedVoxel voxel = shared;
        voxel.own = structure.cells[cell];
        structure.cells[cell] = CellWord::special(static_cast<std::uint32_t>(voxels.size()));
        voxels.push_back(voxel);
        occupied.push_back(cell);
    }
}

std::vector<CellWord> BoxedGrid::cells_without_items() const
{
    std::vector<CellWord> cells = structure.cells;
    for (const std::uint32_t cell : occupied) cells[cell] = voxels[cells[cell].index()].own;
    return cells;
}

std::uint64_t BoxedGrid::bytes() const
{
    return structure.bytes() + voxels.capacity() * sizeof(BoxedVoxel) + packs.capacity() * sizeof(BoxPack) +
           4 * occupied.capacity();
}

BoxedGrid grid_of_items(std::span<const Item> items, bool as_list)
{
    BoxedGrid result;
    GridStructure& structure = result.structure;
    Aabb bounds;
    for (const Item& item : items) bounds.grow(item.bounds);
    structure.largest = largest_coordinate(bounds);
    structure.pad = std::max(structure.largest * pad_factor, 1e-30f);
    Grid top;
    top.lo = bounds.lo - structure.pad;
    const glm::vec3 size = bounds.size() + 2.0f * structure.pad;
    if (!as_list && items.size() > pack_size) top.dims = choose_grid_dims(size, items.size(), items_density);
    top.cell = size / glm::vec3(top.dims);
    structure.depth = 1;
    structure.grids.push_back(top);
    structure.cells.resize(top.cells());
    result.insert(items);
    return result;
}

BoxedGrid place_items(BoxedGrid* around, std::span<const Item> items, bool as_list)
{
    std::vector<Item> among, outside;
    for (const Item& item : items) (around && around->has_room_for(item) ? among : outside).push_back(item);
    if (around) {
        around->remove_items();
        around->insert(among);
    }
    return outside.empty() ? BoxedGrid{} : grid_of_items(outside, as_list);
}

Item make_item(std::uint32_t number, const Transform& local_from_root, const Transform& root_from_local,
               const DAabb& bounds, double wide)
{
    const DAabb in_root = transformed(bounds, root_from_local);
    if (!(largest_coordinate(in_root) <= farthest_place))
        return make_item(number, {}, {}, {glm::dvec3(-farthest_place), glm::dvec3(farthest_place)}, wide);
    const glm::dvec3 middle = (bounds.lo + bounds.hi) * 0.5, half = (bounds.hi - bounds.lo) * 0.5;
    Item item{.number = number, .bounds = {}, .cube_from_root = {}};
    for (int axis = 0; axis < 3; ++axis) {
        double row_size = 0.0;
        for (int j = 0; j < 3; ++j) row_size += std::abs(local_from_root.linear[j][axis]);
        item.bounds.lo[axis] = static_cast<float>(in_root.lo[axis] - wide);
        item.bounds.hi[axis] = static_cast<float>(in_root.hi[axis] + wide);
        const double scale = 1.0 / (half[axis] + row_size * wide);
        for (int j = 0; j < 3; ++j)
            item.cube_from_root.row[axis][j] = static_cast<float>(local_from_root.linear[j][axis] * scale);
        item.cube_from_root.offset[axis] = static_cast<float>((local_from_root.offset[axis] - middle[axis]) * scale);
    }
    return item;
}

}  // namespace firstray::inline v0
