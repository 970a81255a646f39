#include "engine/grid/build.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "engine/grid/bin.h"
#include "engine/grid/entry_kernels.h"
#include "engine/grid/fill_lists.h"
#include "engine/grid/pack_lists.h"
#include "engine/grid/resolution.h"
#include "engine/grid/survey.h"

namespace firstray::inline v0 {
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

/// How many references to so many entries are within an allowance, in references per entry.
std::uint64_t allowed_references(double allowance, std::size_t entries)
{
    return static_cast<std::uint64_t>(allowance * static_cast<double>(entries)) + free_references;
}

/// Sets a node's grid over a box, coarser where it would make too many references, and the lists of its cells.
void choose_grid(const Aabb& box, const GridEntries& entries, std::span<const std::uint32_t> chosen, float density,
                 double allowance, const Executor* executor, BinScratch& scratch, GridNode& node)
{
    Grid& grid = node.grid;
    grid.lo = box.lo - entries.pad;
    const glm::vec3 size = box.size() + 2.0f * entries.pad;
    const std::uint64_t most = allowed_references(allowance, chosen.size());
    // What lies in a cell narrower than the pad to both sides is listed in its neighbours, too. One cell where lengths
    // overflow: the greater of one and what is no number is one.
    const glm::vec3 one(1.0f), most_cells(max_grid_dim);
    const glm::ivec3 useful(glm::min(glm::max(one, size / (2.0f * entries.pad)), most_cells));
    for (;; density *= 0.25f) {
        grid.dims = glm::min(choose_grid_dims(size, chosen.size(), density), useful);
        grid.cell = size / glm::vec3(grid.dims);
        if (bin(grid, entries, chosen, most, executor, scratch, node.lists)) return;
    }
}

void build_node(const Aabb& box, const GridEntries& entries, std::span<const std::uint32_t> chosen, float density,
                double allowance, const GridOptions& options, int levels_left, const Executor* executor,
                BinScratch& scratch, GridNode& node);

/// The grid inside a crowded cell, over what lies in the cell, or null where it would make no progress.
std::unique_ptr<GridNode> build_child(const Grid& parent, std::uint32_t cell, std::span<const std::uint32_t> listed,
                                      const GridEntries& entries, const GridOptions& options, int levels_left,
                                      double allowance)
{
    const Aabb box = clipped(bounds_of(entries, listed, nullptr), cell_box(parent, cell));
    auto node = std::make_unique<GridNode>();
    BinScratch scratch;
    build_node(box, entries, listed, options.subdensity, allowance, options, levels_left, nullptr, scratch, *node);
    std::size_t fullest = 0;
    for (std::uint32_t c = 0; c < node->grid.cells(); ++c) fullest = std::max(fullest, node->lists.of(c).size());
    const bool progress =
        fullest * 10 <= listed.size() * 9 && node->lists.entries.size() <= allowed_references(allowance, listed.size());
    return progress ? std::move(node) : nullptr;
}

void build_node(const Aabb& box, const GridEntries& entries, std::span<const std::uint32_t> chosen, float density,
                double allowance, const GridOptions& options, int levels_left, const Executor* executor,
                BinScratch& scratch, GridNode& node)
{
    choose_grid(box, entries, chosen, density, allowance, executor, scratch, node);
    if (levels_left <= 1) return;
    const double left = allowance * static_cast<double>(chosen.size()) /
                        static_cast<double>(std::max<std::size_t>(node.lists.entries.size(), 1));
    for (std::uint32_t cell = 0; cell < node.grid.cells(); ++cell)
        if (node.lists.of(cell).size() > static_cast<std::size_t>(options.max_list))
            node.children.push_back({cell, nullptr});
    for_pieces(executor, node.children.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t cell = node.children[i].cell;
            node.children[i].node =
                build_child(node.grid, cell, node.lists.of(cell), entries, options, levels_left - 1, left);
        }
    });
}

/// Lists that have their places in a structure and wait to be filled.
struct Filling {
    std::vector<ListToFill>& lists;
    PackCounts counts;
};

/// Numbers the grids and lists of a tree and lays out its cells; what is left to do is filling the lists.
void lay_out(const GridNode& node, const GridEntries& entries, std::uint32_t level, GridStructure& structure,
             Filling& filling)
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
            lay_out(*inside, entries, level + 1, structure, filling);
        } else if (!listed.empty()) {
            structure.cells[first_cell + cell] = CellWord::list(static_cast<std::uint32_t>(structure.lists.size()));
            structure.largest_list = std::max(structure.largest_list, static_cast<std::uint32_t>(listed.size()));
            structure.references += listed.size();
            structure.lists.push_back(reserve_list(listed, entries, filling.counts));
            filling.lists.push_back({listed, cell_box(node.grid, cell)});
        }
    }
}

/// Takes some, ascending, out of 0, 1, 2, ...
void leave_out(std::span<const std::uint32_t> some, RawVector<std::uint32_t>& numbers)
{
    for (std::size_t i = 0; i < some.size(); ++i) {
        const auto next = numbers.begin() + some[i] + 1;
        const auto end = i + 1 < some.size() ? numbers.begin() + some[i + 1] : numbers.end();
        std::copy(next, end, next - 1 - static_cast<std::ptrdiff_t>(i));
    }
    numbers.resize(numbers.size() - some.size());
}

