#include "engine/grid/entry_kernels.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/grid/surface_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/grid/entry_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/grid/entry_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// triangles  whose boxes these are; lanes beyond them do not count
HWY_INLINE void offer_larger(const BoxLanes& box, std::span<const std::uint32_t> triangles, LargestTriangles& largest)
{
    const PackLanes d;
    const auto x = hn::Sub(box.hi[0], box.lo[0]), y = hn::Sub(box.hi[1], box.lo[1]), z = hn::Sub(box.hi[2], box.lo[2]);
    const auto area = hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
    std::uint32_t larger =
        bits_of(d, hn::And(hn::FirstN(d, triangles.size()), hn::Gt(area, hn::Set(d, largest.least()))));
    if (HWY_LIKELY(larger == 0)) return;
    alignas(64) float areas[width];
    hn::Store(area, d, areas);
    for (; larger != 0; larger &= larger - 1) {
        const int lane = __builtin_ctz(larger);
        if (areas[lane] > largest.least()) largest.offer({areas[lane], triangles[static_cast<std::size_t>(lane)]});
    }
}

Aabb bounds_of_triangles(const GridEntries& entries, std::span<const std::uint32_t> triangles,
                         LargestTriangles* largest)
{
    const PackLanes d;
    BoxLanes sum;
    for (int axis = 0; axis < 3; ++axis) {
        sum.lo[axis] = hn::Set(d, std::numeric_limits<float>::infinity());
        sum.hi[axis] = hn::Neg(sum.lo[axis]);
    }
    for (std::size_t first = 0; first < triangles.size(); first += pack_size) {
        const auto block = triangles.subspan(first, std::min<std::size_t>(pack_size, triangles.size() - first));
        const Members members(entries, block);
        for (std::size_t lane = 0; lane < block.size(); lane += width) {
            BoxLanes box;
            load_box(entries.points(), members.triangle + lane, box);
            for (int axis = 0; axis < 3; ++axis) {
                sum.lo[axis] = hn::Min(sum.lo[axis], box.lo[axis]);
                sum.hi[axis] = hn::Max(sum.hi[axis], box.hi[axis]);
            }
            if (largest) offer_larger(box, block.subspan(lane), *largest);
        }
    }
    return reduce(sum);
}

void ranges_of_triangles(const GridEntries& entries, std::span<const std::uint32_t> triangles, const CellFinder& finder,
                         RangeBlock& ranges)
{
    const PackLanes d;
    const IntLanes di;
    const Members members(entries, triangles);
    const auto pad = hn::Set(d, finder.pad), zero = hn::Zero(d);
    ranges.wide = 0;
    for (std::size_t lane = 0; lane < triangles.size(); lane += width) {
        BoxLanes box;
        load_box(entries.points(), members.triangle + lane, box);
        auto lowest = hn::Zero(di), more = hn::Zero(di), most = hn::Zero(di);
        for (int axis = 2; axis >= 0; --axis) {
            const auto lo = hn::Set(d, finder.lo[axis]), scale = hn::Set(d, finder.scale[axis]),
                       last = hn::Set(d, finder.last[axis]);
            const auto cell = [&](auto at) HWY_ATTR {
                return hn::ConvertTo(di, hn::Min(hn::Max(hn::Mul(hn::Sub(at, lo), scale), zero), last));
            };
            const auto from = cell(hn::Sub(box.lo[axis], pad)), to = cell(hn::Add(box.hi[axis], pad));
            hn::Store(from, di, ranges.lo[axis] + lane);
            hn::Store(to, di, ranges.hi[axis] + lane);
            lowest = hn::Add(hn::Mul(lowest, hn::Set(di, finder.dims[axis])), from);
            const auto beyond = hn::Sub(to, from);
            more = hn::Add(hn::Add(more, more), hn::Min(beyond, hn::Set(di, 1)));
            most = hn::Max(most, beyond);
        }
        hn::Store(lowest, di, reinterpret_cast<std::int32_t*>(ranges.lowest) + lane);
        hn::Store(more, di, reinterpret_cast<std::int32_t*>(ranges.more) + lane);
        ranges.wide |= bits_of(di, hn::Gt(most, hn::Set(di, 1))) << lane;
    }
}

/// As many cells as there may be are written for each triangle, and what is too much is overwritten: how many they are
/// is not to be foreseen, and a wrong guess takes longer.
std::size_t list_few_cells_of(const FewCells (&few)[8], const RangeBlock& ranges, std::size_t lane,
                              std::span<const std::uint32_t> triangles, std::uint32_t* cells, std::uint32_t* entries)
{
    const hn::CappedTag<std::uint32_t, FewCells::most> d;
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const FewCells& reached = few[ranges.more[lane + t]];
        for (std::size_t i = 0; i < FewCells::most; i += hn::Lanes(d)) {
            const auto from_lowest = hn::Load(d, reached.offset + i);
            hn::StoreU(hn::Add(hn::Set(d, ranges.lowest[lane + t]), from_lowest), d, cells + count + i);
            hn::StoreU(hn::Set(d, triangles[t]), d, entries + count + i);
        }
        count += reached.count;
    }
    return count;
}

