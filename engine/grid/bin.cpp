#include "engine/grid/bin.h"

#include <algorithm>
#include <limits>

#include "engine/grid/entry_kernels.h"
#include "engine/primitive/triangle_box.h"

namespace firstray::inline v0 {
namespace {

using Reference = BinScratch::Reference;
using Piece = BinScratch::Piece;

/// The cells of a small triangle's box are listed without a look at the triangle: that takes longer than to copy it to
/// the few that it does not meet.
constexpr std::uint64_t too_few_to_test = 8;

/// A thread is not worth waking for less.
constexpr std::size_t least_piece = 4096;

/// One entry in so many is looked at before all are listed, and so many at most.
constexpr std::size_t sample_stride = 64, largest_sample = 256;

std::uint32_t cell_index(const Grid& grid, const glm::ivec3& c)
{
    return static_cast<std::uint32_t>(c.x + grid.dims.x * (c.y + grid.dims.y * c.z));
}

/// How often an entry that reaches these cells is listed, at most: as often as a surface would be where they are many.
std::uint64_t estimate(const CellRange& range)
{
    const glm::u64vec3 n(range.hi - range.lo + 1);
    return std::min(n.x * n.y * n.z, n.x * n.y + n.y * n.z + n.z * n.x);
}

/// Whether the lists would be twice too long if all entries were like a few of them.
bool clearly_too_long(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen,
                      std::uint64_t most)
{
    const std::size_t sample = std::min(chosen.size() / sample_stride, largest_sample);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < sample; ++i)
        sum += estimate(cells_of(grid, entries.box(chosen[chosen.size() * i / sample]), entries.pad));
    return static_cast<double>(sum) * static_cast<double>(chosen.size()) >
           2.0 * static_cast<double>(most) * static_cast<double>(sample);
}

/// Lists entries of one piece in their cells.
class Lister {
public:
    Lister(const Grid& grid, const GridEntries& entries, std::uint64_t most, Piece& piece)
        : grid_(grid), entries_(entries), finder_(grid, entries.pad), most_(most), piece_(piece)
    {
    }

    void list(std::span<const std::uint32_t> chosen)
    {
        const auto quadrics = std::partition_point(chosen.begin(), chosen.end(),
                                                   [&](std::uint32_t entry) { return entries_.is_triangle(entry); });
        const std::span<const std::uint32_t> triangles{chosen.begin(), quadrics};
        for (std::size_t first = 0; first < triangles.size() && piece_.estimate <= most_; first += pack_size)
            list_block(triangles.subspan(first, std::min<std::size_t>(pack_size, triangles.size() - first)));
        for (auto entry = quadrics; entry != chosen.end() && piece_.estimate <= most_; ++entry) {
            const CellRange range = cells_of(grid_, entries_.box(*entry), entries_.pad);
            piece_.estimate += estimate(range);
            add_all(range, *entry);
        }
        piece_.references.resize(count_);
    }

private:
    void list_block(std::span<const std::uint32_t> triangles)
    {
        RangeBlock ranges;
        find_ranges(entries_, triangles, finder_, ranges);
        piece_.estimate += triangles.size();
        for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
            if ((ranges.wide >> lane & 1) == 0)
                add(ranges.lowest[lane], triangles[lane]);
            else
                list_wide({{ranges.lo[0][lane], ranges.lo[1][lane], ranges.lo[2][lane]},
                           {ranges.hi[0][lane], ranges.hi[1][lane], ranges.hi[2][lane]}},
                          triangles[lane]);
        }
    }

    void list_wide(const CellRange& range, std::uint32_t entry)
    {
        piece_.estimate += estimate(range) - 1;  // it was counted as one already
        if (range.cells() <= too_few_to_test) return add_all(range, entry);
        if (piece_.estimate > most_) return;
        const RootTriangle<float> t = entries_.triangle(entry);
        const glm::vec3 pad(entries_.pad);
        const TriangleBoxOverlap overlap(t.v[0], t.v[1], t.v[2], grid_.cell + 2.0f * pad);
        for_each_cell(range, [&](const glm::ivec3& c) {
            if (overlap.meets(grid_.lo + grid_.cell * glm::vec3(c) - pad)) add(cell_index(grid_, c), entry);
        });
    }