/// Sets the pad of entries and structure, and chosen to what goes into cells.
Beginning begin(GridEntries& entries, GridStructure& structure, RawVector<std::uint32_t>& chosen,
                const Executor* executor)
{
    resize_for_overwrite(chosen, entries.count());
    std::iota(chosen.begin(), chosen.end(), 0u);
    Beginning begun = survey(entries, executor);
    leave_out(begun.large, chosen);
    structure.largest = largest_coordinate(begun.bounds);
    structure.blur = entries.blur;
    structure.pad = entries.pad = std::max(structure.largest * pad_factor + entries.blur, 1e-30f);
    return begun;
}

void fill(GridStructure& structure, const Beginning& begun, const GridEntries& entries, const Filling& filling,
          PackOrder order, const Executor* executor)
{
    resize_for_overwrite(structure.packs, filling.counts.packs);
    resize_for_overwrite(structure.boxes, filling.counts.boxes);
    structure.quadrics.resize(filling.counts.quadrics);
    PlacedTriangles large;
    place(entries, begun.large, large);
    fill_list(structure.large, {begun.large, begun.bounds}, large, entries, order, structure);
    fill_lists(filling.lists, entries, order, executor, structure);
}

/// Forgets what a structure held, but keeps its memory.
void empty(GridStructure& structure)
{
    structure.grids.clear();
    structure.cells.clear();
    structure.lists.clear();
    structure.quadrics.clear();
    structure.depth = structure.largest_list = 0;
    structure.references = 0;
}

/// A grid of one cell that lists what it is given.
std::unique_ptr<GridNode> one_cell(const Aabb& box, std::span<const std::uint32_t> listed)
{
    auto node = std::make_unique<GridNode>();
    node->grid.lo = box.lo;
    node->grid.cell = box.size();
    node->lists.first = {0, static_cast<std::uint32_t>(listed.size())};
    node->lists.entries.assign(listed.begin(), listed.end());
    return node;
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

std::uint64_t BuildScratch::bytes() const
{
    return bin.bytes() + 4 * chosen.capacity() + top.bytes() + to_fill.capacity() * sizeof(ListToFill);
}

void build_grid(GridEntries& entries, const GridOptions& options, const Executor* executor, BuildScratch& scratch,
                GridStructure& into, std::uint64_t& peak_bytes)
{
    empty(into);
    const Beginning begun = begin(entries, into, scratch.chosen, executor);
    GridNode top;
    top.lists = std::move(scratch.top);
    build_node(begun.bounds, entries, scratch.chosen, options.density, most_references, options, options.depth,
               executor, scratch.bin, top);
    scratch.to_fill.clear();
    Filling filling{scratch.to_fill, {}};
    into.large = reserve_list(begun.large, entries, filling.counts);
    lay_out(top, entries, 1, into, filling);
    fill(into, begun, entries, filling, options.order, executor);
    peak_bytes = std::max(peak_bytes, into.bytes() + top.bytes() + entries.bytes() + scratch.bytes());
    scratch.top = std::move(top.lists);
}

GridStructure build_grid(GridEntries entries, const GridOptions& options, const Executor* executor,
                         std::uint64_t& peak_bytes)
{
    BuildScratch scratch;
    GridStructure structure;
    build_grid(entries, options, executor, scratch, structure, peak_bytes);
    return structure;
}

TopGrid build_top(GridEntries& entries, const GridOptions& options, const Executor* executor)
{
    TopGrid top;
    GridStructure& structure = top.structure;
    BuildScratch scratch;
    const Beginning begun = begin(entries, structure, scratch.chosen, executor);
    GridNode node;
    build_node(begun.bounds, entries, scratch.chosen, options.density, most_references, options, 1, executor,
               scratch.bin, node);
    top.lists = std::move(node.lists);
    top.allowance = most_references * static_cast<double>(scratch.chosen.size()) /
                    static_cast<double>(std::max<std::size_t>(top.lists.entries.size(), 1));
    structure.grids.push_back(node.grid);
    structure.cells.resize(node.grid.cells());
    structure.depth = 1;
    for (std::uint32_t cell = 0; cell < node.grid.cells(); ++cell)
        if (!top.lists.of(cell).empty()) structure.cells[cell] = CellWord::list(cell);
    Filling filling{scratch.to_fill, {}};
    structure.large = reserve_list(begun.large, entries, filling.counts);
    fill(structure, begun, entries, filling, options.order, executor);
    return top;
}

GridStructure build_voxel(const TopGrid& top, std::uint32_t cell, const GridEntries& entries,
                          const GridOptions& options)
{
    const Grid& grid = top.structure.grids[0];
    const std::span<const std::uint32_t> listed = top.lists.of(cell);
    std::unique_ptr<GridNode> node;
    if (options.depth > 1 && listed.size() > static_cast<std::size_t>(options.max_list))
        node = build_child(grid, cell, listed, entries, options, options.depth - 1, top.allowance);
    if (!node) node = one_cell(cell_box(grid, cell), listed);
    GridStructure structure;
    structure.largest = top.structure.largest;
    structure.blur = top.structure.blur;
    structure.pad = top.structure.pad;
    std::vector<ListToFill> to_fill;
    Filling filling{to_fill, {}};
    lay_out(*node, entries, 1, structure, filling);
    fill(structure, {}, entries, filling, options.order, nullptr);
    return structure;
}

std::uint64_t GridStructure::bytes() const
{
    return grids.capacity() * sizeof(Grid) + cells.capacity() * sizeof(CellWord) +
           lists.capacity() * sizeof(VoxelList) + packs.capacity() * sizeof(TrianglePack) +
           boxes.capacity() * sizeof(PackBoxes) + quadrics.capacity() * 4;
}

}  // namespace firstray::inline v0
