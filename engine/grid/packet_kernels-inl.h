// Wide kernels of packets: their sixteen rays against a triangle or a box. Included once per instruction set; what they
// return does not depend on it.
#if defined(FIRSTRAY_PACKET_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_PACKET_KERNELS_INL_H_
#undef FIRSTRAY_PACKET_KERNELS_INL_H_
#else
#define FIRSTRAY_PACKET_KERNELS_INL_H_
#endif

#include "engine/grid/beam_kernels-inl.h"
#include "engine/primitive/intersect-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// One triangle as BeamTriangles has sixteen.
struct ApexTriangle {
    glm::vec3 side[3];  ///< its dot product with a direction is the side u, v, w
    glm::vec3 normal;   ///< Ng, times the square of edge_unit(edge) as height and span are
    float height, span, distance, edge;
    bool has_volume;  ///< float's t can be trusted, as far as this goes
};

HWY_INLINE ApexTriangle take_apex_triangle(const BeamTriangles& triangles, const TrianglePack& pack, int lane)
{
    ApexTriangle p;
    for (int axis = 0; axis < 3; ++axis) {
        for (int e = 0; e < 3; ++e) p.side[e][axis] = triangles.side[e][axis][lane];
        p.normal[axis] = triangles.normal[axis][lane];
    }
    p.height = triangles.height[lane];
    p.span = triangles.span[lane];
    p.distance = triangles.distance[lane];
    p.edge = pack.edge[lane];
    p.has_volume = p.span * p.distance > least_bound<float>;
    return p;
}

/// A triangle's plane in double, for t where float's cannot be trusted.
struct ApexPlane {
    glm::dvec3 normal;  ///< Ng
    double height, span;
};

inline ApexPlane make_apex_plane(const RootTriangle<float>& t, const glm::vec3& apex)
{
    const glm::dvec3 v0(t.v[0]), e1 = v0 - glm::dvec3(t.v[2]), e2 = glm::dvec3(t.v[1]) - v0;
    ApexPlane p;
    p.normal = cross_as_written<double>(e1, e2);
    p.height = dot_as_written<double>(p.normal, v0 - glm::dvec3(apex));
    p.span = largest_component<double>(e1) * largest_component<double>(e2);
    return p;
}

/// A triangle's sides in double, for signs that float cannot tell.
struct ApexSides {
    glm::dvec3 side[3];  ///< its dot product with a direction is the side u, v, w
    double error;        ///< bound on the error of a side, for a direction of length 1
};

inline ApexSides make_apex_sides(const RootTriangle<float>& t, const glm::vec3& apex)
{
    const glm::dvec3 v0(t.v[0]), v1(t.v[1]), v2(t.v[2]), o(apex), a0 = v0 - o, a1 = v1 - o, a2 = v2 - o;
    const double edge = static_cast<double>(t.edge), distance = largest_component<double>(a0) + edge;
    return {{cross_as_written<double>(v2 - v1, a1 + a2), cross_as_written<double>(v0 - v2, a2 + a0),
             cross_as_written<double>(v1 - v0, a0 + a1)},
            side_error<double> * (edge * distance)};
}

/// What double says of a register of rays.
struct SidesInDouble {
    std::uint32_t inside = 0, outside = 0;  ///< lanes that certainly are
    alignas(64) float u[pack_size], v[pack_size];
};