    void add_all(const CellRange& range, std::uint32_t entry)
    {
        if (piece_.estimate > most_) return;
        for_each_cell(range, [&](const glm::ivec3& c) { add(cell_index(grid_, c), entry); });
    }

    template <typename Visit>
    static void for_each_cell(const CellRange& range, const Visit& visit)
    {
        for (int z = range.lo.z; z <= range.hi.z; ++z)
            for (int y = range.lo.y; y <= range.hi.y; ++y)
                for (int x = range.lo.x; x <= range.hi.x; ++x) visit(glm::ivec3(x, y, z));
    }

    void add(std::uint32_t cell, std::uint32_t entry)
    {
        ++piece_.places[cell];
        if (count_ == piece_.references.size()) piece_.references.resize(2 * count_);
        piece_.references[count_++] = {cell, entry};
    }

    const Grid& grid_;
    const GridEntries& entries_;
    CellFinder finder_;
    std::uint64_t most_;
    Piece& piece_;
    std::size_t count_ = 0;  ///< of references; there is room for more
};

/// Turns counts into places: of a cell's list, a piece's share follows those of the pieces before.
std::uint32_t place_all(std::span<Piece> pieces, std::vector<std::uint32_t>& first)
{
    std::uint32_t total = 0;
    for (std::size_t cell = 0; cell + 1 < first.size(); ++cell) {
        first[cell] = total;
        for (Piece& piece : pieces) {
            const std::uint32_t count = piece.places[cell];
            piece.places[cell] = total;
            total += count;
        }
    }
    return first.back() = total;
}

}  // namespace

CellRange cells_of(const Grid& grid, const Aabb& box, float pad)
{
    const CellFinder finder(grid, pad);
    const auto cell = [&](const glm::vec3& at) {
        // in this order the first cell is what is no number's, where lengths overflow
        return glm::ivec3(glm::min(glm::max(glm::vec3(0.0f), (at - finder.lo) * finder.scale), finder.last));
    };
    return {cell(box.lo - pad), cell(box.hi + pad)};
}

std::uint64_t BinScratch::bytes() const
{
    std::uint64_t sum = 0;
    for (const Piece& piece : pieces)
        sum += sizeof(Reference) * piece.references.capacity() + 4 * piece.places.capacity();
    return sum;
}

bool bin(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen, std::uint64_t most,
         const Executor* executor, BinScratch& scratch, CellLists& lists)
{
    if (grid.cells() == 1) most = std::numeric_limits<std::uint64_t>::max();
    if (clearly_too_long(grid, entries, chosen, most)) return false;
    const std::size_t count = std::clamp<std::size_t>(chosen.size() / least_piece, 1,
                                                      executor ? static_cast<std::size_t>(executor->threads()) : 1);
    scratch.pieces.resize(std::max(count, scratch.pieces.size()));
    const std::span<Piece> pieces(scratch.pieces.data(), count);
    for_pieces(executor, count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const std::size_t from = chosen.size() * p / count, to = chosen.size() * (p + 1) / count;
            resize_for_overwrite(pieces[p].references, std::max((to - from) * 3 / 2, least_piece));
            pieces[p].places.assign(grid.cells(), 0);
            pieces[p].estimate = 0;
            Lister(grid, entries, most, pieces[p]).list(chosen.subspan(from, to - from));
        }
    });
    std::uint64_t estimate = 0;
    for (const Piece& piece : pieces) estimate += piece.estimate;
    if (estimate > most) return false;

    lists.first.resize(grid.cells() + 1);
    resize_for_overwrite(lists.entries, place_all(pieces, lists.first));
    for_pieces(executor, count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            for (const Reference& r : pieces[p].references) lists.entries[pieces[p].places[r.cell]++] = r.entry;
    });
    return true;
}

}  // namespace firstray::inline v0
