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

/// The packets of a beam in the root system that may have a ray in an oriented box before it ends.
HWY_INLINE PacketMask packets_meeting(const Beam& root, const BoxPack& pack, int lane, PacketMask asked)
{
    const PackLanes d;
    const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), tiny = hn::Set(d, 1e-30f);
    const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
    float start[3], per_u[3], per_v[3], per_depth[3];  // of a place in the cube, by row
    for (int i = 0; i < 3; ++i) {
        per_u[i] = pack.row[i][root.u][lane];
        per_v[i] = pack.row[i][root.v][lane];
        per_depth[i] = pack.row[i][root.k][lane] * root.forward;
        start[i] = pack.offset[i][lane] + per_u[i] * root.apex[0] + per_v[i] * root.apex[1] +
                   pack.row[i][root.k][lane] * root.apex[2];
    }
    return packets_where(root.count, asked, [&](int first) HWY_ATTR {
        auto enter = zero, leave = hn::Load(d, root.reach + first);
        for (int i = 0; i < 3; ++i) {
            const auto u = hn::Set(d, per_u[i]), v = hn::Set(d, per_v[i]), k = hn::Set(d, per_depth[i]);
            const float* const lo_u = per_u[i] > 0.0f ? root.lo_u : root.hi_u;
            const float* const hi_u = per_u[i] > 0.0f ? root.hi_u : root.lo_u;
            const float* const lo_v = per_v[i] > 0.0f ? root.lo_v : root.hi_v;
            const float* const hi_v = per_v[i] > 0.0f ? root.hi_v : root.lo_v;
            const auto least = hn::MulAdd(u, hn::Load(d, lo_u + first), hn::MulAdd(v, hn::Load(d, lo_v + first), k));
            const auto most = hn::MulAdd(u, hn::Load(d, hi_u + first), hn::MulAdd(v, hn::Load(d, hi_v + first), k));
            // In the slab where start + depth * least <= 1 and start + depth * most >= -1.
            const auto at = hn::Set(d, start[i]);
            const auto below = hn::Div(hn::Sub(one, at), hn::IfThenElse(hn::Lt(hn::Abs(least), tiny), tiny, least));
            const auto above =
                hn::Div(hn::Sub(hn::Neg(one), at), hn::IfThenElse(hn::Lt(hn::Abs(most), tiny), hn::Neg(tiny), most));
            const auto falls = hn::Lt(least, hn::Neg(tiny)), rises = hn::Gt(most, tiny);
            enter = hn::Max(enter, hn::Max(hn::IfThenElse(falls, below, zero), hn::IfThenElse(rises, above, zero)));
            leave =
                hn::Min(leave, hn::Min(hn::IfThenElse(falls, infinite, below), hn::IfThenElse(rises, infinite, above)));
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
        if (HWY_UNLIKELY(voxel.boxed != nullptr)) boxes(*voxel.boxed, packs_, packets);
        if (voxel.has_own) among_.visit(voxel.own, packets, resolve.own());
    }

private:
    HWY_NOINLINE void walk(const BoxedGrid& grid, PacketMask packets)
    {
        const BoxPack* const around = std::exchange(packs_, grid.packs.data());
        walk_slices(grid.structure.grids[0], quest_.root, packets, among_.wide, BoxedResolver<Own>(grid, own_), *this);
        packs_ = around;
    }

    /// Sends all packets that meet them into the boxes of a voxel that the beam was not in before.
    HWY_NOINLINE void boxes(const BoxedVoxel& voxel, const BoxPack* packs, PacketMask here)
    {
        for (std::uint32_t p = 0; p < voxel.packs; ++p) {
            const BoxPack& pack = packs[voxel.first_pack + p];
            for (int lane = 0; lane < pack_size && pack.item[lane] != none; ++lane) {
                const std::uint32_t number = pack.item[lane];
                if (visits_.was_visited(number)) continue;
                if (packets_meeting(quest_.root, pack, lane, here) == 0) continue;
                visits_.is_first(number);
                const PacketMask inside = packets_meeting(quest_.root, pack, lane, quest_.root.packets);
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
