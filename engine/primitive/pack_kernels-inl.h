// Wide kernels: one ray against sixteen triangles or boxes. Included once per instruction set (no include guard of the
// usual kind); what they return does not depend on it.
#if defined(FIRSTRAY_PACK_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_PACK_KERNELS_INL_H_
#undef FIRSTRAY_PACK_KERNELS_INL_H_
#else
#define FIRSTRAY_PACK_KERNELS_INL_H_
#endif

#include <hwy/highway.h>

#include "engine/core/search_ray.h"
#include "engine/primitive/triangle_pack.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using PackLanes = hn::CappedTag<float, pack_size>;

/// A mask of lanes as bits.
template <class D, class Mask>
HWY_INLINE std::uint32_t bits_of(D d, Mask mask)
{
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    std::uint32_t bits;
    __builtin_memcpy(&bits, bytes, sizeof bits);
    return bits & ((2u << (hn::Lanes(d) - 1)) - 1);
}

/// The mask whose bits these are.
template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, std::uint32_t bits)
{
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
    return hn::LoadMaskBits(d, bytes);
}

/// longest_edge() of triangle.h, of triangles in lanes.
/// v  corner, axis
template <class V>
HWY_INLINE V longest_edges(const V (&v)[3][3])
{
    auto longest = hn::Zero(PackLanes());
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 3; ++k) longest = hn::Max(longest, hn::Abs(hn::Sub(v[(k + 1) % 3][axis], v[k][axis])));
    return longest;
}

/// A ray as boxes and grids see it. It starts where the ray enters the structure, at `shift` along the ray, so that its
/// numbers are no larger than the structure's; its own t, walk t, counts from there.
struct WalkRay {
    alignas(16) float origin[4];  ///< here and below: x, y, z; the fourth means nothing
    alignas(16) float direction[4];
    alignas(16) float inverse[4];            ///< 1 / direction, limited so that no product overflows
    alignas(16) float box_shift[4];          ///< -origin * inverse
    alignas(16) std::uint32_t near_side[4];  ///< on which side of boxes, 0 low or 1 high, the ray enters them
    alignas(16) double exact_direction[4];
    alignas(16) double exact_inverse[4];  ///< 1 / direction; very large where that is 0
    double shift = 0.0;
    float t_pad = 0.0f;         ///< walk t in which the ray passes the structure's pad
    float origin_error = 0.0f;  ///< by how much the origin is off, per coordinate
};

/// A ray as the triangle filter sees it: it starts where the walk does, and space is sheared so that it points along
/// its major axis, where a triangle becomes flat. Depth counts from there along that axis. The filter only chooses what
/// the exact test looks at, so its errors are bounded instead of avoided.
/// source  the shear: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013
struct FilterRay {
    int x, y, z;                        ///< axes: z is the major one
    float start_x, start_y, start_z;    ///< start_z times forward
    float slope_x, slope_y;             ///< of the ray, by depth
    float forward;                      ///< 1 or -1: the direction's sign along z
    float speed;                        ///< depth in a walk t of 1
    float error;                        ///< by how much start and corners may be off, and the ray's own rounding
    float error_per_edge = 0.0f;        ///< of a side, beyond what comes from coordinates
    float depth_error_per_edge = 0.0f;  ///< by how much a hit may lie before or behind all corners
    float margin = 6.0f;                ///< of depths, in errors; infinite where products with depths overflow
    float near_end, far_end = 0.0f;     ///< depths between which hits are of interest
    float farthest;                     ///< nothing is beyond this depth

    /// Nothing beyond this walk t is of interest.
    void set_far_end(float walk_t, float pad) { far_end = std::min(speed * walk_t + pad, farthest); }
};

