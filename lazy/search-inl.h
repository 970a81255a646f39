// How a ray finds its way through grids that come into being as it goes. Included once per instruction set.
#if defined(FIRSTRAY_LAZY_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_LAZY_SEARCH_INL_H_
#undef FIRSTRAY_LAZY_SEARCH_INL_H_
#else
#define FIRSTRAY_LAZY_SEARCH_INL_H_
#endif

#include "engine/grid/beam_box_search-inl.h"
#include "engine/grid/pack_lists.h"
#include "lazy/search.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0::lazy {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace firstray::HWY_NAMESPACE;

/// A voxel of a lazy grid, by its cell.
struct LazyVoxel {
    std::uint32_t cell;
};

class LazyResolver {
public:
    explicit LazyResolver(const GridStructure& top) : cells_(top.cells.data()) {}
    CellWord word(std::int32_t cell) const { return cells_[cell]; }
    LazyVoxel voxel(CellWord /*word*/, std::int32_t cell) const { return {static_cast<std::uint32_t>(cell)}; }

private:
    const CellWord* HWY_RESTRICT cells_;
};

/// The search of a lazy grid: that of its top grid's structure first, then of those of the voxels it enters, which have
/// the same system and pads.
template <class Quest>
struct LazySearch : Search<Quest, RootPrimitives<typename Quest::Real>> {
    using Base = Search<Quest, RootPrimitives<typename Quest::Real>>;
    using Base::primitives;
    using Base::quest;

    const LazyGrid* grid;  ///< null where only boxes are looked for

    LazySearch(Quest& q, const RootPrimitives<typename Quest::Real>& p, const GridStructure& top, const LazyGrid* lazy)
        : Base{q, p, &top}, grid(lazy)
    {
    }

    HWY_INLINE bool visit(const LazyVoxel& voxel, float t_enter, float t_leave, const LazyResolver&)
    {
        const GridStructure* built = grid->voxel(voxel.cell);
        if (HWY_UNLIKELY(!built)) return unbuilt(voxel.cell);
        this->structure = built;
        if (built->cells.size() == 1) return Base::list(built->lists[0], t_enter);
        return Base::enter(built->grids[0], t_enter, t_leave, EagerResolver(*built));
    }
    template <class Voxel, class Resolver>
    HWY_INLINE bool visit(const Voxel& voxel, float t_enter, float t_leave, const Resolver& resolve)
    {
        return Base::visit(voxel, t_enter, t_leave, resolve);
    }

    /// Tests what a cell lists, one by one.
    HWY_NOINLINE bool unbuilt(std::uint32_t cell)
    {
        const GridEntries& entries = grid->entries();
        for (const std::uint32_t entry : grid->listed(cell)) {
            const PrimitiveId id = entries.ids[entry] & ~transmitting_bit;
            quest.cost.add_test();
            if (!entries.is_triangle(entry)) {
                const auto t = primitives.quadric(id, quest);
                if (std::isfinite(t) && this->offer(t, 0, 0, id)) return true;
                continue;
            }
            if (id == quest.hit.id || !quest.sees((entries.ids[entry] & transmitting_bit) != 0)) continue;
            const auto found = primitives.triangle_of(entries, entry, id, quest.hit.t);
            if (found.hit && this->offer(found.t, found.u, found.v, id)) return true;
        }
        return false;
    }
};

/// How many single rays' searches of a list, roughly, that of a beam takes: most of it is done once for all packets.
inline std::uint64_t rays_worth(PacketMask packets)
{
    return 2 + static_cast<std::uint64_t>(__builtin_popcountll(packets));
}

/// The same for beams.
template <class BeamQuest>
struct LazyBeamSearch : BeamSearch<BeamQuest, BeamRootPrimitives> {
    using Base = BeamSearch<BeamQuest, BeamRootPrimitives>;

    const LazyGrid* grid;

    LazyBeamSearch(BeamQuest& q, const BeamRootPrimitives& p, const GridStructure& top, const LazyGrid* lazy)
        : Base{q, q.root, p, &top, q.precision == Precision::fast ? 1.0f : 0.0f}, grid(lazy)
    {
    }

