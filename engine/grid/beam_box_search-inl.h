// How a beam finds its way through a grid in whose voxels boxes stand. Included once per instruction set.
#if defined(FIRSTRAY_BEAM_BOX_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_BOX_SEARCH_INL_H_
#undef FIRSTRAY_BEAM_BOX_SEARCH_INL_H_
#else
#define FIRSTRAY_BEAM_BOX_SEARCH_INL_H_
#endif

#include "engine/grid/beam_search-inl.h"
#include "engine/grid/box_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// Cuts a range of depths with the slab between -1 and 1, for lanes that start at a place and go on by `least` to
/// `most` per depth: what is left are the depths at which they may be in it.
template <class V>
HWY_INLINE void cut_to_slab(V start, V least, V most, V& enter, V& leave)
{
    const PackLanes d;
    const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), tiny = hn::Set(d, 1e-30f);
    const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
    const auto below = hn::Div(hn::Sub(one, start), hn::IfThenElse(hn::Lt(hn::Abs(least), tiny), tiny, least));
    const auto above =
        hn::Div(hn::Sub(hn::Neg(one), start), hn::IfThenElse(hn::Lt(hn::Abs(most), tiny), hn::Neg(tiny), most));
    const auto falls = hn::Lt(least, hn::Neg(tiny)), rises = hn::Gt(most, tiny);
    enter = hn::Max(enter, hn::Max(hn::IfThenElse(falls, below, zero), hn::IfThenElse(rises, above, zero)));
    leave = hn::Min(leave, hn::Min(hn::IfThenElse(falls, infinite, below), hn::IfThenElse(rises, infinite, above)));
}

/// The oriented boxes that any packet of a beam in the root system may meet before it ends.
HWY_INLINE std::uint32_t boxes_meeting(const BoxPack& pack, const Beam& root)
{
    const PackLanes d;
    auto farthest = hn::Set(d, -std::numeric_limits<float>::infinity());
    for (int first = 0; first < root.count; first += kernel_lanes)
        farthest = hn::Max(farthest, hn::Load(d, root.reach + first));
    const auto reach = hn::MaxOfLanes(d, farthest);
    const auto lo_u = hn::Set(d, root.lo[0]), hi_u = hn::Set(d, root.hi[0]);
    const auto lo_v = hn::Set(d, root.lo[1]), hi_v = hn::Set(d, root.hi[1]);
    const auto apex_u = hn::Set(d, root.apex[0]), apex_v = hn::Set(d, root.apex[1]), apex_k = hn::Set(d, root.apex[2]);
    const auto forward = hn::Set(d, root.forward);
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += kernel_lanes) {
        auto enter = hn::Zero(d), leave = reach;
        for (int i = 0; i < 3; ++i) {
            const auto u = hn::Load(d, pack.row[i][root.u] + lane), v = hn::Load(d, pack.row[i][root.v] + lane),
                       along = hn::Load(d, pack.row[i][root.k] + lane), k = hn::Mul(along, forward);
            const auto start = hn::MulAdd(
                u, apex_u, hn::MulAdd(v, apex_v, hn::MulAdd(along, apex_k, hn::Load(d, pack.offset[i] + lane))));
            const auto at_lo_u = hn::Mul(u, lo_u), at_hi_u = hn::Mul(u, hi_u);
            const auto at_lo_v = hn::Mul(v, lo_v), at_hi_v = hn::Mul(v, hi_v);
            const auto least = hn::Add(hn::Min(at_lo_u, at_hi_u), hn::Add(hn::Min(at_lo_v, at_hi_v), k));
            const auto most = hn::Add(hn::Max(at_lo_u, at_hi_u), hn::Add(hn::Max(at_lo_v, at_hi_v), k));
            cut_to_slab(start, least, most, enter, leave);
        }
        found |= bits_of(d, hn::Le(enter, leave)) << lane;
    }
    return found;
}