/// Places on a Morton curve through a voxel, `bits` an axis.
template <int bits>
struct MortonCurve {
    const Aabb& voxel;
    glm::vec3 scale;

    explicit MortonCurve(const Aabb& box)
        : voxel(box), scale(static_cast<float>(1 << bits) / glm::max(box.size(), glm::vec3(1e-30f)))
    {
    }
    /// Of the middles of boxes.
    HWY_INLINE hn::Vec<IntLanes> places(const BoxLanes& box) const
    {
        const PackLanes d;
        const IntLanes di;
        auto place = hn::Zero(di);
        for (int axis = 0; axis < 3; ++axis) {
            const auto middle = hn::Mul(hn::Add(box.lo[axis], box.hi[axis]), hn::Set(d, 0.5f));
            const auto at = hn::Mul(hn::Sub(middle, hn::Set(d, voxel.lo[axis])), hn::Set(d, scale[axis]));
            const auto x =
                hn::ConvertTo(di, hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, static_cast<float>((1 << bits) - 1))));
            place = hn::Or(place, hn::ShiftLeftSame(spread(x), axis));
        }
        return place;
    }

private:
    /// Spreads three bits so that two zeros stand between them.
    static HWY_INLINE hn::Vec<IntLanes> spread(hn::Vec<IntLanes> x)
    {
        const IntLanes di;
        const auto bit = [&](int mask) HWY_ATTR { return hn::And(x, hn::Set(di, mask)); };
        return hn::Or(bit(1), hn::Or(hn::ShiftLeft<2>(bit(2)), hn::ShiftLeft<4>(bit(4))));
    }
};

/// Sorts by counting, which keeps the order of equal ones: a few triangles for each place on the curve are near enough
/// to each other, and comparing takes longer.
template <int bits>
HWY_NOINLINE void sort_along_curve(const glm::vec3* points, const PlacedTriangles& triangles, const Aabb& voxel,
                                   PlacedTriangles& sorted)
{
    constexpr std::size_t places = std::size_t{1} << (3 * bits);
    const IntLanes di;
    const MortonCurve<bits> curve(voxel);
    thread_local RawVector<std::int32_t> place_of;
    place_of.resize(triangles.count() + pack_size);
    std::uint32_t first[places] = {};
    for (std::size_t begin = 0; begin < triangles.count(); begin += width) {
        BoxLanes box;
        load_box(points, triangles.from(begin), box);
        clip(box, voxel);
        hn::StoreU(curve.places(box), di, place_of.data() + begin);
        const std::size_t end = std::min(begin + width, triangles.count());
        for (std::size_t i = begin; i < end; ++i) ++first[place_of[i]];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& place : first) sum += std::exchange(place, sum);
    sorted.resize(triangles.count());
    for (std::size_t i = 0; i < triangles.count(); ++i) sorted[first[place_of[i]]++] = triangles[i];
    sorted.repeat_last();
}

/// The triangles, neighbours in space near each other; as they are if they fill at most one pack.
const PlacedTriangles& in_clusters(const glm::vec3* points, const PlacedTriangles& triangles, const Aabb& voxel,
                                   PackOrder order)
{
    constexpr std::size_t few = 128;    // two triangles for each of 64 places
    constexpr std::size_t most = 1024;  // ordered by surface together
    if (triangles.count() <= pack_size) return triangles;
    thread_local PlacedTriangles sorted;
    if (triangles.count() <= few)
        sort_along_curve<2>(points, triangles, voxel, sorted);
    else
        sort_along_curve<3>(points, triangles, voxel, sorted);
    if (order == PackOrder::by_surface) {
        for (std::size_t begin = 0; begin < sorted.count(); begin += most)
            order_by_surface(points, voxel, {&sorted[begin], std::min(most, sorted.count() - begin)});
        sorted.repeat_last();
    }
    return sorted;
}

/// Copies up to sixteen triangles; sum becomes their boxes, those of a pack's parts put together.
HWY_INLINE void fill_pack(const glm::vec3* points, const PlacedTriangle* triangles, std::size_t count,
                          TrianglePack& pack, BoxLanes& sum)
{
    const PackLanes d;
    for (std::size_t lane = 0; lane < pack_size; ++lane) pack.id[lane] = triangles[lane].id;
    std::fill(pack.id + count, pack.id + pack_size, no_primitive);
    for (std::size_t lane = 0; lane < pack_size; lane += width) {
        const auto is_used = hn::FirstN(d, count > lane ? count - lane : 0);
        const auto nowhere = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
        CornerLanes c;
        load_corners(points, triangles + lane, c);
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                hn::Store(hn::IfThenElse(is_used, c.v[k][axis], nowhere), d, pack.v[k][axis] + lane);
        hn::Store(hn::IfThenElse(is_used, longest_edges(c.v), nowhere), d, pack.edge + lane);
        BoxLanes box;
        find_box(c, box);  // lanes that are not used repeat one that is
        for (int axis = 0; axis < 3; ++axis) {
            sum.lo[axis] = lane == 0 ? box.lo[axis] : hn::Min(sum.lo[axis], box.lo[axis]);
            sum.hi[axis] = lane == 0 ? box.hi[axis] : hn::Max(sum.hi[axis], box.hi[axis]);
        }
    }
}

