#include "engine/grid/bin.h"

#include <algorithm>
#include <limits>

#include "engine/grid/entry_kernels.h"
#include "engine/primitive/triangle_box.h"

namespace firstray::inline v0 {
namespace {

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

/// References, by estimate(), per entry if all were like a few of them; one where there are not even a few.
double expected_references(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen)
{
    const std::size_t sample = std::min(chosen.size() / sample_stride, largest_sample);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < sample; ++i)
        sum += estimate(cells_of(grid, entries.box(chosen[chosen.size() * i / sample]), entries.pad));
    return sample == 0 ? 1.0 : static_cast<double>(sum) / static_cast<double>(sample);
}

/// Lists entries of one piece in their cells.
class Lister {
public:
    Lister(const Grid& grid, const GridEntries& entries, std::uint64_t most, Piece& piece)
        : grid_(grid), entries_(entries), finder_(grid, entries.pad), most_(most), piece_(piece)
    {
        for (int more = 0; more < 8; ++more)
            for_each_cell({glm::ivec3(0), {more & 1, more >> 1 & 1, more >> 2}},
                          [&](const glm::ivec3& c) { few_[more].offset[few_[more].count++] = cell_index(grid, c); });
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
        count_new();
        piece_.cells.resize(count_);
        piece_.entries.resize(count_);
    }

private:
    void list_block(std::span<const std::uint32_t> triangles)
    {
        RangeBlock ranges;
        find_ranges(entries_, triangles, finder_, ranges);
        for (std::size_t lane = 0; lane < triangles.size();) {
            const std::uint32_t wide = ranges.wide >> lane;
            if ((wide & 1) == 0) {
                const std::size_t run =
                    std::min(triangles.size() - lane, wide ? static_cast<std::size_t>(__builtin_ctz(wide)) : pack_size);
                list_few(ranges, lane, triangles.subspan(lane, run));
                lane += run;
            } else {
                list_wide({{ranges.lo[0][lane], ranges.lo[1][lane], ranges.lo[2][lane]},
                           {ranges.hi[0][lane], ranges.hi[1][lane], ranges.hi[2][lane]}},
                          triangles[lane]);
                ++lane;
            }
        }
        count_new();
    }

    void list_few(const RangeBlock& ranges, std::size_t lane, std::span<const std::uint32_t> triangles)
    {
        make_room(triangles.size() * FewCells::most);
        const std::size_t listed =
            list_few_cells(few_, ranges, lane, triangles, piece_.cells.data() + count_, piece_.entries.data() + count_);
        count_ += listed;
        piece_.estimate += listed;
    }

    void list_wide(const CellRange& range, std::uint32_t entry)
    {
        piece_.estimate += estimate(range);
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
        make_room(1);
        piece_.cells[count_] = cell;
        piece_.entries[count_++] = entry;
    }

    void make_room(std::size_t more)
    {
        if (count_ + more <= piece_.cells.size()) return;
        piece_.entries.resize(2 * piece_.cells.size());
        piece_.cells.resize(2 * piece_.cells.size());
    }

    /// Counts the references that are new by cell.
    void count_new()
    {
        for (; counted_ < count_; ++counted_) ++piece_.places[piece_.cells[counted_]];
    }

    const Grid& grid_;
    const GridEntries& entries_;
    CellFinder finder_;
    std::uint64_t most_;
    Piece& piece_;
    FewCells few_[8];          ///< by RangeBlock::more
    std::size_t count_ = 0;    ///< of references; there is room for more
    std::size_t counted_ = 0;  ///< of those, by cell
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
        sum += 4 * (piece.cells.capacity() + piece.entries.capacity() + piece.places.capacity());
    return sum;
}

bool bin(const Grid& grid, const GridEntries& entries, std::span<const std::uint32_t> chosen, std::uint64_t most,
         const Executor* executor, BinScratch& scratch, CellLists& lists)
{
    if (grid.cells() == 1) most = std::numeric_limits<std::uint64_t>::max();
    const double expected = expected_references(grid, entries, chosen) * static_cast<double>(chosen.size());
    if (expected > 2.0 * static_cast<double>(most)) return false;
    const std::size_t count = std::clamp<std::size_t>(chosen.size() / least_piece, 1,
                                                      executor ? static_cast<std::size_t>(executor->threads()) : 1);
    scratch.pieces.resize(std::max(count, scratch.pieces.size()));
    const std::span<Piece> pieces(scratch.pieces.data(), count);
    const std::size_t room = least_piece + static_cast<std::size_t>(1.125 * expected) / count;
    for_pieces(executor, count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const std::size_t from = chosen.size() * p / count, to = chosen.size() * (p + 1) / count;
            resize_for_overwrite(pieces[p].cells, room);
            resize_for_overwrite(pieces[p].entries, room);
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
        for (std::size_t p = begin; p < end; ++p) {
            Piece& piece = pieces[p];
            for (std::size_t i = 0; i < piece.cells.size(); ++i)
                lists.entries[piece.places[piece.cells[i]]++] = piece.entries[i];
        }
    });
    return true;
}

}  // namespace firstray::inline v0
