// Wide kernels of beams: packets side by side against a box or a triangle, sixteen boxes or triangles against a beam.
// Included once per instruction set; what they return does not depend on it.
#if defined(FIRSTRAY_BEAM_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_KERNELS_INL_H_
#undef FIRSTRAY_BEAM_KERNELS_INL_H_
#else
#define FIRSTRAY_BEAM_KERNELS_INL_H_
#endif

#include "engine/grid/beam.h"
#include "engine/primitive/intersect-inl.h"
#include "engine/primitive/pack_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kernel_lanes = static_cast<int>(hn::MaxLanes(PackLanes()));

/// The packets among those asked for, all below `count`, for which `test(first)` says so; it is asked of a register of
/// packets at a time.
template <class Test>
HWY_INLINE PacketMask packets_where(int count, PacketMask asked, const Test& test)
{
    const PackLanes d;
    PacketMask found = 0;
    for (int first = 0; first < count; first += kernel_lanes) {
        if (((asked >> first) & ((PacketMask{1} << kernel_lanes) - 1)) == 0) continue;
        found |= PacketMask{bits_of(d, test(first))} << first;
    }
    return found & asked;
}

/// A box along the axes u, v, k of a beam, relative to its apex, k as depth; widened for the beam's rounding.
struct BeamBox {
    float lo_u, hi_u, lo_v, hi_v, near, far;
};

/// lo, hi  corners in the structure's system
/// wide    by how much it is widened
HWY_INLINE BeamBox beam_box(const Beam& beam, const glm::vec3& lo, const glm::vec3& hi, float wide)
{
    const float a = beam.forward * (lo[beam.k] - beam.apex[2]), b = beam.forward * (hi[beam.k] - beam.apex[2]);
    return {lo[beam.u] - beam.apex[0] - wide, hi[beam.u] - beam.apex[0] + wide,      lo[beam.v] - beam.apex[1] - wide,
            hi[beam.v] - beam.apex[1] + wide, std::max(std::min(a, b) - wide, 0.0f), std::max(a, b) + wide};
}

/// Packets that may have a ray in the box before it ends.
HWY_INLINE PacketMask packets_meeting(const Beam& beam, const BeamBox& box, PacketMask asked)
{
    if (box.far < 0.0f) return 0;
    const PackLanes d;
    const auto near = hn::Set(d, box.near), far = hn::Set(d, box.far);
    return packets_where(beam.count, asked, [&](int first) HWY_ATTR {
        const auto lo_u = hn::Load(d, beam.lo_u + first), hi_u = hn::Load(d, beam.hi_u + first);
        const auto lo_v = hn::Load(d, beam.lo_v + first), hi_v = hn::Load(d, beam.hi_v + first);
        const auto apart =
            hn::Or(hn::Or(hn::Gt(hn::Min(hn::Mul(lo_u, near), hn::Mul(lo_u, far)), hn::Set(d, box.hi_u)),
                          hn::Lt(hn::Max(hn::Mul(hi_u, near), hn::Mul(hi_u, far)), hn::Set(d, box.lo_u))),
                   hn::Or(hn::Gt(hn::Min(hn::Mul(lo_v, near), hn::Mul(lo_v, far)), hn::Set(d, box.hi_v)),
                          hn::Lt(hn::Max(hn::Mul(hi_v, near), hn::Mul(hi_v, far)), hn::Set(d, box.lo_v))));
        return hn::AndNot(apart, hn::Ge(hn::Load(d, beam.reach + first), near));
    });
}

/// Which boxes of a block any ray of the beam may meet.
HWY_INLINE std::uint32_t boxes_meeting(const PackBoxes& boxes, const Beam& beam, float wide)
{
    const PackLanes d;
    const bool up = beam.forward > 0.0f;
    const auto forward = hn::Set(d, beam.forward), widen = hn::Set(d, wide), zero = hn::Zero(d);
    const auto apex_k = hn::Set(d, beam.apex[2]);
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += kernel_lanes) {
        const auto depth = [&](const float* side)
                               HWY_ATTR { return hn::Mul(forward, hn::Sub(hn::Load(d, side + lane), apex_k)); };
        const auto near = hn::Max(hn::Sub(depth(boxes.side[up ? 0 : 1][beam.k]), widen), zero),
                   far = hn::Add(depth(boxes.side[up ? 1 : 0][beam.k]), widen);
        auto met = hn::Ge(far, zero);
        for (int side = 0; side < 2; ++side) {
            const int axis = side == 0 ? beam.u : beam.v;
            const auto shift = hn::Set(d, beam.apex[side]), lo = hn::Set(d, beam.lo[side]),
                       hi = hn::Set(d, beam.hi[side]);
            const auto box_lo = hn::Sub(hn::Sub(hn::Load(d, boxes.side[0][axis] + lane), shift), widen),
                       box_hi = hn::Add(hn::Sub(hn::Load(d, boxes.side[1][axis] + lane), shift), widen);
            met = hn::And(met, hn::Le(hn::Min(hn::Mul(lo, near), hn::Mul(lo, far)), box_hi));
            met = hn::And(met, hn::Ge(hn::Max(hn::Mul(hi, near), hn::Mul(hi, far)), box_lo));
        }
        found |= bits_of(d, met) << lane;
    }
    return found;
}