void set_box(PackBoxes& boxes, std::size_t lane, const Aabb& box, float pad)
{
    boxes.set(lane, {box.lo - pad, box.hi + pad});
}

void fill_packs_of(const VoxelList& list, const GridEntries& entries, const PlacedTriangles& triangles,
                   const Aabb& voxel, PackOrder order, GridStructure& structure)
{
    const PlacedTriangles& sorted = in_clusters(entries.points(), triangles, voxel, order);
    const bool boxed = list.box_blocks() > 0;
    for (std::size_t p = 0; p < list.packs; ++p) {
        const std::size_t begin = p * pack_size, count = std::min<std::size_t>(pack_size, sorted.count() - begin);
        BoxLanes box;
        fill_pack(entries.points(), sorted.from(begin), count, structure.packs[list.first_pack + p], box);
        if (!boxed) continue;
        clip(box, voxel);  // the union of clipped boxes is the clipped union, as all of them meet the voxel
        set_box(structure.boxes[list.first_boxes + p / pack_size], p % pack_size, reduce(box), entries.pad);
    }
    for (std::size_t p = list.packs; p < std::size_t{list.box_blocks()} * pack_size; ++p)
        set_box(structure.boxes[list.first_boxes + p / pack_size], p % pack_size, {}, 0.0f);
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace firstray::inline v0 {

HWY_EXPORT(bounds_of_triangles);
HWY_EXPORT(ranges_of_triangles);
HWY_EXPORT(list_few_cells_of);
HWY_EXPORT(fill_packs_of);

void LargestTriangles::offer(const Triangle& triangle)
{
    const auto end = found_.begin() + count_, place = std::upper_bound(found_.begin(), end, triangle);
    if (place == found_.end()) return;
    if (count_ < pack_size) ++count_;
    std::copy_backward(place, found_.begin() + count_ - 1, found_.begin() + count_);
    *place = triangle;
}

Aabb bounds_of(const GridEntries& entries, std::span<const std::uint32_t> chosen, LargestTriangles* largest)
{
    const auto end = std::partition_point(chosen.begin(), chosen.end(),
                                          [&](std::uint32_t entry) { return entries.is_triangle(entry); });
    Aabb box;
    if (end != chosen.begin()) box = HWY_DYNAMIC_DISPATCH(bounds_of_triangles)(entries, {chosen.begin(), end}, largest);
    for (auto quadric = end; quadric != chosen.end(); ++quadric) box.grow(entries.box(*quadric));
    return box;
}

Aabb bounds_of(const GridEntries& entries, const Executor* executor, LargestTriangles* largest)
{
    constexpr std::size_t grain = 4096, most_pieces = 256;
    const std::size_t pieces = std::clamp<std::size_t>(entries.count() / grain, 1, most_pieces);
    std::vector<Aabb> bounds(pieces);
    std::vector<LargestTriangles> found(largest ? pieces : 0);
    for_pieces(executor, pieces, 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> numbers(grain);
        for (std::size_t i = begin; i < end; ++i) {
            const auto first = static_cast<std::uint32_t>(entries.count() * i / pieces),
                       last = static_cast<std::uint32_t>(entries.count() * (i + 1) / pieces);
            for (std::uint32_t from = first; from < last; from += grain) {
                const std::size_t count = std::min<std::size_t>(grain, last - from);
                std::iota(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count), from);
                bounds[i].grow(bounds_of(entries, {numbers.data(), count}, largest ? &found[i] : nullptr));
            }
        }
    });
    Aabb all;
    for (const Aabb& box : bounds) all.grow(box);
    for (const LargestTriangles& some : found)
        for (const LargestTriangles::Triangle& triangle : some.found()) largest->offer(triangle);
    return all;
}

void find_ranges(const GridEntries& entries, std::span<const std::uint32_t> triangles, const CellFinder& finder,
                 RangeBlock& ranges)
{
    HWY_DYNAMIC_DISPATCH(ranges_of_triangles)(entries, triangles, finder, ranges);
}

std::size_t list_few_cells(const FewCells (&few)[8], const RangeBlock& ranges, std::size_t lane,
                           std::span<const std::uint32_t> triangles, std::uint32_t* cells, std::uint32_t* entries)
{
    return HWY_DYNAMIC_DISPATCH(list_few_cells_of)(few, ranges, lane, triangles, cells, entries);
}

void fill_packs(const VoxelList& list, const GridEntries& entries, const PlacedTriangles& triangles, const Aabb& voxel,
                PackOrder order, GridStructure& structure)
{
    HWY_DYNAMIC_DISPATCH(fill_packs_of)(list, entries, triangles, voxel, order, structure);
}

}  // namespace firstray::inline v0
#endif  // HWY_ONCE