/// The packets of a beam in the root system that may have a ray in an oriented box before it ends.
HWY_INLINE PacketMask packets_meeting(const Beam& root, const BoxPack& pack, int lane, PacketMask asked)
{
    const PackLanes d;
    float start[3], per_u[3], per_v[3], per_depth[3];  // of a place in the cube, by row
    for (int i = 0; i < 3; ++i) {
        per_u[i] = pack.row[i][root.u][lane];
        per_v[i] = pack.row[i][root.v][lane];
        per_depth[i] = pack.row[i][root.k][lane] * root.forward;
        start[i] = pack.offset[i][lane] + per_u[i] * root.apex[0] + per_v[i] * root.apex[1] +
                   pack.row[i][root.k][lane] * root.apex[2];
    }
    return packets_where(root.count, asked, [&](int first) HWY_ATTR {
        auto enter = hn::Zero(d), leave = hn::Load(d, root.reach + first);
        for (int i = 0; i < 3; ++i) {
            const auto u = hn::Set(d, per_u[i]), v = hn::Set(d, per_v[i]), k = hn::Set(d, per_depth[i]);
            const float* const lo_u = per_u[i] > 0.0f ? root.lo_u : root.hi_u;
            const float* const hi_u = per_u[i] > 0.0f ? root.hi_u : root.lo_u;
            const float* const lo_v = per_v[i] > 0.0f ? root.lo_v : root.hi_v;
            const float* const hi_v = per_v[i] > 0.0f ? root.hi_v : root.lo_v;
            const auto least = hn::MulAdd(u, hn::Load(d, lo_u + first), hn::MulAdd(v, hn::Load(d, lo_v + first), k));
            const auto most = hn::MulAdd(u, hn::Load(d, hi_u + first), hn::MulAdd(v, hn::Load(d, hi_v + first), k));
            cut_to_slab(hn::Set(d, start[i]), least, most, enter, leave);
        }
        return hn::Le(enter, leave);
    });
}

/// A beam among the boxes of a boxed grid, and among the primitives that stand between them: BoxSearch for beams.
/// World  `supergrid(number)`, and `enter_beam(number, quest, packets)` sends packets into an item
template <class Quest, class Among, class Own, class World>
class BeamBoxSearch {
public:
    BeamBoxSearch(Quest& quest, const World& world, Visits& visits, Among& among, const Own& own)
        : quest_(quest), world_(world), visits_(visits), among_(among), own_(own)
    {
    }

    /// grid  its structure is what `among` searches
    void run(const BoxedGrid& grid)
    {
        among_.begin();
        among_.list(grid.structure.large, quest_.root.packets);
        walk(grid, quest_.root.packets);
    }

    // What the walk asks for.
    template <class Voxel, class Resolver>
    HWY_INLINE void visit(const Voxel& voxel, PacketMask packets, const Resolver& resolve)
    {
        if (HWY_UNLIKELY(voxel.boxed != nullptr)) boxes(*voxel.boxed, packs_);
        if (voxel.has_own) among_.visit(voxel.own, packets, resolve.own());
    }

private:
    HWY_NOINLINE void walk(const BoxedGrid& grid, PacketMask packets)
    {
        const BoxPack* const around = std::exchange(packs_, grid.packs.data());
        walk_slices(grid.structure.grids[0], quest_.root, packets, among_.wide, BoxedResolver<Own>(grid, own_), *this);
        packs_ = around;
    }

    /// Sends all packets that meet them into the boxes of a voxel, each box once.
    HWY_NOINLINE void boxes(const BoxedVoxel& voxel, const BoxPack* packs)
    {
        for (std::uint32_t p = 0; p < voxel.packs; ++p) {
            const BoxPack& pack = packs[voxel.first_pack + p];
            for (std::uint32_t met = boxes_meeting(pack, quest_.root); met != 0; met &= met - 1) {
                const int lane = __builtin_ctz(met);
                const std::uint32_t number = pack.item[lane];
                if (!visits_.is_first(number)) continue;
                const PacketMask inside = packets_meeting(quest_.root, pack, lane, quest_.root.packets);
                if (inside == 0) continue;
                if (const BoxedGrid* inner = world_.supergrid(number))
                    walk(*inner, inside);
                else
                    world_.enter_beam(number, quest_, inside);
            }
        }
    }

    Quest& quest_;
    const World& world_;
    Visits& visits_;
    Among& among_;
    Own own_;
    const BoxPack* packs_ = nullptr;  ///< of the grid that is walked through
};

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