/// largest  the structure's largest coordinate
/// blur     how far a corner that the test sees may be from its place in the pack, per coordinate
/// loose    admit also what Precision::fast may take for a hit: how much larger its error is in the structure's system
///          than in its own (1 where they are the same); 0 admits only what the ray meets
/// reach    largest coordinate of the ray's origin
HWY_INLINE FilterRay make_filter_ray(const WalkRay& walk, float largest, float blur, float loose, double reach)
{
    static constexpr int next[3] = {1, 2, 0};
    const double(&d)[4] = walk.exact_direction;
    // No branches: rays of all directions come one after the other.
    const double x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]);
    const int x_first = int{x > y} & int{x > z}, y_first = int{x <= y} & int{y > z};
    FilterRay f;
    f.z = 2 - 2 * x_first - y_first;
    f.x = next[f.z];
    f.y = next[f.x];
    f.forward = std::copysign(1.0f, walk.direction[f.z]);
    f.speed = std::abs(walk.direction[f.z]);
    const double inverse = std::abs(walk.exact_inverse[f.z]);
    f.slope_x = static_cast<float>(d[f.x] * inverse);
    f.slope_y = static_cast<float>(d[f.y] * inverse);
    f.start_x = walk.origin[f.x];
    f.start_y = walk.origin[f.y];
    f.start_z = walk.origin[f.z] * f.forward;
    // A pack's corners may have come from double: half an ulp in each of two coordinates.
    f.error = 2.0f * (walk.origin_error + blur) + largest * 0x1.01p-23f;
    f.near_end = -2.0f * f.error;
    f.farthest = 8.0f * (largest + blur) + 1e-30f;
    if (largest > 0x1p36f) f.margin = std::numeric_limits<float>::infinity();
    if (loose > 0.0f) {
        f.depth_error_per_edge = loose;  // a hundredth of it beside the triangle, on a plane of least_slope
        f.error_per_edge = loose * side_error<float> * (largest + static_cast<float>(reach));
    }
    return f;
}