    HWY_INLINE void visit(const LazyVoxel& voxel, PacketMask packets, const LazyResolver&)
    {
        const GridStructure* built = grid->built(voxel.cell);
        if (HWY_UNLIKELY(!built)) {
            const Aabb box = cell_box(grid->top().grids[0], voxel.cell);
            if (!any_ray_meets(this->quest.rays, packets, box.lo, box.hi, 4.0f * this->wide)) return;
            built = grid->voxel(voxel.cell, rays_worth(packets));
            if (!built) return unbuilt(voxel.cell, packets);
        }
        this->structure = built;
        if (built->cells.size() == 1)
            Base::list(built->lists[0], packets);
        else
            walk_slices(built->grids[0], this->beam, packets, this->wide, EagerResolver(*built), *this);
    }
    template <class Voxel, class Resolver>
    HWY_INLINE void visit(const Voxel& voxel, PacketMask packets, const Resolver& resolve)
    {
        Base::visit(voxel, packets, resolve);
    }

    /// Tests what a cell lists, sixteen at a time.
    HWY_NOINLINE void unbuilt(std::uint32_t cell, PacketMask packets)
    {
        const GridEntries& entries = grid->entries();
        PackOfPieces pack;
        for (const std::uint32_t entry : grid->listed(cell)) {
            if (!entries.is_triangle(entry)) {
                this->quadric(this->primitives.quadric(entries.ids[entry]), packets);
                continue;
            }
            pack.add(entries.triangle(entry), entries.ids[entry]);
            if (pack.is_full()) this->pack(pack.take(), packets);
        }
        if (!pack.is_empty()) this->pack(pack.take(), packets);
    }
};

/// The primitives of a group that may not be carried yet, and is not to be.
template <typename Real>
struct GroupPrimitives {
    const RootGeometry<Real>& geometry;
    std::uint32_t group;
    const SearchRay<Real>& ray;
    Precision precision;

    TriangleHit<Real> alone(PrimitiveId id, Real t_last) const
    {
        const RootTriangle<Real> tested = geometry.triangle_alone(group, id);
        if (!is_in_range(tested.v)) return {};  // no structure lists it
        return intersect_precisely(tested, ray, precision, t_last);
    }
    template <class Quest>
    Real quadric(PrimitiveId id, Quest& quest) const
    {
        return test_quadric(geometry.quadric_alone(group, id), ray, quest);
    }
};

/// What the items are: see BoxSearch.
template <typename Real>
struct World {
    const SearchTarget<Real>& target;

    const BoxedGrid* supergrid(std::uint32_t) const { return nullptr; }

    template <class Quest>
    HWY_NOINLINE bool enter(std::uint32_t group, Quest& quest) const
    {
        if (!may_admit(quest.mask, target.groups->may_transmit(group))) return false;
        const LazyGrid* grid = target.groups->grid(group);
        if (HWY_UNLIKELY(!grid)) {
            const Group& g = target.scene->groups[group];
            const GroupPrimitives<Real> alone{*target.geometry, group, quest.ray, target.precision};
            return test_one_by_one(quest, g, g.first, g.primitives(), *target.geometry, alone);
        }
        const RootPrimitives<Real> primitives{*target.geometry, quest.ray, target.precision};
        LazySearch<Quest> search(quest, primitives, grid->top(), grid);
        const float loose = target.precision == Precision::fast ? 1.0f : 0.0f;
        return search.begin(glm::dvec3(quest.ray.origin), glm::dvec3(quest.ray.direction), loose) &&
               (search.large() ||
                traverse(grid->top().grids[0], search.walk, 0.0f, search.stop, LazyResolver(grid->top()), search));
    }
};

/// What the items are for beams: see BeamBoxSearch.
struct BeamWorld {
    const SearchTarget<float>& target;

    const BoxedGrid* supergrid(std::uint32_t) const { return nullptr; }

