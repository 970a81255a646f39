// How a ray finds its way through a grid in whose voxels boxes stand. Included once per instruction set.
#if defined(FIRSTRAY_BOX_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BOX_SEARCH_INL_H_
#undef FIRSTRAY_BOX_SEARCH_INL_H_
#else
#define FIRSTRAY_BOX_SEARCH_INL_H_
#endif

#include <utility>

#include "engine/grid/boxed_grid.h"
#include "engine/grid/search-inl.h"
#include "engine/grid/visits.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// Which oriented boxes of a pack the ray may meet between two walk ts; entries gets where it enters each.
HWY_INLINE std::uint32_t oriented_boxes_met(const BoxPack& pack, const WalkRay& ray, float t_begin, float t_end,
                                            float* HWY_RESTRICT entries)
{
    const PackLanes d;
    const auto one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-30f);
    std::uint32_t found = 0;
    for (int lane = 0; lane < pack_size; lane += static_cast<int>(hn::Lanes(d))) {
        auto enter = hn::Set(d, t_begin), leave = hn::Set(d, t_end);
        for (int i = 0; i < 3; ++i) {
            auto place = hn::Load(d, pack.offset[i] + lane), speed = hn::Zero(d);
            for (int j = 0; j < 3; ++j) {
                const auto row = hn::Load(d, pack.row[i][j] + lane);
                place = hn::MulAdd(row, hn::Set(d, ray.origin[j]), place);
                speed = hn::MulAdd(row, hn::Set(d, ray.direction[j]), speed);
            }
            speed = hn::IfThenElse(hn::Lt(hn::Abs(speed), tiny), tiny, speed);
            const auto inverse = hn::Div(one, speed);
            const auto a = hn::Mul(hn::Sub(hn::Neg(one), place), inverse), b = hn::Mul(hn::Sub(one, place), inverse);
            enter = hn::Max(enter, hn::Min(a, b));
            leave = hn::Min(leave, hn::Max(a, b));
        }
        hn::Store(enter, d, entries + lane);
        found |= bits_of(d, hn::Le(enter, leave)) << lane;
    }
    return found;
}

/// Tests `count` primitives of a group from `first` on, none of them in a structure; returns whether the ray is done.
/// primitives  what is tested: `alone(id, t_last)` and `quadric(id, quest)`
template <class Quest, class Primitives>
HWY_INLINE bool test_one_by_one(Quest& quest, const Group& group, PrimitiveId first, std::uint32_t count,
                                const RootGeometry<typename Quest::Real>& geometry, const Primitives& primitives)
{
    for (PrimitiveId id = first; id < first + count; ++id) {
        quest.cost.add_test();
        TriangleHit<typename Quest::Real> found;
        if (id - group.first >= group.triangles) {
            found.t = primitives.quadric(id, quest);
            found.hit = std::isfinite(found.t);
        } else if (id != quest.hit.id && quest.sees(geometry.transmits(id))) {
            found = primitives.alone(id, quest.hit.t);
        }
        if (found.hit && quest.take(found.t, found.u, found.v, id) && Quest::query == Query::any) return true;
    }
    return false;
}

/// What a resolver says of a cell where boxes may stand.
template <class OwnVoxel>
struct VoxelWithBoxes {
    OwnVoxel own;
    bool has_own;
    const BoxedVoxel* boxed;  ///< null where no box stands
};

/// Own  resolver of what stands between the boxes
template <class Own>
class BoxedResolver {
public:
    BoxedResolver(const BoxedGrid& grid, const Own& own)
        : cells_(grid.structure.cells.data()), voxels_(grid.voxels.data()), own_(own)
    {
    }
    const Own& own() const { return own_; }
    CellWord word(std::int32_t cell) const { return cells_[cell]; }
    auto voxel(CellWord word, std::int32_t cell) const
    {
        using OwnVoxel = decltype(own_.voxel(word, cell));
        if (HWY_LIKELY(!word.is_special())) return VoxelWithBoxes<OwnVoxel>{own_.voxel(word, cell), true, nullptr};
        const BoxedVoxel& boxed = voxels_[word.index()];
        if (boxed.own.is_empty()) return VoxelWithBoxes<OwnVoxel>{OwnVoxel{}, false, &boxed};
        return VoxelWithBoxes<OwnVoxel>{own_.voxel(boxed.own, cell), true, &boxed};
    }

private:
    const CellWord* HWY_RESTRICT cells_;
    const BoxedVoxel* HWY_RESTRICT voxels_;
    Own own_;
};