/// passes_inside_exactly() of triangle.h, as far as double can tell, for a register of rays from `first` on.
HWY_INLINE void test_sides(const ApexSides& sides, const BeamRays& rays, int first, SidesInDouble& result)
{
    const hn::CappedTag<double, pack_size / 2> d;
    const hn::Rebind<float, decltype(d)> df;
    for (int i = 0; i < kernel_lanes; i += static_cast<int>(hn::Lanes(d))) {
        const auto load = [&](const BeamRays::Lane& from)
                              HWY_ATTR { return hn::PromoteTo(d, hn::Load(df, from.data() + first + i)); };
        const auto x = load(rays.direction[0]), y = load(rays.direction[1]), z = load(rays.direction[2]);
        const auto dot = [&](const glm::dvec3& n) HWY_ATTR {
            return hn::Add(hn::Add(hn::Mul(hn::Set(d, n.x), x), hn::Mul(hn::Set(d, n.y), y)),
                           hn::Mul(hn::Set(d, n.z), z));
        };
        const auto u = dot(sides.side[0]), v = dot(sides.side[1]), w = dot(sides.side[2]);
        const auto least = hn::Min(hn::Min(u, v), w), most = hn::Max(hn::Max(u, v), w);
        const auto error = hn::Mul(hn::Set(d, sides.error), load(rays.length));
        const auto is_bounded = hn::Ge(error, hn::Set(d, least_bound<double>));
        const auto above = hn::Gt(most, error), below = hn::Lt(least, hn::Neg(error));
        const auto inside = hn::Or(hn::Gt(least, error), hn::Lt(most, hn::Neg(error)));
        result.inside |= bits_of(d, hn::And(is_bounded, inside)) << i;
        result.outside |= bits_of(d, hn::And(is_bounded, hn::And(above, below))) << i;
        const auto sum = hn::Add(hn::Add(u, v), w);
        hn::Store(hn::DemoteTo(df, hn::Div(v, sum)), df, result.u + i);
        hn::Store(hn::DemoteTo(df, hn::Div(w, sum)), df, result.v + i);
    }
}

/// plane_t_in_double() of triangle.h for a register of rays from `first` on; not a number where that takes more.
HWY_INLINE hn::Vec<PackLanes> plane_ts(const ApexPlane& plane, const BeamRays& rays, int first)
{
    const hn::CappedTag<double, pack_size / 2> d;
    const hn::Rebind<float, decltype(d)> df;
    alignas(64) float ts[pack_size];
    for (int i = 0; i < kernel_lanes; i += static_cast<int>(hn::Lanes(d))) {
        const auto load = [&](const BeamRays::Lane& from)
                              HWY_ATTR { return hn::PromoteTo(d, hn::Load(df, from.data() + first + i)); };
        const auto part = [&](int axis)
                              HWY_ATTR { return hn::Mul(hn::Set(d, plane.normal[axis]), load(rays.direction[axis])); };
        const auto slope = hn::Add(hn::Add(part(0), part(1)), part(2));
        const auto least = hn::Mul(hn::Set(d, least_slope<double>), hn::Mul(hn::Set(d, plane.span), load(rays.length)));
        const auto t = hn::IfThenElse(hn::Gt(hn::Abs(slope), least), hn::Div(hn::Set(d, plane.height), slope),
                                      hn::Set(d, std::numeric_limits<double>::quiet_NaN()));
        hn::Store(hn::DemoteTo(df, t), df, ts + i);
    }
    return hn::Load(PackLanes(), ts);
}

/// What sixteen rays found.
struct PacketHits {
    std::uint32_t hits = 0;       ///< rays whose best hit this is now: written to the beam's rays
    std::uint32_t uncertain = 0;  ///< rays that only the test of single rays can decide
};