/// The lanes of a pack that the ray may meet: every one that the test accepts, and few others.
/// depths  gets about where the hits of these are, to find the nearest first
HWY_INLINE std::uint32_t candidates(const TrianglePack& pack, const FilterRay& ray, float* HWY_RESTRICT depths)
{
    const PackLanes d;
    const auto slope_x = hn::Set(d, ray.slope_x), slope_y = hn::Set(d, ray.slope_y);
    const auto start_x = hn::Set(d, ray.start_x), start_y = hn::Set(d, ray.start_y), start_z = hn::Set(d, ray.start_z);
    const auto forward = hn::Set(d, ray.forward), base = hn::Set(d, ray.error);
    const auto near_end = hn::Set(d, ray.near_end), far_end = hn::Set(d, ray.far_end);
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += static_cast<int>(hn::Lanes(d))) {
        const auto along = [&](int corner, int axis) HWY_ATTR { return hn::Load(d, pack.v[corner][axis] + lane); };
        const auto z0 = hn::MulSub(along(0, ray.z), forward, start_z),
                   z1 = hn::MulSub(along(1, ray.z), forward, start_z),
                   z2 = hn::MulSub(along(2, ray.z), forward, start_z);
        const auto x0 = hn::NegMulAdd(slope_x, z0, hn::Sub(along(0, ray.x), start_x));
        const auto y0 = hn::NegMulAdd(slope_y, z0, hn::Sub(along(0, ray.y), start_y));
        const auto x1 = hn::NegMulAdd(slope_x, z1, hn::Sub(along(1, ray.x), start_x));
        const auto y1 = hn::NegMulAdd(slope_y, z1, hn::Sub(along(1, ray.y), start_y));
        const auto x2 = hn::NegMulAdd(slope_x, z2, hn::Sub(along(2, ray.x), start_x));
        const auto y2 = hn::NegMulAdd(slope_y, z2, hn::Sub(along(2, ray.y), start_y));
        const auto u = hn::NegMulAdd(x2, y1, hn::Mul(x1, y2));
        const auto v = hn::NegMulAdd(x0, y2, hn::Mul(x2, y0));
        const auto w = hn::NegMulAdd(x1, y0, hn::Mul(x0, y1));
        const auto least = hn::Min(hn::Min(u, v), w), most = hn::Max(hn::Max(u, v), w);
        const auto low = hn::Min(hn::Min(z0, z1), z2), high = hn::Max(hn::Max(z0, z1), z2);
        const auto farther = hn::Max(high, hn::Neg(low)), edge = hn::Load(d, pack.edge + lane);
        // With h half an ulp of 1, a sheared corner is off by 6 h times its depth and 4 h times the edge: 2 h for each
        // coordinate and 2 h more for the product with the slope, of a corner within 2 edges of the ray, as are all of
        // a triangle that the ray meets. Where the test sees it, its edge is longer by off at most, so the side's error
        // is at most 12 * off * edge + 16 * off^2.
        const auto off = hn::MulAdd(hn::Set(d, 0x1p-21f), hn::Add(farther, edge), base);
        const auto least_error =
            hn::MulAdd(hn::Mul(hn::Set(d, 16.0f), off), off, hn::Set(d, std::numeric_limits<float>::min()));
        const auto error =
            hn::MulAdd(hn::MulAdd(hn::Set(d, 12.0f), off, hn::Set(d, ray.error_per_edge)), edge, least_error);
        // Most of what the line meets lies behind the ray's origin or beyond its end: first by the corners' depths ...
        const auto wide = hn::MulAdd(hn::Set(d, ray.depth_error_per_edge), edge, off);
        const auto between = hn::And(hn::Le(low, hn::Add(far_end, wide)), hn::Ge(high, hn::Sub(near_end, wide)));
        const auto maybe = hn::And(between, hn::Or(hn::Ge(least, hn::Neg(error)), hn::Le(most, error)));
        if (hn::AllFalse(d, maybe)) continue;
        // ... then by the depth of the hit, times the sum of the sides: each side's error counts once for every depth,
        // and where they cancel, the sides are no larger than six errors together.
        const auto sum = hn::Add(hn::Add(u, v), w), size = hn::Abs(sum);
        const auto depth = hn::Xor(hn::MulAdd(u, z0, hn::MulAdd(v, z1, hn::Mul(w, z2))), hn::And(sum, hn::SignBit(d)));
        const auto margin = hn::Mul(hn::Set(d, ray.margin), error);
        const auto too_far = hn::Gt(depth, hn::MulAdd(far_end, size, hn::Mul(margin, hn::Add(farther, far_end))));
        const auto too_near = hn::Lt(depth, hn::MulSub(near_end, size, hn::Mul(margin, hn::Sub(farther, near_end))));
        hn::Store(hn::Div(depth, size), d, depths + lane);
        found |= bits_of(d, hn::AndNot(hn::Or(too_far, too_near), maybe)) << lane;
    }
    return found;
}

/// The lane of a mask, not empty, with the smallest number.
HWY_INLINE int nearest_lane(std::uint64_t lanes, const float* numbers)
{
    int nearest = __builtin_ctzll(lanes);
    for (std::uint64_t rest = lanes & (lanes - 1); rest != 0; rest &= rest - 1)
        if (const int lane = __builtin_ctzll(rest); numbers[lane] < numbers[nearest]) nearest = lane;
    return nearest;
}

/// Which boxes of a block the ray may meet between two walk ts; entries gets where it enters each.
HWY_INLINE std::uint32_t boxes_met(const PackBoxes& boxes, const WalkRay& ray, float t_begin, float t_end,
                                   float* HWY_RESTRICT entries)
{
    const PackLanes d;
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += static_cast<int>(hn::Lanes(d))) {
        auto enter = hn::Set(d, t_begin), leave = hn::Set(d, t_end);
        for (int axis = 0; axis < 3; ++axis) {
            const auto inverse = hn::Set(d, ray.inverse[axis]), shift = hn::Set(d, ray.box_shift[axis]);
            const auto near = hn::Load(d, boxes.side[ray.near_side[axis]][axis] + lane);
            const auto far = hn::Load(d, boxes.side[ray.near_side[axis] ^ 1][axis] + lane);
            enter = hn::Max(enter, hn::MulAdd(near, inverse, shift));
            leave = hn::Min(leave, hn::MulAdd(far, inverse, shift));
        }
        hn::Store(enter, d, entries + lane);
        found |= bits_of(d, hn::Le(enter, leave)) << lane;
    }
    return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