/// A quest among the boxes of a boxed grid, and among the primitives that stand between them.
/// Among  the search between the boxes: Search, or what does more at a voxel
/// Own    its resolver
/// World  knows what items are: `supergrid(number)` gives the boxed grid in the same system that an item stands for, or
///        null; then `enter(number, quest)` sends the ray into the item and returns whether it is done
template <class Quest, class Among, class Own, class World>
class BoxSearch {
public:
    BoxSearch(Quest& quest, const World& world, Visits& visits, Among& among, const Own& own)
        : quest_(quest), world_(world), visits_(visits), among_(among), own_(own)
    {
    }

    /// grid   its structure is what `among` searches
    /// loose  see make_filter_ray
    /// Returns whether the ray is done.
    bool run(const BoxedGrid& grid, float loose)
    {
        if (!among_.begin(glm::dvec3(quest_.ray.origin), glm::dvec3(quest_.ray.direction), loose)) return false;
        return among_.large() || walk(grid, 0.0f);
    }

    // What the walk asks for.
    float t_stop() const { return among_.stop; }
    void count_cell() { among_.count_cell(); }
    template <class Voxel, class Resolver>
    HWY_INLINE bool visit(const Voxel& voxel, float t_enter, float t_leave, const Resolver& resolve)
    {
        if (HWY_UNLIKELY(voxel.boxed != nullptr) && boxes(*voxel.boxed, packs_, t_enter)) return true;
        return voxel.has_own && among_.visit(voxel.own, t_enter, t_leave, resolve.own());
    }

private:
    /// Goes through a boxed grid, which stands in the system of the walk.
    HWY_NOINLINE bool walk(const BoxedGrid& grid, float t_begin)
    {
        const BoxPack* const around = std::exchange(packs_, grid.packs.data());
        const bool is_list = grid.structure.cells.size() == 1 && grid.structure.cells[0].is_special();
        const bool done = is_list && grid.voxels[0].own.is_empty()
                              ? boxes(grid.voxels[0], packs_, t_begin)
                              : traverse(grid.structure.grids[0], among_.walk, t_begin, among_.stop,
                                         BoxedResolver<Own>(grid, own_), *this);
        packs_ = around;
        return done;
    }

    /// Sends the ray into the boxes of a voxel that it meets and was not in before, nearest first.
    HWY_NOINLINE bool boxes(const BoxedVoxel& voxel, const BoxPack* packs, float t_enter)
    {
        for (std::uint32_t p = 0; p < voxel.packs; ++p) {
            const BoxPack& pack = packs[voxel.first_pack + p];
            alignas(64) float entries[pack_size];
            std::uint32_t met =
                oriented_boxes_met(pack, among_.walk, t_enter - among_.walk.t_pad, among_.stop, entries);
            while (met != 0) {
                const int nearest = nearest_lane(met, entries);
                met &= ~(1u << nearest);
                if (entries[nearest] > among_.stop) break;
                if (visits_.is_first(pack.item[nearest]) && item(pack.item[nearest], entries[nearest])) return true;
            }
        }
        return false;
    }

    bool item(std::uint32_t number, float t_enter)
    {
        if (const BoxedGrid* inner = world_.supergrid(number)) return walk(*inner, t_enter - among_.walk.t_pad);
        if (world_.enter(number, quest_)) return true;
        among_.update_stop();
        return false;
    }

    Quest& quest_;
    const World& world_;
    Visits& visits_;
    Among& among_;  ///< the walk, and the primitives between the boxes
    Own own_;
    const BoxPack* packs_ = nullptr;  ///< of the grid that is walked through
};

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
