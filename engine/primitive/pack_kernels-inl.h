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

/// A ray as boxes and grids see it. It starts where the ray enters the structure, at `shift` along the ray, so that its
/// numbers are no larger than the structure's; its own t, walk t, counts from there.
struct WalkRay {
    alignas(16) float origin[4];  ///< x, y, z, unused
    alignas(16) float direction[4];
    alignas(16) float inverse[4];  ///< 1 / direction, limited so that no product overflows
    double shift = 0.0;
    float t_pad = 0.0f;        ///< walk t in which the ray passes the structure's pad
    glm::dvec3 exact_inverse;  ///< 1 / direction; very large where that is 0
    glm::dvec3 near;           ///< a place on the ray, as near as it takes for double to tell the next ones
};

/// A ray as the triangle filter sees it: sheared so that it points along its major axis, where a triangle becomes flat.
/// It only chooses what the exact test looks at, so its errors are bounded instead of avoided.
/// source  the shear: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013
struct FilterRay {
    int x, y, z;             ///< axes: z is the major one
    float slope_x, slope_y;  ///< of the ray: dx / dz, dy / dz
    float start_x, start_y;  ///< where it meets z = 0
    float error_per_edge, error;
    float forward;  ///< 1 or -1: the direction's sign along z
    float largest;  ///< the structure's largest coordinate
    // Depth is forward * z. Hits are of interest from near_end to far_end, give or take what a margin says per error of
    // the sides.
    float near_end = 0.0f, near_margin = 0.0f, far_end = 0.0f, far_margin = 0.0f;
    float margin = 6.0f;  ///< infinite where products with depths overflow: they then keep nothing out
    float depth_error, depth_error_per_edge;  ///< by how much a hit may lie before or behind all corners
    float base = 0.0f, speed = 0.0f;          ///< depth at walk t is base + speed * t

    /// Where the walk begins; nothing before it is of interest.
    void set_near_end(const WalkRay& walk, float pad)
    {
        base = forward * walk.origin[z];
        speed = std::abs(walk.direction[z]);
        near_end = base - 2.0f * pad;
        near_margin = margin * (largest + std::abs(near_end));
    }
    /// Nothing beyond this walk t is of interest.
    void set_far_end(float walk_t, float pad)
    {
        far_end = std::min(base + speed * walk_t + pad, 1e30f);  // finite, so that products with zero are numbers
        far_margin = margin * (largest + std::abs(far_end));
    }
};

/// o, d     a place on the ray, not too far from the structure, and its direction, in the structure's system
/// inverse  1 / direction, where it is not 0
/// largest  the structure's largest coordinate
/// blur     how far a corner that the test sees may be from its place in the pack, per coordinate
/// loose    admit also what Precision::fast may take for a hit: how much larger its error is in the structure's system
///          than in its own (1 where they are the same); 0 admits only what the ray meets
/// reach    largest coordinate of the ray's origin
HWY_INLINE FilterRay make_filter_ray(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& inverse, float largest,
                                     float blur, float loose, double reach)
{
    const glm::dvec3 along = glm::abs(d);
    FilterRay f;
    f.z = along.x > along.y ? (along.x > along.z ? 0 : 2) : (along.y > along.z ? 1 : 2);
    f.x = f.z == 2 ? 0 : f.z + 1;
    f.y = f.x == 2 ? 0 : f.x + 1;
    f.forward = d[f.z] > 0.0 ? 1.0f : -1.0f;
    f.largest = largest;
    if (largest > 0x1p40f) f.margin = std::numeric_limits<float>::infinity();
    const double slope_x = d[f.x] * inverse[f.z], slope_y = d[f.y] * inverse[f.z];
    f.slope_x = static_cast<float>(slope_x);
    f.slope_y = static_cast<float>(slope_y);
    f.start_x = static_cast<float>(o[f.x] - slope_x * o[f.z]);
    f.start_y = static_cast<float>(o[f.y] - slope_y * o[f.z]);
    // A sheared vertex is off by at most 16 half ulps of the largest coordinate (1 for the slope, 2 or 3 for the
    // product and difference, 6 for the start, 4 for the last difference, 2 for rounding the vertex where it came from
    // double), and by twice the blur. Corners of a triangle that the ray meets are within 2 edges of the ray, so the
    // side's error is at most 12 * off * edge + 2 * off^2.
    const float off = largest * 0x1p-20f + 2.0f * blur;
    f.error_per_edge = 12.0f * off;
    f.error = 2.0f * off * off + std::numeric_limits<float>::min();
    f.depth_error = off;
    f.depth_error_per_edge = 0.0f;
    if (loose > 0.0f) {
        f.depth_error_per_edge = loose;  // a hundredth of it beside the triangle, on a plane of least_slope
        f.error_per_edge += loose * side_error<float> * (largest + static_cast<float>(reach));
    }
    return f;
}

