// Entries as lanes: sixteen triangles' corners and boxes side by side. Included once per instruction set.
#if defined(FIRSTRAY_ENTRY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_ENTRY_LANES_INL_H_
#undef FIRSTRAY_ENTRY_LANES_INL_H_
#else
#define FIRSTRAY_ENTRY_LANES_INL_H_
#endif

#include <algorithm>

#include "engine/grid/entries.h"
#include "engine/primitive/pack_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

using Lanes = hn::Vec<PackLanes>;
using IntLanes = hn::RebindToSigned<PackLanes>;
constexpr std::size_t width = hn::MaxLanes(PackLanes());

/// Up to sixteen entries; what is missing repeats the last.
struct Members {
    alignas(64) std::uint32_t entry[pack_size];

    HWY_INLINE Members(const std::uint32_t* from, std::size_t count)
    {
        std::copy_n(from, count, entry);
        std::fill(entry + count, entry + pack_size, from[count - 1]);
    }
};

struct CornerLanes {
    Lanes v[3][3];  ///< corner, axis
};

/// Every fourth of some points, each with the number that follows it, one behind the other.
template <class D>
HWY_INLINE hn::Vec<D> load_points(D d, const float* const* points)
{
    if constexpr (hn::MaxLanes(d) == 4) {
        return hn::LoadU(d, points[0]);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, load_points(half, points + hn::MaxLanes(half)), load_points(half, points));
    }
}

/// Turns `width` points into lanes; quicker than gathering their coordinates.
HWY_INLINE void turn_points(const float* const* points, Lanes (&axes)[3])
{
    const PackLanes d;
    const hn::Repartition<double, PackLanes> d2;
    const auto p0 = load_points(d, points), p1 = load_points(d, points + 1), p2 = load_points(d, points + 2),
               p3 = load_points(d, points + 3);
    const auto pair = [&](auto v) HWY_ATTR { return hn::BitCast(d2, v); };
    const auto xy01 = pair(hn::InterleaveLower(d, p0, p1)), xy23 = pair(hn::InterleaveLower(d, p2, p3)),
               z01 = pair(hn::InterleaveUpper(d, p0, p1)), z23 = pair(hn::InterleaveUpper(d, p2, p3));
    axes[0] = hn::BitCast(d, hn::InterleaveLower(d2, xy01, xy23));
    axes[1] = hn::BitCast(d, hn::InterleaveUpper(d2, xy01, xy23));
    axes[2] = hn::BitCast(d, hn::InterleaveLower(d2, z01, z23));
}

/// entry  `width` of them
HWY_INLINE void load_corners(const GridEntries& entries, const std::uint32_t* entry, CornerLanes& lanes)
{
    const float* points[3][width];
    for (std::size_t i = 0; i < width; ++i) {
        const glm::vec3* const from = entries.corners ? entries.vertices : entries.own_vertices.data();
        const glm::uvec3 place = entries.corners ? entries.corners[entries.ids[entry[i]] & ~transmitting_bit]
                                                 : 3u * entry[i] + glm::uvec3(0, 1, 2);
        for (int k = 0; k < 3; ++k) points[k][i] = &from[place[k]].x;
    }
    for (int k = 0; k < 3; ++k) turn_points(points[k], lanes.v[k]);
}

struct BoxLanes {
    Lanes lo[3], hi[3];
};

HWY_INLINE void find_box(const CornerLanes& corners, BoxLanes& box)
{
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = hn::Min(hn::Min(corners.v[0][axis], corners.v[1][axis]), corners.v[2][axis]);
        box.hi[axis] = hn::Max(hn::Max(corners.v[0][axis], corners.v[1][axis]), corners.v[2][axis]);
    }
}

HWY_INLINE void load_box(const GridEntries& entries, const std::uint32_t* entry, BoxLanes& box)
{
    CornerLanes corners;
    load_corners(entries, entry, corners);
    find_box(corners, box);
}

/// What reaches the voxel only through the pad is drawn to its nearest side.
HWY_INLINE void clip(BoxLanes& box, const Aabb& voxel)
{
    const PackLanes d;
    for (int axis = 0; axis < 3; ++axis) {
        const auto lo = hn::Set(d, voxel.lo[axis]), hi = hn::Set(d, voxel.hi[axis]);
        box.lo[axis] = hn::Min(hn::Max(box.lo[axis], lo), hi);
        box.hi[axis] = hn::Min(hn::Max(box.hi[axis], lo), hi);
    }
}

HWY_INLINE Aabb reduce(const BoxLanes& box)
{
    const PackLanes d;
    Aabb result;
    for (int axis = 0; axis < 3; ++axis) {
        result.lo[axis] = hn::GetLane(hn::MinOfLanes(d, box.lo[axis]));
        result.hi[axis] = hn::GetLane(hn::MaxOfLanes(d, box.hi[axis]));
    }
    return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
