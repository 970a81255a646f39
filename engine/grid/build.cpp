#include "engine/grid/build.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "engine/grid/bin.h"
#include "engine/grid/pack_lists.h"
#include "engine/grid/resolution.h"

namespace firstray {
namespace {

/// References per primitive that all levels of grids together may make; resolutions that would make more are lowered.
constexpr double most_references = 6.0;

/// A few large primitives may be listed more often than that.
constexpr std::uint64_t free_references = 64;

/// A grid before its lists are packed, with the grids inside its crowded cells.
struct GridNode {
    Grid grid;
    CellLists lists;
    struct Child {
        std::uint32_t cell;
        std::unique_ptr<GridNode> node;  ///< null where a subgrid would have made no progress
    };
    std::vector<Child> children;  ///< by ascending cell

    std::uint64_t bytes() const
    {
        std::uint64_t sum = lists.bytes() + children.capacity() * sizeof(Child);
        for (const Child& child : children)
            if (child.node) sum += sizeof(GridNode) + child.node->bytes();
        return sum;
    }
};

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

void for_pieces(const Executor* executor, std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body)
{
    if (executor)
        executor->for_pieces(count, grain, body);
    else if (count > 0)
        body(0, count);
}

/// How many references to so many entries are within an allowance, in references per entry.
std::uint64_t allowed_references(double allowance, std::size_t entries)
{
    return static_cast<std::uint64_t>(allowance * static_cast<double>(entries)) + free_references;
}

/// A grid over a box for so many primitives, coarser where it would make too many references.
Grid choose_grid(const Aabb& box, const GridEntries& entries, std::span<const std::uint32_t> chosen, float density,
                 double allowance)
{
    Grid grid;
    grid.lo = box.lo - entries.pad;
    const glm::vec3 size = box.size() + 2.0f * entries.pad;
    for (;; density *= 0.25f) {
        grid.dims = choose_grid_dims(size, chosen.size(), density);
        grid.cell = size / glm::vec3(grid.dims);
        if (grid.cells() == 1 ||
            estimate_references(grid, entries, chosen) <= allowed_references(allowance, chosen.size()))
            return grid;
    }
}

std::unique_ptr<GridNode> build_node(const Aabb& box, const GridEntries& entries, std::span<const std::uint32_t> chosen,
                                     float density, double allowance, const GridOptions& options, int levels_left,
                                     const Executor* executor);

/// The grid inside a crowded cell, over what lies in the cell, or null where it would make no progress.
std::unique_ptr<GridNode> build_child(const GridNode& parent, std::uint32_t cell, const GridEntries& entries,
                                      const GridOptions& options, int levels_left, double allowance)
{
    const std::span<const std::uint32_t> listed = parent.lists.of(cell);
    Aabb content;
    for (const std::uint32_t entry : listed) content.grow(entries.boxes[entry]);
    const Aabb box = clipped(content, cell_box(parent.grid, cell));
    std::unique_ptr<GridNode> node =
        build_node(box, entries, listed, options.subdensity, allowance, options, levels_left, nullptr);
    std::size_t fullest = 0;
    for (std::uint32_t c = 0; c < node->grid.cells(); ++c) fullest = std::max(fullest, node->lists.of(c).size());
    const bool progress =
        fullest * 10 <= listed.size() * 9 && node->lists.entries.size() <= allowed_references(allowance, listed.size());
    return progress ? std::move(node) : nullptr;
}

std::unique_ptr<GridNode> build_node(const Aabb& box, const GridEntries& entries, std::span<const std::uint32_t> chosen,
                                     float density, double allowance, const GridOptions& options, int levels_left,
                                     const Executor* executor)
{
    auto node = std::make_unique<GridNode>();
    node->grid = choose_grid(box, entries, chosen, density, allowance);
    node->lists = bin(node->grid, entries, chosen, executor);
    if (levels_left <= 1) return node;
    const double left = allowance * static_cast<double>(chosen.size()) /
                        static_cast<double>(std::max<std::size_t>(node->lists.entries.size(), 1));
    for (std::uint32_t cell = 0; cell < node->grid.cells(); ++cell)
        if (node->lists.of(cell).size() > static_cast<std::size_t>(options.max_list))
            node->children.push_back({cell, nullptr});
    for_pieces(executor, node->children.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            node->children[i].node =
                build_child(*node, node->children[i].cell, entries, options, levels_left - 1, left);
    });
    return node;
}

/// The entries with the largest boxes, at most a pack of them, ascending: they would be listed in very many cells, and
/// rays meet them often.
std::vector<std::uint32_t> largest_triangles(const GridEntries& entries, const Aabb& bounds)
{
    const auto half_area = [](const glm::vec3& d) { return d.x * d.y + d.y * d.z + d.z * d.x; };
    const float large = half_area(bounds.size()) / 256.0f;
    std::vector<std::pair<float, std::uint32_t>> found;
    for (std::uint32_t entry = 0; entries.is_triangle(entry); ++entry) {
        const float area = half_area(entries.boxes[entry].size());
        if (area > large) found.emplace_back(-area, entry);
    }
    const std::size_t kept = std::min<std::size_t>(found.size(), pack_size);
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < kept; ++i) result.push_back(found[i].second);
    std::sort(result.begin(), result.end());
    return result;
}

