// A beam in another system. Included once per instruction set.
#if defined(FIRSTRAY_BEAM_TRANSFORM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_TRANSFORM_INL_H_
#undef FIRSTRAY_BEAM_TRANSFORM_INL_H_
#else
#define FIRSTRAY_BEAM_TRANSFORM_INL_H_
#endif

#include "engine/core/transform.h"
#include "engine/grid/beam_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// The packets asked for in another system; returns those of them that go along one axis there, and can walk. A
/// rectangle of slopes becomes the one around its corners.
/// local_from_root  of the other system; not singular
HWY_INLINE PacketMask transform(const Beam& root, PacketMask asked, const Transform& local_from_root, Beam& local)
{
    const PackLanes d;
    const int axes[3] = {root.u, root.v, root.k};
    float linear[3][3];  // column: per u, per v, per depth; row: x, y, z
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            linear[column][row] = static_cast<float>(local_from_root.linear[axes[column]][row]);
    for (float& x : linear[2]) x *= root.forward;

    glm::dvec3 apex(0.0);
    for (int i = 0; i < 3; ++i) apex[axes[i]] = static_cast<double>(root.apex[i]);
    const glm::vec3 local_apex(local_from_root.point(apex));
    const float middle_u = 0.5f * (root.lo[0] + root.hi[0]), middle_v = 0.5f * (root.lo[1] + root.hi[1]);
    glm::vec3 middle;
    for (int row = 0; row < 3; ++row)
        middle[row] = linear[0][row] * middle_u + linear[1][row] * middle_v + linear[2][row];
    const BeamAxes to = axes_of(middle);
    local.u = to.u;
    local.v = to.v;
    local.k = to.k;
    local.forward = to.forward;
    local.apex[0] = local_apex[to.u];
    local.apex[1] = local_apex[to.v];
    local.apex[2] = local_apex[to.k];
    local.farthest = largest_component<float>(local_apex);
    local.count = root.count;

    // A direction this much shorter along k than it might be has lost digits, or is too steep.
    float size = 0.0f;
    for (const auto& column : linear)
        for (const float x : column) size = std::max(size, std::abs(x));
    const auto shortest = hn::Set(d, size * 0x1p-6f), steepest = hn::Set(d, 0x1p-3f);
    const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
    const PacketMask straight = packets_where(root.count, asked, [&](int first) HWY_ATTR {
        auto lo_u = infinite, lo_v = infinite, hi_u = hn::Neg(infinite), hi_v = hi_u;
        auto scale = hn::Zero(d);
        auto good = hn::Ge(hn::Load(d, root.reach + first), scale);
        for (int corner = 0; corner < 4; ++corner) {
            const auto u = hn::Load(d, ((corner & 1) ? root.hi_u : root.lo_u) + first);
            const auto v = hn::Load(d, ((corner & 2) ? root.hi_v : root.lo_v) + first);
            const auto along = [&](int row) HWY_ATTR {
                return hn::MulAdd(hn::Set(d, linear[0][row]), u,
                                  hn::MulAdd(hn::Set(d, linear[1][row]), v, hn::Set(d, linear[2][row])));
            };
            const auto speed = hn::Mul(hn::Set(d, to.forward), along(to.k)), side_u = along(to.u), side_v = along(to.v);
            const auto least = hn::Max(shortest, hn::Mul(steepest, hn::Max(hn::Abs(side_u), hn::Abs(side_v))));
            good = hn::And(good, hn::Ge(speed, least));
            const auto inverse = hn::Div(hn::Set(d, 1.0f), speed);
            const auto slope_u = hn::Mul(side_u, inverse), slope_v = hn::Mul(side_v, inverse);
            lo_u = hn::Min(lo_u, slope_u);
            hi_u = hn::Max(hi_u, slope_u);
            lo_v = hn::Min(lo_v, slope_v);
            hi_v = hn::Max(hi_v, slope_v);
            scale = hn::Max(scale, speed);
        }
        scale = hn::Mul(scale, hn::Set(d, 1.0f + slope_pad));
        hn::Store(lo_u, d, local.lo_u + first);
        hn::Store(hi_u, d, local.hi_u + first);
        hn::Store(lo_v, d, local.lo_v + first);
        hn::Store(hi_v, d, local.hi_v + first);
        hn::Store(scale, d, local.scale + first);
        hn::Store(hn::IfThenElse(good, hn::Mul(hn::Load(d, root.reach + first), scale), hn::Neg(infinite)), d,
                  local.reach + first);
        return good;
    });
    // Registers of packets that nobody asked for stay behind.
    for (int first = 0; first < root.count; first += kernel_lanes)
        if (((asked >> first) & ((PacketMask{1} << kernel_lanes) - 1)) == 0)
            hn::Store(hn::Neg(infinite), d, local.reach + first);
    local.packets = straight;
    finish_beam(local);
    return straight;
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