/// A rectangle of slopes: by axis u, v.
struct SlopeBounds {
    float lo[2], hi[2];
};

/// Around the slopes of some packets.
HWY_INLINE SlopeBounds bounds_of(const Beam& beam, PacketMask packets)
{
    constexpr int few = max_packets / 4;  // more: they are mostly all over the beam
    if (__builtin_popcountll(packets) > few) return {{beam.lo[0], beam.lo[1]}, {beam.hi[0], beam.hi[1]}};
    const float infinite = std::numeric_limits<float>::infinity();
    SlopeBounds bounds{{infinite, infinite}, {-infinite, -infinite}};
    for (; packets != 0; packets &= packets - 1) {
        const int packet = __builtin_ctzll(packets);
        bounds.lo[0] = std::min(bounds.lo[0], beam.lo_u[packet]);
        bounds.hi[0] = std::max(bounds.hi[0], beam.hi_u[packet]);
        bounds.lo[1] = std::min(bounds.lo[1], beam.lo_v[packet]);
        bounds.hi[1] = std::max(bounds.hi[1], beam.hi_v[packet]);
    }
    return bounds;
}

/// Sixteen triangles as all rays from one apex see them: what triangle.h computes before the direction comes in, and
/// the same bits, but that sides have the sign that makes them positive where a ray may meet the triangle. (Exchanging
/// all three signs changes no bit of what a test gives.)
struct BeamTriangles {
    alignas(64) float side[3][3][pack_size];  ///< edge, axis, lane: its dot product with a direction is the side
    alignas(64) float normal[3][pack_size];
    alignas(64) float height[pack_size], span[pack_size], distance[pack_size];
    alignas(64) float error[pack_size];  ///< bound on the error of a side, for a direction of unit depth
    alignas(64) float near[pack_size];   ///< least depth
};

