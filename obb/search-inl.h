// How a ray finds its way through boxes. Included once per instruction set.
#if defined(FIRSTRAY_OBB_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_OBB_SEARCH_INL_H_
#undef FIRSTRAY_OBB_SEARCH_INL_H_
#else
#define FIRSTRAY_OBB_SEARCH_INL_H_
#endif

#include "engine/grid/beam_box_search-inl.h"
#include "engine/grid/beam_transform-inl.h"
#include "obb/search.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0::obb {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace firstray::HWY_NAMESPACE;

/// The primitives of a box, tested where they stand in the root system or in the box's own.
template <typename Real>
struct BoxPrimitives {
    const SearchTarget<Real>& target;
    const Box& box;
    std::uint32_t group;
    bool in_root;
    const SearchRay<Real>& ray;  ///< in the system that decides

    HWY_INLINE TriangleHit<Real> triangle(const TrianglePack& pack, int lane, PrimitiveId id, Real t_last) const
    {
        const RootTriangle<Real> tested =
            HWY_LIKELY(in_root) ? target.geometry->triangle_of(group, id) : local(pack, lane, id);
        return intersect_precisely(tested, ray, target.precision, t_last);
    }

    template <class Quest>
    Real quadric(PrimitiveId id, Quest& quest) const
    {
        if (in_root) return test_quadric(target.geometry->quadric_of(group, id), ray, quest);
        const auto found = std::lower_bound(box.quadrics.begin(), box.quadrics.end(), id,
                                            [](const RootQuadric& q, PrimitiveId wanted) { return q.id < wanted; });
        return test_quadric(*found, ray, quest);
    }

    /// The same of a primitive that no pack holds.
    TriangleHit<Real> alone(PrimitiveId id, Real t_last) const
    {
        const RootTriangle<Real> tested = in_root ? target.geometry->triangle_of(group, id) : local_of(id);
        if (!is_in_range(tested.v)) return {};
        return intersect_precisely(tested, ray, target.precision, t_last);
    }

private:
    RootTriangle<Real> local(const TrianglePack& pack, int lane, PrimitiveId id) const
    {
        if constexpr (std::is_same_v<Real, float>)
            return pack.triangle(lane);
        else
            return local_of(id);
    }

    RootTriangle<Real> local_of(PrimitiveId id) const
    {
        const Group& g = target.scene->groups[group];
        const glm::uvec3& vertex = target.scene->triangles[id - g.first + g.first_triangle].vertex;
        RootTriangle<Real> t;
        for (int k = 0; k < 3; ++k)
            t.v[k] = typename RootTriangle<Real>::Vec(box.local_from_node.point(target.scene->position(vertex[k])));
        t.edge = longest_edge<Real>(t.v[0], t.v[1], t.v[2]);
        return t;
    }
};

/// What the items are: see BoxSearch.
template <typename Real>
struct World {
    const SearchTarget<Real>& target;

    const BoxedGrid* supergrid(std::uint32_t number) const { return (*target.placed)[number].supergrid; }

    template <class Quest>
    bool enter(std::uint32_t number, Quest& quest) const
    {
        const Placed& placed = (*target.placed)[number];
        if (!may_admit(quest.mask, target.geometry->group_transmits(placed.group))) return false;
        const glm::dvec3 o = placed.local_from_root.point(glm::dvec3(quest.ray.origin)),
                         d = placed.local_from_root.vector(glm::dvec3(quest.ray.direction));
        if (HWY_LIKELY(placed.in_root)) return search_box(quest, placed, quest.ray, o, d, placed.loose);
        using Vec = typename SearchRay<Real>::Vec;
        return search_box(quest, placed, {Vec(o), Vec(d), quest.ray.t_min, quest.ray.t_max}, o, d, 1.0f);
    }

    /// ray   the one that is tested, in the system that decides
    /// o, d  the ray in the box's system
    template <class Quest>
    HWY_NOINLINE bool search_box(Quest& quest, const Placed& placed, const SearchRay<Real>& ray, const glm::dvec3& o,
                                 const glm::dvec3& d, float loose) const
    {
        const GridStructure* inside = placed.box->enter();
        const BoxPrimitives<Real> primitives{target, *placed.box, placed.group, placed.in_root, ray};
        if (HWY_UNLIKELY(!inside) || largest_component<double>(o) > far_away * static_cast<double>(inside->pad))
            return one_by_one(quest, *placed.plan, primitives);
        Search<Quest, BoxPrimitives<Real>> search{quest, primitives, inside};
        return search.begin(o, d, target.precision == Precision::fast ? loose : 0.0f) &&
               search.run(EagerResolver(*inside));
    }

