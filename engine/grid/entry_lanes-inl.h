// Entries as lanes: sixteen triangles' corners and boxes side by side. Included once per instruction set.
#if defined(FIRSTRAY_ENTRY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_ENTRY_LANES_INL_H_
#undef FIRSTRAY_ENTRY_LANES_INL_H_
#else
#define FIRSTRAY_ENTRY_LANES_INL_H_
#endif

#include <algorithm>
#include <span>

#include "engine/grid/entries.h"
#include "engine/primitive/pack_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

using Lanes = hn::Vec<PackLanes>;
using IntLanes = hn::RebindToSigned<PackLanes>;
constexpr std::size_t width = hn::MaxLanes(PackLanes());

/// Up to sixteen triangles; what is missing repeats the last.
struct Members {
    PlacedTriangle triangle[pack_size];

    HWY_INLINE Members(const GridEntries& entries, std::span<const std::uint32_t> from)
    {
        look_up(entries, from, triangle);
        std::fill(triangle + from.size(), triangle + pack_size, triangle[from.size() - 1]);
    }
};

struct CornerLanes {
    Lanes v[3][3];  ///< corner, axis
};

/// A corner of every fourth triangle, each with the number that follows it, one behind the other.
template <class D>
HWY_INLINE hn::Vec<D> load_points(D d, const glm::vec3* points, const PlacedTriangle* triangles, int corner)
{
    if constexpr (hn::MaxLanes(d) == 4) {
        return hn::LoadU(d, &points[triangles->corner[corner]].x);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, load_points(half, points, triangles + hn::MaxLanes(half), corner),
                           load_points(half, points, triangles, corner));
    }
}

/// The same corner of `width` triangles, turned into lanes; quicker than gathering coordinates.
HWY_INLINE void turn_points(const glm::vec3* points, const PlacedTriangle* triangles, int corner, Lanes (&axes)[3])
{
    const PackLanes d;
    const hn::Repartition<double, PackLanes> d2;
    const auto load = [&](int first) HWY_ATTR { return load_points(d, points, triangles + first, corner); };
    const auto p0 = load(0), p1 = load(1), p2 = load(2), p3 = load(3);
    const auto pair = [&](auto v) HWY_ATTR { return hn::BitCast(d2, v); };
    const auto xy01 = pair(hn::InterleaveLower(d, p0, p1)), xy23 = pair(hn::InterleaveLower(d, p2, p3)),
               z01 = pair(hn::InterleaveUpper(d, p0, p1)), z23 = pair(hn::InterleaveUpper(d, p2, p3));
    axes[0] = hn::BitCast(d, hn::InterleaveLower(d2, xy01, xy23));
    axes[1] = hn::BitCast(d, hn::InterleaveUpper(d2, xy01, xy23));
    axes[2] = hn::BitCast(d, hn::InterleaveLower(d2, z01, z23));
}

/// triangles  `width` of them
HWY_INLINE void load_corners(const glm::vec3* points, const PlacedTriangle* triangles, CornerLanes& lanes)
{
    for (int k = 0; k < 3; ++k) turn_points(points, triangles, k, lanes.v[k]);
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

HWY_INLINE void load_box(const glm::vec3* points, const PlacedTriangle* triangles, BoxLanes& box)
{
    CornerLanes corners;
    load_corners(points, triangles, corners);
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