/// Numbers the grids and lists of a tree and lays out its cells; what is left to do is filling the lists.
void lay_out(const GridNode& node, const GridEntries& entries, std::uint32_t level, GridStructure& structure,
             std::vector<ListToFill>& lists, PackCounts& counts)
{
    const auto grid_index = structure.grids.size();
    const auto first_cell = static_cast<std::uint32_t>(structure.cells.size());
    structure.depth = std::max(structure.depth, level);
    structure.grids.push_back(node.grid);
    structure.grids[grid_index].first_cell = first_cell;
    structure.cells.resize(first_cell + node.grid.cells());
    auto child = node.children.begin();
    for (std::uint32_t cell = 0; cell < node.grid.cells(); ++cell) {
        const std::span<const std::uint32_t> listed = node.lists.of(cell);
        const GridNode* inside = nullptr;
        if (child != node.children.end() && child->cell == cell) inside = (child++)->node.get();
        if (inside) {
            structure.cells[first_cell + cell] = CellWord::subgrid(static_cast<std::uint32_t>(structure.grids.size()));
            lay_out(*inside, entries, level + 1, structure, lists, counts);
        } else if (!listed.empty()) {
            structure.cells[first_cell + cell] = CellWord::list(static_cast<std::uint32_t>(structure.lists.size()));
            structure.largest_list = std::max(structure.largest_list, static_cast<std::uint32_t>(listed.size()));
            structure.references += listed.size();
            structure.lists.push_back(reserve_list(listed, entries, counts));
            lists.push_back({listed, cell_box(node.grid, cell)});
        }
    }
}

}  // namespace

GridOptions grid_options(const StrategyOptions& options)
{
    GridOptions grid;
    if (options.grid_density > 0.0f) grid.density = options.grid_density;
    if (options.max_list > 0) grid.max_list = options.max_list;
    grid.depth = options.grid_depth;
    return grid;
}

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

GridStructure build_grid(GridEntries entries, const GridOptions& options, const Executor* executor,
                         std::uint64_t& peak_bytes)
{
    GridStructure structure;
    Aabb bounds;
    for (const Aabb& box : entries.boxes) bounds.grow(box);
    bounds.grow(entries.room);
    if (bounds.empty()) bounds = {glm::vec3(0.0f), glm::vec3(0.0f)};
    const glm::vec3 farthest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
    structure.largest = std::max(std::max(farthest.x, farthest.y), farthest.z);
    structure.blur = entries.blur;
    structure.pad = entries.pad = std::max(structure.largest * pad_factor + entries.blur, 1e-30f);

    const std::vector<std::uint32_t> large = largest_triangles(entries, bounds);
    std::vector<std::uint32_t> chosen(entries.count());
    std::iota(chosen.begin(), chosen.end(), 0u);
    std::erase_if(chosen, [&](std::uint32_t e) { return std::binary_search(large.begin(), large.end(), e); });

    const std::unique_ptr<GridNode> top =
        build_node(bounds, entries, chosen, options.density, most_references, options, options.depth, executor);
    std::vector<ListToFill> lists;
    PackCounts counts;
    structure.large = reserve_list(large, entries, counts);
    lay_out(*top, entries, 1, structure, lists, counts);
    structure.packs.resize(counts.packs);
    structure.boxes.resize(counts.boxes);
    structure.quadrics.resize(counts.quadrics);
    fill_list(structure.large, {large, bounds}, entries, structure);
    for_pieces(executor, lists.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) fill_list(structure.lists[i], lists[i], entries, structure);
    });
    peak_bytes = std::max(peak_bytes, structure.bytes() + top->bytes() + entries.bytes() + 4 * chosen.capacity() +
                                          lists.capacity() * sizeof(ListToFill));
    return structure;
}

template GridEntries make_entries(const RootGeometry<float>&, const PrimitiveList&, const Executor*);
template GridEntries make_entries(const RootGeometry<double>&, const PrimitiveList&, const Executor*);

std::uint64_t GridStructure::bytes() const
{
    return grids.capacity() * sizeof(Grid) + cells.capacity() * sizeof(CellWord) +
           lists.capacity() * sizeof(VoxelList) + packs.capacity() * sizeof(TrianglePack) +
           boxes.capacity() * sizeof(PackBoxes) + quadrics.capacity() * 4;
}

}  // namespace firstray