    /// Tests all primitives of a box.
    template <class Quest>
    HWY_NOINLINE bool one_by_one(Quest& quest, const BoxPlan& plan, const BoxPrimitives<Real>& primitives) const
    {
        const Group& group = target.scene->groups[plan.group];
        for (const PrimitiveRange& range : plan.primitives)
            if (test_one_by_one(quest, group, range.first, range.count, *target.geometry, primitives)) return true;
        return false;
    }
};

/// The primitives of a box where they stand in the root system, for beams.
struct BoxBeamPrimitives {
    static constexpr bool stand_in_packs = false;
    const RootGeometry<float>& geometry;
    std::uint32_t group;
    RootTriangle<float> triangle(PrimitiveId id) const { return geometry.triangle_of(group, id); }
    RootQuadric quadric(PrimitiveId id) const { return geometry.quadric_of(group, id); }
};

/// What the items are for beams: see BeamBoxSearch.
struct BeamWorld {
    const SearchTarget<float>& target;

    const BoxedGrid* supergrid(std::uint32_t number) const { return (*target.placed)[number].supergrid; }

    template <class BeamQuest>
    HWY_NOINLINE void enter_beam(std::uint32_t number, BeamQuest& quest, PacketMask packets) const
    {
        const Placed& placed = (*target.placed)[number];
        if (!may_admit(quest.mask, target.geometry->group_transmits(placed.group))) return;
        const GridStructure* inside = placed.in_root ? placed.box->enter() : nullptr;
        PacketMask alone = packets;
        if (HWY_LIKELY(inside)) {
            Beam local;
            PacketMask straight = transform(quest.root, packets, placed.local_from_root, local);
            straight &=
                ~too_wide(local, straight, inside->grids[0], inside->grids[0].fine_length(), most_columns_in_box);
            const BoxBeamPrimitives primitives{*target.geometry, placed.group};
            BeamSearch<BeamQuest, BoxBeamPrimitives> search{quest, local, primitives, inside,
                                                            target.precision == Precision::fast ? placed.loose : 0.0f};
            search.run(straight, EagerResolver(*inside));
            alone &= ~straight;
        }
        const World<float> world{target};
        quest.each_ray(alone, quest.root, [&](auto& single) { world.enter(number, single); });
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
        visits.begin_ray(target.placed->size());
        if (target.outer && search(*target.outer, quest)) return;
        if (target.scenery) search(*target.scenery, quest);
    }

    std::uint64_t version() const { return target.geometry->version(); }
    const Grid* top() const
    {
        if (target.scenery) return &target.scenery->structure.grids[0];
        return target.outer ? &target.outer->structure.grids[0] : nullptr;
    }

    template <class BeamQuest>
    void beam(BeamQuest& quest) const
    {
        visits.begin_ray(target.placed->size());
        if (target.outer) search_beam(*target.outer, quest);
        if (target.scenery) search_beam(*target.scenery, quest);
    }

private:
    template <class BeamQuest>
    void search_beam(const BoxedGrid& grid, BeamQuest& quest) const
    {
        const BeamRootPrimitives primitives{*target.geometry};
        BeamSearch<BeamQuest, BeamRootPrimitives> among{quest, quest.root, primitives, &grid.structure,
                                                        target.precision == Precision::fast ? 1.0f : 0.0f};
        const BeamWorld world{target};
        BeamBoxSearch(quest, world, visits, among, EagerResolver(grid.structure)).run(grid);
    }

    template <class Quest>
    HWY_INLINE bool search(const BoxedGrid& grid, Quest& quest) const
    {
        const RootPrimitives<Real> primitives{*target.geometry, quest.ray, target.precision};
        Search<Quest, RootPrimitives<Real>> among{quest, primitives, &grid.structure};
        const World<Real> world{target};
        return BoxSearch(quest, world, visits, among, EagerResolver(grid.structure))
            .run(grid, target.precision == Precision::fast ? 1.0f : 0.0f);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0::obb
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