/// bounds  of the slopes of the rays that matter
/// blur    how far a corner that the test sees may be from its place in the pack, per coordinate
/// loose   see make_filter_ray
/// Returns the lanes that a ray with such slopes may meet.
HWY_INLINE std::uint32_t make_beam_triangles(const TrianglePack& pack, const Beam& beam, const SlopeBounds& bounds,
                                             float wide, float blur, float loose, BeamTriangles& out)
{
    const PackLanes d;
    const hn::RebindToUnsigned<PackLanes> du;
    using V = hn::Vec<PackLanes>;
    float apex[3];
    apex[beam.u] = beam.apex[0];
    apex[beam.v] = beam.apex[1];
    apex[beam.k] = beam.apex[2];
    const float off = 2.0f * blur;
    const auto per_edge = hn::Set(d, 24.0f * off), least_error = hn::Set(d, 4.0f * off * off + least_bound<float>);
    const auto per_size = hn::Set(d, (2.0f + loose) * side_error<float> * beam.steepest);
    const auto forward = hn::Set(d, beam.forward), widen = hn::Set(d, wide), zero = hn::Zero(d);
    const auto cross = [](const V(&p)[3], const V(&q)[3], V(&result)[3]) HWY_ATTR {
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            result[i] = hn::Sub(hn::Mul(p[j], q[k]), hn::Mul(p[k], q[j]));
        }
    };
    const auto largest = [](const V(&p)[3])
                             HWY_ATTR { return hn::Max(hn::Max(hn::Abs(p[0]), hn::Abs(p[1])), hn::Abs(p[2])); };
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += kernel_lanes) {
        V v[3][3], a[3][3], e[3][3];  // corner or edge, axis
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                v[corner][axis] = hn::Load(d, pack.v[corner][axis] + lane);
                a[corner][axis] = hn::Sub(v[corner][axis], hn::Set(d, apex[axis]));
            }
        const V z0 = hn::Mul(a[0][beam.k], forward), z1 = hn::Mul(a[1][beam.k], forward),
                z2 = hn::Mul(a[2][beam.k], forward);
        const V near = hn::Sub(hn::Min(hn::Min(z0, z1), z2), widen), far = hn::Add(hn::Max(hn::Max(z0, z1), z2), widen);
        const V edge = hn::Load(d, pack.edge + lane), distance = hn::Add(largest(a[0]), edge);
        V error = hn::MulAdd(per_size, hn::Mul(edge, distance), hn::MulAdd(per_edge, edge, least_error));

        V n[3][3];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            V sum[3];
            for (int axis = 0; axis < 3; ++axis) {
                e[i][axis] = hn::Sub(v[k][axis], v[j][axis]);
                sum[axis] = hn::Add(a[j][axis], a[k][axis]);
            }
            cross(e[i], sum, n[i]);
        }

        // The volume between the apex and the triangle has the sign that the sides of a hit have. Seen edge-on, both
        // signs may occur: nothing is certain then, nor where it overflows.
        const V volume = hn::MulAdd(n[0][0], a[0][0], hn::MulAdd(n[0][1], a[0][1], hn::Mul(n[0][2], a[0][2])));
        const V doubt = hn::Mul(hn::Set(d, 4.0f), hn::Mul(error, distance));
        const V infinite = hn::Set(d, std::numeric_limits<float>::infinity()), size = hn::Abs(volume);
        error = hn::IfThenElse(hn::And(hn::Gt(size, doubt), hn::Lt(size, infinite)), error, infinite);
        const V flip = hn::And(volume, hn::SignBit(d));
        auto apart = hn::Lt(far, zero);
        for (int i = 0; i < 3; ++i) {
            for (int axis = 0; axis < 3; ++axis) n[i][axis] = hn::Xor(n[i][axis], flip);
            const auto most_along = [&](const V& factor, int side) HWY_ATTR {
                return hn::Max(hn::Mul(factor, hn::Set(d, bounds.lo[side])),
                               hn::Mul(factor, hn::Set(d, bounds.hi[side])));
            };
            const V most = hn::Add(hn::Add(most_along(n[i][beam.u], 0), most_along(n[i][beam.v], 1)),
                                   hn::Mul(n[i][beam.k], forward));
            apart = hn::Or(apart, hn::Lt(hn::Add(most, error), zero));
        }
        const std::uint32_t met = bits_of(d, hn::AndNot(apart, hn::Eq(edge, edge)));
        if (met == 0) continue;
        found |= met << lane;

        const V unit = hn::BitCast(
            d, hn::Sub(hn::Set(du, 254u << 23), hn::And(hn::BitCast(du, edge), hn::Set(du, 255u << 23))));  // edge_unit
        for (int i = 1; i < 3; ++i)
            for (int axis = 0; axis < 3; ++axis) e[i][axis] = hn::Mul(e[i][axis], unit);
        V normal[3];
        cross(e[1], e[2], normal);
        const V height =
            hn::Add(hn::Add(hn::Mul(normal[0], a[0][0]), hn::Mul(normal[1], a[0][1])), hn::Mul(normal[2], a[0][2]));
        for (int i = 0; i < 3; ++i)
            for (int axis = 0; axis < 3; ++axis) hn::Store(n[i][axis], d, out.side[i][axis] + lane);
        for (int axis = 0; axis < 3; ++axis) hn::Store(normal[axis], d, out.normal[axis] + lane);
        hn::Store(height, d, out.height + lane);
        hn::Store(hn::Mul(largest(e[1]), largest(e[2])), d, out.span + lane);
        hn::Store(distance, d, out.distance + lane);
        hn::Store(error, d, out.error + lane);
        hn::Store(near, d, out.near + lane);
    }
    return found;
}

/// Packets that may have a ray that meets a triangle before it ends.
HWY_INLINE PacketMask packets_meeting(const Beam& beam, const BeamTriangles& triangles, int lane, PacketMask asked)
{
    const PackLanes d;
    const float* u_at[3];
    const float* v_at[3];
    hn::Vec<PackLanes> n[3][3];  // edge; per u, per v, for no slope
    for (int e = 0; e < 3; ++e) {
        const float u = triangles.side[e][beam.u][lane], v = triangles.side[e][beam.v][lane];
        u_at[e] = u > 0.0f ? beam.hi_u : beam.lo_u;
        v_at[e] = v > 0.0f ? beam.hi_v : beam.lo_v;
        n[e][0] = hn::Set(d, u);
        n[e][1] = hn::Set(d, v);
        n[e][2] = hn::Set(d, triangles.side[e][beam.k][lane] * beam.forward);
    }
    const auto error = hn::Set(d, -triangles.error[lane]), near = hn::Set(d, triangles.near[lane]);
    return packets_where(beam.count, asked, [&](int first) HWY_ATTR {
        auto apart = hn::Lt(hn::Load(d, beam.reach + first), near);
        for (int e = 0; e < 3; ++e) {
            const auto most = hn::MulAdd(n[e][0], hn::Load(d, u_at[e] + first),
                                         hn::MulAdd(n[e][1], hn::Load(d, v_at[e] + first), n[e][2]));
            apart = hn::Or(apart, hn::Lt(most, error));
        }
        return hn::Not(apart);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
