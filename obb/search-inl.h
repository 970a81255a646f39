// How a ray finds its way through boxes. Included once per instruction set.
#if defined(FIRSTRAY_OBB_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_OBB_SEARCH_INL_H_
#undef FIRSTRAY_OBB_SEARCH_INL_H_
#else
#define FIRSTRAY_OBB_SEARCH_INL_H_
#endif

#include "engine/grid/search-inl.h"
#include "obb/search.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::obb {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace firstray::HWY_NAMESPACE;

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

/// The primitives of a box, tested where they stand in the root system or in the box's own.
template <typename Real>
struct BoxPrimitives {
    const SearchTarget<Real>& target;
    const Box& box;
    std::uint32_t group;
    const SearchRay<Real>& ray;  ///< in the system that decides

    HWY_INLINE TriangleHit<Real> triangle(const TrianglePack& pack, int lane, PrimitiveId id, Real t_last) const
    {
        const RootTriangle<Real> tested =
            HWY_LIKELY(target.hits == Hits::root) ? target.geometry->triangle_of(group, id) : local(pack, lane, id);
        return intersect_precisely(tested, ray, target.precision, t_last);
    }

    Real quadric(PrimitiveId id, RayMask mask) const
    {
        if (target.hits == Hits::root) return intersect_rounded(target.geometry->quadric_of(group, id), ray, mask);
        const auto found = std::lower_bound(box.quadrics.begin(), box.quadrics.end(), id,
                                            [](const RootQuadric& q, PrimitiveId wanted) { return q.id < wanted; });
        return intersect_rounded(*found, ray, mask);
    }

private:
    RootTriangle<Real> local(const TrianglePack& pack, int lane, PrimitiveId id) const
    {
        if constexpr (std::is_same_v<Real, float>) {
            return pack.triangle(lane);
        } else {
            const Group& g = target.scene->groups[group];
            const glm::uvec3& vertex = target.scene->triangles[id - g.first + g.first_triangle].vertex;
            RootTriangle<double> t;
            for (int k = 0; k < 3; ++k) t.v[k] = box.local_from_node.point(target.scene->positions[vertex[k]]);
            t.edge = longest_edge<double>(t.v[0], t.v[1], t.v[2]);
            return t;
        }
    }
};

/// What a resolver says of a cell where boxes may stand.
struct VoxelWithBoxes {
    Voxel own;
    const BoxedVoxel* boxed;  ///< null where no box stands
};

class BoxedResolver {
public:
    explicit BoxedResolver(const BoxedGrid& grid) : eager_(grid.structure), voxels_(grid.voxels.data()) {}
    CellWord word(std::int32_t cell) const { return eager_.word(cell); }
    VoxelWithBoxes voxel(CellWord word, std::int32_t cell) const
    {
        if (HWY_LIKELY(!word.is_special())) return {eager_.voxel(word, cell), nullptr};
        const BoxedVoxel& boxed = voxels_[word.index()];
        return {boxed.own.is_empty() ? Voxel{} : eager_.voxel(boxed.own, cell), &boxed};
    }

private:
    EagerResolver eager_;
    const BoxedVoxel* voxels_;
};

/// A quest among the boxes of a boxed grid, and among the primitives that stand between them.
template <class Quest>
class BoxSearch {
public:
    using Real = typename Quest::Real;

    BoxSearch(Quest& quest, const SearchTarget<Real>& target, const BoxedGrid& grid, Visits& visits)
        : quest_(quest),
          target_(target),
          grid_(grid),
          visits_(visits),
          primitives_{*target.geometry, quest.ray, target.precision},
          among_{quest, primitives_, grid.structure}
    {
    }

    /// Returns whether the ray is done.
    bool run()
    {
        const bool loose = target_.precision == Precision::fast;
        if (!among_.begin(glm::dvec3(quest_.ray.origin), glm::dvec3(quest_.ray.direction), loose ? 1.0f : 0.0f))
            return false;
        return among_.large() || walk(grid_, 0.0f);
    }