    template <class BeamQuest>
    HWY_NOINLINE void enter_beam(std::uint32_t group, BeamQuest& quest, PacketMask packets) const
    {
        if (!may_admit(quest.mask, target.groups->may_transmit(group))) return;
        const BeamRootPrimitives primitives{*target.geometry};
        const LazyGrid* grid = target.groups->grid(group, rays_worth(packets));
        if (HWY_UNLIKELY(!grid)) return without_grid(group, quest, packets, primitives);
        const Grid& top = grid->top().grids[0];
        if (const PacketMask wide = too_wide(quest.root, packets, top, top.fine_length(), most_columns_in_box)) {
            const World<float> world{target};
            quest.each_ray(wide, quest.root, [&](auto& single) { world.enter(group, single); });
            packets &= ~wide;
            if (packets == 0) return;
        }
        LazyBeamSearch<BeamQuest> search(quest, primitives, grid->top(), grid);
        search.begin();
        search.list(grid->top().large, packets);
        walk_slices(top, quest.root, packets, search.wide, LazyResolver(grid->top()), search);
    }

    /// Tests what is in a group, sixteen at a time, whether it is carried or not.
    template <class BeamQuest>
    HWY_NOINLINE void without_grid(std::uint32_t group, BeamQuest& quest, PacketMask packets,
                                   const BeamRootPrimitives& primitives) const
    {
        static const GridStructure none_at_all;
        BeamSearch<BeamQuest, BeamRootPrimitives> search{quest, quest.root, primitives, &none_at_all,
                                                         quest.precision == Precision::fast ? 1.0f : 0.0f};
        search.wide = std::numeric_limits<float>::infinity();  // no depth is known here to be beyond anything
        const Group& g = target.scene->groups[group];
        PackOfPieces pack;
        for (PrimitiveId id = g.first; id < g.first + g.primitives(); ++id) {
            if (id - g.first >= g.triangles) {
                search.quadric(target.geometry->quadric_alone(group, id), packets);
                continue;
            }
            const RootTriangle<float> triangle = target.geometry->triangle_alone(group, id);
            if (!is_in_range(triangle.v)) continue;  // no structure lists it
            pack.add(triangle, id | (target.geometry->transmits(id) ? transmitting_bit : 0));
            if (pack.is_full()) search.pack(pack.take(), packets);
        }
        if (!pack.is_empty()) search.pack(pack.take(), packets);
    }
};

/// A ray's whole search, and a beam's.
template <typename Real>
struct Searcher {
    const SearchTarget<Real>& target;
    Visits& visits;

    template <class Quest>
    void operator()(Quest& quest) const
    {
        visits.begin_ray(target.scene->groups.size());
        if (target.outer && search(*target.outer, nullptr, quest)) return;
        if (target.scenery) search(*target.around, target.scenery, quest);
    }

    std::uint64_t version() const { return target.geometry->version(); }
    const Grid* top() const
    {
        if (target.scenery) return &target.around->structure.grids[0];
        return target.outer ? &target.outer->structure.grids[0] : nullptr;
    }

    template <class BeamQuest>
    void beam(BeamQuest& quest) const
    {
        visits.begin_ray(target.scene->groups.size());
        if (target.outer) search_beam(*target.outer, nullptr, quest);
        if (target.scenery) search_beam(*target.around, target.scenery, quest);
    }

private:
    template <class BeamQuest>
    void search_beam(const BoxedGrid& grid, const LazyGrid* lazy, BeamQuest& quest) const
    {
        const BeamRootPrimitives primitives{*target.geometry};
        LazyBeamSearch<BeamQuest> among(quest, primitives, grid.structure, lazy);
        const BeamWorld world{target};
        BeamBoxSearch(quest, world, visits, among, LazyResolver(grid.structure)).run(grid);
    }

    template <class Quest>
    bool search(const BoxedGrid& grid, const LazyGrid* lazy, Quest& quest) const
    {
        const RootPrimitives<Real> primitives{*target.geometry, quest.ray, target.precision};
        LazySearch<Quest> among(quest, primitives, grid.structure, lazy);
        const World<Real> world{target};
        return BoxSearch(quest, world, visits, among, LazyResolver(grid.structure))
            .run(grid, target.precision == Precision::fast ? 1.0f : 0.0f);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0::lazy
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