/// intersect() of triangle.h for the sixteen rays from `first` on, and taking the hit where it counts.
/// any_hit   that there is a hit is all that counts: t need not be exact where it is far enough from both ends
/// plane_of  `plane_of()` gives the triangle's ApexPlane
/// sides_of  `sides_of()` gives its ApexSides
template <bool any_hit, class PlaneOf, class SidesOf>
HWY_INLINE PacketHits test_packet(const ApexTriangle& p, PrimitiveId id, bool exact_signs, BeamRays& rays, int first,
                                  const PlaneOf& plane_of, const SidesOf& sides_of)
{
    const PackLanes d;
    const hn::RebindToUnsigned<PackLanes> du;
    using V = hn::Vec<PackLanes>;
    const auto set = [&](float x) HWY_ATTR { return hn::Set(d, x); };
    PacketHits result;
    for (int lane = first; lane < first + packet_size; lane += kernel_lanes) {
        const V x = hn::Load(d, rays.direction[0].data() + lane), y = hn::Load(d, rays.direction[1].data() + lane),
                z = hn::Load(d, rays.direction[2].data() + lane), length = hn::Load(d, rays.length.data() + lane);
        const V t_min = hn::Load(d, rays.t_min.data() + lane), t_last = hn::Load(d, rays.t.data() + lane);
        const auto dot = [&](const glm::vec3& n) HWY_ATTR {
            return hn::Add(hn::Add(hn::Mul(set(n.x), x), hn::Mul(set(n.y), y)), hn::Mul(set(n.z), z));
        };
        const V u = dot(p.side[0]), v = dot(p.side[1]), w = dot(p.side[2]);
        const V least = hn::Min(hn::Min(u, v), w), most = hn::Max(hn::Max(u, v), w);
        const V error = hn::Mul(set(side_error<float>), hn::Mul(set(p.edge * p.distance), length));
        const auto is_bounded = hn::Ge(error, set(least_bound<float>));
        const auto not_done = hn::Lt(t_min, t_last);
        auto maybe = not_done;
        if (exact_signs)
            maybe = hn::AndNot(hn::And(is_bounded, hn::And(hn::Lt(least, hn::Neg(error)), hn::Gt(most, error))), maybe);
        else
            maybe = hn::And(maybe, hn::Or(hn::Ge(least, set(0.0f)), hn::Le(most, set(0.0f))));
        if (hn::AllFalse(d, maybe)) continue;

        const V slope = dot(p.normal);
        V t = hn::Div(set(p.height), slope);
        const V t_size = hn::Abs(t);
        const auto is_sloped =
            p.has_volume ? hn::Gt(hn::Abs(slope), hn::Mul(set(least_slope<float>), hn::Mul(set(p.span), length)))
                         : hn::FirstN(d, 0);
        auto is_placed = hn::And(is_sloped, hn::Ge(hn::Mul(t_size, length), set(least_distance * p.distance)));
        const V per_length = hn::Load(d, rays.inverse_length.data() + lane);
        const V t_error = hn::Mul(set(quotient_error), hn::Add(t_size, hn::Mul(set(p.distance), per_length)));
        const auto is_outside = hn::Or(hn::Lt(hn::Add(t, t_error), t_min), hn::Gt(hn::Sub(t, t_error), t_last));
        if (any_hit)
            is_placed = hn::Or(is_placed, hn::And(is_sloped, hn::And(hn::Gt(hn::Sub(t, t_error), t_min),
                                                                     hn::Lt(hn::Add(t, t_error), t_last))));
        maybe = hn::AndNot(hn::And(hn::AndNot(is_placed, is_sloped), is_outside), maybe);
        if (const auto is_doubtful = hn::AndNot(is_placed, maybe); !hn::AllFalse(d, is_doubtful)) {
            t = hn::IfThenElse(is_doubtful, plane_ts(plane_of(), rays, lane), t);
            is_placed = hn::Or(is_placed, hn::And(is_doubtful, hn::Eq(t, t)));
        }
        const auto in_range = hn::And(hn::Gt(t, t_min), hn::Le(t, t_last));
        maybe = hn::AndNot(hn::And(is_placed, hn::Not(in_range)), maybe);
        if (hn::AllFalse(d, maybe)) continue;

        const auto is_certain = exact_signs
                                    ? hn::And(is_bounded, hn::Or(hn::Gt(least, error), hn::Lt(most, hn::Neg(error))))
                                    : (is_fast_enough(p.span, p.edge, p.distance) ? is_sloped : hn::FirstN(d, 0));
        auto hit = hn::And(maybe, hn::And(is_placed, is_certain));
        const V scale = hn::Div(set(1.0f), hn::Add(hn::Add(u, v), w));
        V hit_u = hn::Mul(v, scale), hit_v = hn::Mul(w, scale);
        if (const auto asked = hn::And(is_placed, hn::AndNot(hit, maybe)); exact_signs && !hn::AllFalse(d, asked)) {
            SidesInDouble sides;
            test_sides(sides_of(), rays, lane, sides);
            const auto inside = hn::And(asked, mask_of(d, sides.inside));
            hit = hn::Or(hit, inside);
            hit_u = hn::IfThenElse(inside, hn::Load(d, sides.u), hit_u);
            hit_v = hn::IfThenElse(inside, hn::Load(d, sides.v), hit_v);
            maybe = hn::AndNot(hn::And(asked, mask_of(d, sides.outside)), maybe);
        }
        result.uncertain |= bits_of(d, hn::AndNot(hit, maybe)) << (lane - first);

        const auto old_id = hn::Load(du, rays.id.data() + lane), new_id = hn::Set(du, id);
        const auto wins_tie =
            hn::RebindMask(d, hn::And(hn::Lt(new_id, old_id), hn::Ne(old_id, hn::Set(du, no_primitive))));
        const auto counts = hn::And(hit, hn::Or(hn::Lt(t, t_last), hn::And(hn::Eq(t, t_last), wins_tie)));
        const std::uint32_t bits = bits_of(d, counts);
        if (bits == 0) continue;
        result.hits |= bits << (lane - first);
        hn::BlendedStore(t, counts, d, rays.t.data() + lane);
        hn::BlendedStore(hit_u, counts, d, rays.u.data() + lane);
        hn::BlendedStore(hit_v, counts, d, rays.v.data() + lane);
        hn::BlendedStore(new_id, hn::RebindMask(du, counts), du, rays.id.data() + lane);
    }
    return result;
}