/// The lanes of a pack that the ray may meet: every one that the test accepts, and few others.
HWY_INLINE std::uint32_t candidates(const TrianglePack& pack, const FilterRay& ray)
{
    const PackLanes d;
    const auto slope_x = hn::Set(d, ray.slope_x), slope_y = hn::Set(d, ray.slope_y);
    const auto start_x = hn::Set(d, ray.start_x), start_y = hn::Set(d, ray.start_y);
    const auto per_edge = hn::Set(d, ray.error_per_edge), least_error = hn::Set(d, ray.error);
    const auto forward = hn::Set(d, ray.forward), near_end = hn::Set(d, ray.near_end),
               far_end = hn::Set(d, ray.far_end), near_margin = hn::Set(d, ray.near_margin),
               far_margin = hn::Set(d, ray.far_margin);
    const auto depth_error = hn::Set(d, ray.depth_error), depth_per_edge = hn::Set(d, ray.depth_error_per_edge);
    const bool up = ray.forward > 0.0f;
    const auto first = hn::Set(d, up ? ray.near_end : -ray.far_end),
               last = hn::Set(d, up ? ray.far_end : -ray.near_end);
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += static_cast<int>(hn::Lanes(d))) {
        const auto along = [&](int corner, int axis) HWY_ATTR { return hn::Load(d, pack.v[corner][axis] + lane); };
        const auto z0 = along(0, ray.z), z1 = along(1, ray.z), z2 = along(2, ray.z);
        const auto x0 = hn::Sub(hn::NegMulAdd(slope_x, z0, along(0, ray.x)), start_x);
        const auto y0 = hn::Sub(hn::NegMulAdd(slope_y, z0, along(0, ray.y)), start_y);
        const auto x1 = hn::Sub(hn::NegMulAdd(slope_x, z1, along(1, ray.x)), start_x);
        const auto y1 = hn::Sub(hn::NegMulAdd(slope_y, z1, along(1, ray.y)), start_y);
        const auto x2 = hn::Sub(hn::NegMulAdd(slope_x, z2, along(2, ray.x)), start_x);
        const auto y2 = hn::Sub(hn::NegMulAdd(slope_y, z2, along(2, ray.y)), start_y);
        const auto u = hn::NegMulAdd(x2, y1, hn::Mul(x1, y2));
        const auto v = hn::NegMulAdd(x0, y2, hn::Mul(x2, y0));
        const auto w = hn::NegMulAdd(x1, y0, hn::Mul(x0, y1));
        const auto least = hn::Min(hn::Min(u, v), w), most = hn::Max(hn::Max(u, v), w);
        const auto error = hn::MulAdd(per_edge, hn::Load(d, pack.edge + lane), least_error);
        // Most of what the line meets lies behind the ray's origin or beyond its end: first by the corners' depths ...
        const auto low = hn::Min(hn::Min(z0, z1), z2), high = hn::Max(hn::Max(z0, z1), z2);
        const auto wide = hn::MulAdd(depth_per_edge, hn::Load(d, pack.edge + lane), depth_error);
        const auto between = hn::And(hn::Le(low, hn::Add(last, wide)), hn::Ge(high, hn::Sub(first, wide)));
        const auto maybe = hn::And(between, hn::Or(hn::Ge(least, hn::Neg(error)), hn::Le(most, error)));
        if (hn::AllFalse(d, maybe)) continue;
        // ... then by the depth of the hit, times the sum of the sides.
        const auto sum = hn::Add(hn::Add(u, v), w), size = hn::Abs(sum);
        const auto turn = hn::Xor(hn::And(sum, hn::SignBit(d)), hn::And(forward, hn::SignBit(d)));
        const auto depth = hn::Xor(hn::MulAdd(u, z0, hn::MulAdd(v, z1, hn::Mul(w, z2))), turn);
        const auto too_far = hn::Gt(depth, hn::MulAdd(far_end, size, hn::Mul(far_margin, error)));
        const auto too_near = hn::Lt(depth, hn::NegMulAdd(near_margin, error, hn::Mul(near_end, size)));
        found |= bits_of(d, hn::AndNot(hn::Or(too_far, too_near), maybe)) << lane;
    }
    return found;
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
            const bool up = ray.inverse[axis] > 0.0f;
            const auto inverse = hn::Set(d, ray.inverse[axis]);
            const auto shift = hn::Set(d, -ray.origin[axis] * ray.inverse[axis]);
            const auto near = hn::Load(d, (up ? boxes.lo : boxes.hi)[axis] + lane);
            const auto far = hn::Load(d, (up ? boxes.hi : boxes.lo)[axis] + lane);
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