    // What the walk asks for.
    float t_stop() const { return among_.stop; }
    void count_cell() { among_.count_cell(); }
    template <class Resolver>
    HWY_INLINE bool visit(const VoxelWithBoxes& voxel, float t_enter, float t_leave, const Resolver& resolve)
    {
        if (HWY_UNLIKELY(voxel.boxed != nullptr) && boxes(*voxel.boxed, current_->packs.data(), t_enter)) return true;
        if (voxel.own.subgrid) return enter(*voxel.own.subgrid, t_enter, t_leave, resolve);
        return voxel.own.list && among_.list(*voxel.own.list, t_enter);
    }

private:
    template <class Resolver>
    HWY_NOINLINE bool enter(const Grid& grid, float t_begin, float t_end, const Resolver& resolve)
    {
        return traverse(grid, among_.walk, t_begin, std::min(t_end, among_.stop), resolve, *this);
    }

    /// Goes through a boxed grid, which stands in the system of the walk.
    HWY_NOINLINE bool walk(const BoxedGrid& grid, float t_begin)
    {
        const BoxedGrid* const around = std::exchange(current_, &grid);
        const bool is_list = grid.structure.cells.size() == 1 && grid.structure.lists.empty();
        const bool done =
            is_list ? !grid.voxels.empty() && boxes(grid.voxels[0], grid.packs.data(), t_begin)
                    : traverse(grid.structure.grids[0], among_.walk, t_begin, among_.stop, BoxedResolver(grid), *this);
        current_ = around;
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
                int nearest = __builtin_ctz(met);
                for (std::uint32_t rest = met & (met - 1); rest != 0; rest &= rest - 1)
                    if (const int lane = __builtin_ctz(rest); entries[lane] < entries[nearest]) nearest = lane;
                met &= ~(1u << nearest);
                if (entries[nearest] > among_.stop) break;
                if (visits_.is_first(pack.item[nearest]) && item(pack.item[nearest], entries[nearest])) return true;
            }
        }
        return false;
    }

    bool item(std::uint32_t number, float t_enter)
    {
        const Placed& placed = (*target_.placed)[number];
        if (placed.supergrid) return walk(*placed.supergrid, t_enter - among_.walk.t_pad);
        const glm::dvec3 o = placed.local_from_root.point(glm::dvec3(quest_.ray.origin)),
                         d = placed.local_from_root.vector(glm::dvec3(quest_.ray.direction));
        if (HWY_LIKELY(target_.hits == Hits::root)) return box(placed, quest_.ray, o, d, placed.loose);
        using Vec = typename SearchRay<Real>::Vec;
        return box(placed, {Vec(o), Vec(d), quest_.ray.t_min, quest_.ray.t_max}, o, d, 1.0f);
    }

    /// ray   the one that is tested, in the system that decides
    /// o, d  the ray in the box's system
    HWY_NOINLINE bool box(const Placed& placed, const SearchRay<Real>& ray, const glm::dvec3& o, const glm::dvec3& d,
                          float loose)
    {
        const GridStructure& inside = placed.box->inside;
        const BoxPrimitives<Real> primitives{target_, *placed.box, placed.group, ray};
        Search<Quest, BoxPrimitives<Real>> search{quest_, primitives, inside};
        if (!search.begin(o, d, target_.precision == Precision::fast ? loose : 0.0f)) return false;
        if (search.run(EagerResolver(inside))) return true;
        among_.update_stop();
        return false;
    }

    Quest& quest_;
    const SearchTarget<Real>& target_;
    const BoxedGrid& grid_;
    Visits& visits_;
    RootPrimitives<Real> primitives_;
    Search<Quest, RootPrimitives<Real>> among_;  ///< the walk, and the primitives between the boxes
    const BoxedGrid* current_ = nullptr;         ///< whose voxels are being walked through
};

/// A ray's whole search.
template <typename Real>
struct Searcher {
    const SearchTarget<Real>& target;
    Visits& visits;

    template <class Quest>
    HWY_INLINE void operator()(Quest& quest) const
    {
        visits.begin_ray(target.placed->size());
        if (target.outer && BoxSearch<Quest>(quest, target, *target.outer, visits).run()) return;
        if (target.scenery) BoxSearch<Quest>(quest, target, *target.scenery, visits).run();
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace firstray::obb
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