/// Whether any ray of the packets is in a box before it ends: what packets, which are wider than their rays, only may.
/// lo, hi  corners in the root system
/// wide    by how much the box is widened
HWY_INLINE bool any_ray_meets(const BeamRays& rays, PacketMask packets, const glm::vec3& lo, const glm::vec3& hi,
                              float wide)
{
    const PackLanes d;
    for (; packets != 0; packets &= packets - 1) {
        const int begin = __builtin_ctzll(packets) * packet_size;
        for (int lane = begin; lane < begin + packet_size; lane += kernel_lanes) {
            const auto end = hn::Load(d, rays.t.data() + lane);
            auto enter = hn::Load(d, rays.t_min.data() + lane), leave = hn::MulAdd(end, hn::Set(d, t_slack), end);
            for (int axis = 0; axis < 3; ++axis) {
                const auto inverse = hn::Div(hn::Set(d, 1.0f), hn::Load(d, rays.direction[axis].data() + lane));
                const auto a = hn::Mul(hn::Set(d, lo[axis] - wide - rays.apex[axis]), inverse),
                           b = hn::Mul(hn::Set(d, hi[axis] + wide - rays.apex[axis]), inverse);
                enter = hn::Max(enter, hn::Min(a, b));
                leave = hn::Min(leave, hn::Max(a, b));
            }
            if (!hn::AllFalse(d, hn::Le(enter, leave))) return true;
        }
    }
    return false;
}

/// The depth beyond which nothing can beat a packet's hits; minus infinity where all rays are done.
HWY_INLINE float reach_of(const BeamRays& rays, const Beam& root, int packet)
{
    const PackLanes d;
    const int axis = root.k;
    auto reach = hn::Set(d, -std::numeric_limits<float>::infinity());
    for (int lane = packet * packet_size; lane < (packet + 1) * packet_size; lane += kernel_lanes) {
        const auto speed = hn::Abs(hn::Load(d, rays.direction[axis].data() + lane));
        reach = hn::Max(reach, hn::Mul(speed, hn::Load(d, rays.t.data() + lane)));
    }
    const float farthest = hn::GetLane(hn::MaxOfLanes(d, reach));
    return farthest < 0.0f ? farthest : farthest + farthest * t_slack;
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
