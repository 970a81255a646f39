// Wide kernel: many rays against one triangle. Included once per instruction set.
#if defined(FIRSTRAY_RAY_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_RAY_KERNELS_INL_H_
#undef FIRSTRAY_RAY_KERNELS_INL_H_
#else
#define FIRSTRAY_RAY_KERNELS_INL_H_
#endif

#include <hwy/highway.h>

#include "engine/core/search_ray.h"
#include "engine/primitive/triangle.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rays side by side, `count` of them and room for a whole number of blocks.
template <typename Real>
struct RayLanes {
    static constexpr int block = 16;
    alignas(64) typename RayTile<Real>::Lane origin[3], direction[3];
    alignas(64) typename RayTile<Real>::Lane length;  ///< largest component of the direction in magnitude
    int count = 0;
};

/// The lanes, of the sixteen from `first`, that do not certainly pass the triangle: those whose sides, as triangle.h
/// defines them, do not certainly differ. exact_signs: count what float cannot tell as "not certainly".
template <typename Real>
HWY_INLINE std::uint32_t not_passing(const RootTriangle<Real>& triangle, const RayLanes<Real>& rays, int first,
                                     bool exact_signs)
{
    const hn::CappedTag<Real, 16> d;
    using V = hn::Vec<decltype(d)>;
    struct Vec3 {
        V x, y, z;
    };
    const auto sub = [](const Vec3& a, const Vec3& b) HWY_ATTR {
        return Vec3{hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
    };
    const auto add = [](const Vec3& a, const Vec3& b) HWY_ATTR {
        return Vec3{hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
    };
    const auto minor = [](V a, V b, V e, V f) HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(e, f)); };
    const auto cross = [&](const Vec3& a, const Vec3& b) HWY_ATTR {
        return Vec3{minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
    };
    const auto dot = [](const Vec3& a, const Vec3& b)
                         HWY_ATTR { return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z)); };
    const auto set = [&](const auto& v) HWY_ATTR { return Vec3{hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)}; };

    const Vec3 v0 = set(triangle.v[0]), v1 = set(triangle.v[1]), v2 = set(triangle.v[2]);
    const Vec3 e0 = sub(v2, v1), e1 = sub(v0, v2), e2 = sub(v1, v0);
    std::uint32_t found = 0;
    for (int lane = 0; lane < 16; lane += static_cast<int>(hn::Lanes(d))) {
        const auto load = [&](const typename RayTile<Real>::Lane(&lanes)[3]) HWY_ATTR {
            return Vec3{hn::Load(d, lanes[0].data() + first + lane), hn::Load(d, lanes[1].data() + first + lane),
                        hn::Load(d, lanes[2].data() + first + lane)};
        };
        const Vec3 origin = load(rays.origin), direction = load(rays.direction);
        const Vec3 a0 = sub(v0, origin), a1 = sub(v1, origin), a2 = sub(v2, origin);
        const V u = dot(cross(e0, add(a1, a2)), direction), v = dot(cross(e1, add(a2, a0)), direction),
                w = dot(cross(e2, add(a0, a1)), direction);
        const V least = hn::Min(hn::Min(u, v), w), most = hn::Max(hn::Max(u, v), w);
        V error = hn::Zero(d);
        if (exact_signs) {
            const V distance =
                hn::Add(hn::Max(hn::Max(hn::Abs(a0.x), hn::Abs(a0.y)), hn::Abs(a0.z)), hn::Set(d, triangle.edge));
            const V length = hn::Load(d, rays.length.data() + first + lane);
            error =
                hn::MulAdd(hn::Set(d, side_error<Real>), hn::Mul(hn::Mul(hn::Set(d, triangle.edge), distance), length),
                           hn::Set(d, least_bound<Real>));
        }
        // Written so that a NaN (overflow) is not certain either.
        const auto passing = hn::And(hn::Lt(least, hn::Neg(error)), hn::Gt(most, error));
        alignas(8) std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, hn::Not(passing), bytes);
        std::uint32_t bits;
        __builtin_memcpy(&bits, bytes, sizeof bits);
        found |= (bits & ((2u << (hn::Lanes(d) - 1)) - 1)) << lane;
    }
    return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
