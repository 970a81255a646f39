#include "engine/grid/bin.h"

#include <algorithm>
#include <functional>

#include "engine/primitive/triangle_box.h"

namespace firstray::inline v0 {
namespace {

struct Reference {
    std::uint32_t cell, entry;
};

std::uint32_t cell_index(const Grid& grid, const glm::ivec3& c)
{
    return static_cast<std::uint32_t>(c.x + grid.dims.x * (c.y + grid.dims.y * c.z));
}

/// Finds cells with multiplications: the rounding of a cell's inverse is a small part of the pad.
struct CellFinder {
    glm::vec3 lo, scale, last;
    float pad;

    CellFinder(const Grid& grid, float wide)
        : lo(grid.lo), scale(1.0f / grid.cell), last(grid.dims - 1), pad(wide)
    {
    }
    CellRange cells(const Aabb& box) const
    {
        const glm::vec3 from = (box.lo - pad - lo) * scale, to = (box.hi + pad - lo) * scale;
        return {glm::ivec3(glm::clamp(from, glm::vec3(0.0f), last)), glm::ivec3(glm::clamp(to, glm::vec3(0.0f), last))};
    }
};

/// Calls visit(cell) for each cell that the entry overlaps.
template <typename Visit>
void for_each_cell(const Grid& grid, const GridEntries& entries, std::uint32_t entry, const CellRange& range,
                   Visit&& visit)
{
    const glm::ivec3 last = range.hi - range.lo;
    const auto visit_all = [&](auto&& overlaps) {
        for (int z = range.lo.z; z <= range.hi.z; ++z)
            for (int y = range.lo.y; y <= range.hi.y; ++y)
                for (int x = range.lo.x; x <= range.hi.x; ++x)
                    if (overlaps(glm::ivec3(x, y, z))) visit(cell_index(grid, {x, y, z}));
    };
    // In a row of cells along one axis, the part between two of its planes is never empty: no test needed.
    const int wide_axes = (last.x > 0) + (last.y > 0) + (last.z > 0);
    if (wide_axes <= 1 || !entries.is_triangle(entry)) {
        visit_all([](const glm::ivec3&) { return true; });
        return;
    }
    const RootTriangle<float>& t = entries.triangles[entry];
    const glm::vec3 pad(entries.pad);
    const TriangleBoxOverlap overlap(t.v[0], t.v[1], t.v[2], grid.cell + 2.0f * pad);
    visit_all([&](const glm::ivec3& c) { return overlap.meets(grid.lo + grid.cell * glm::vec3(c) - pad); });
}

}  // namespace

CellRange cells_of(const Grid& grid, const Aabb& box, float pad)
{
    return CellFinder(grid, pad).cells(box);
}

RawVector<CellRange> ranges_of(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen,
                               const Executor* executor)
{
    RawVector<CellRange> ranges(chosen.size());
    const CellFinder finder(grid, entries.pad);
    for_pieces(executor, chosen.size(), 8192, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ranges[i] = finder.cells(entries.boxes[chosen[i]]);
    });
    return ranges;
}

std::uint64_t estimate_references(std::span<const CellRange> ranges)
{
    std::uint64_t total = 0;
    for (const CellRange& range : ranges) {
        const glm::u64vec3 n(range.hi - range.lo + 1);
        total += std::min(n.x * n.y * n.z, n.x * n.y + n.y * n.z + n.z * n.x);
    }
    return total;
}

CellLists bin(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen,
              std::span<const CellRange> ranges, const Executor* executor)
{
    // Every piece of the entries makes its references; a piece's share of a cell's list follows those of the pieces
    // before.
    const std::size_t pieces = executor && chosen.size() > 4096 ? static_cast<std::size_t>(executor->threads()) : 1;
    const std::size_t cells = grid.cells();
    std::vector<std::vector<Reference>> references(pieces);
    std::vector<std::vector<std::uint32_t>> place(pieces);  // by piece, by cell: first how many, then where to
    const auto for_each_piece = [&](const std::function<void(std::size_t)>& body) {
        if (pieces > 1)
            executor->for_each(pieces, body);
        else
            body(0);
    };
    for_each_piece([&](std::size_t piece) {
        const std::size_t begin = chosen.size() * piece / pieces, end = chosen.size() * (piece + 1) / pieces;
        place[piece].resize(cells);
        references[piece].reserve((end - begin) * 2);
        for (std::size_t i = begin; i < end; ++i)
            for_each_cell(grid, entries, chosen[i], ranges[i], [&](std::uint32_t cell) {
                ++place[piece][cell];
                references[piece].push_back({cell, chosen[i]});
            });
    });

    CellLists lists;
    lists.first.resize(cells + 1);
    std::uint32_t total = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        lists.first[cell] = total;
        for (std::vector<std::uint32_t>& piece : place) {
            const std::uint32_t count = piece[cell];
            piece[cell] = total;
            total += count;
        }
    }
    lists.first[cells] = total;
    lists.entries.resize(total);
    for_each_piece([&](std::size_t piece) {
        for (const Reference& r : references[piece]) lists.entries[place[piece][r.cell]++] = r.entry;
    });
    return lists;
}

}  // namespace firstray::inline v0
