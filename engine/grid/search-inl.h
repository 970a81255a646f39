// What a single ray does in the voxels it walks through. Included once per instruction set.
#if defined(FIRSTRAY_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_SEARCH_INL_H_
#undef FIRSTRAY_SEARCH_INL_H_
#else
#define FIRSTRAY_SEARCH_INL_H_
#endif

#include <chrono>

#include "engine/grid/search.h"
#include "engine/grid/traverse-inl.h"
#include "engine/primitive/intersect.h"

HWY_BEFORE_NAMESPACE();
namespace firstray {
namespace HWY_NAMESPACE {

enum class Query { closest, any };

/// Counts nothing, at no cost.
struct NoCost {
    void add_cell() {}
    void add_tests(const TrianglePack&) {}
    void add_quadric() {}
};

/// Counts what a ray does.
struct CountCost {
    RayCost* cost;
    void add_cell() { ++cost->cells; }
    void add_tests(const TrianglePack& pack)
    {
        for (const std::uint32_t id : pack.id) cost->tests += id != no_primitive;
    }
    void add_quadric() { ++cost->tests; }
};

/// A ray on its way: what it looks for and what it has found.
template <Query query, typename Real, class Cost>
struct Search {
    const SearchTarget<Real>& target;
    const SearchRay<Real>& ray;
    RayMask mask;
    Cost cost;
    FilterRay filter;
    WalkRay walk;
    Hit<Real> hit;
    float stop = 0.0f;  ///< walk t beyond which no primitive can beat the hit

    float t_stop() const { return stop; }
    void count_cell() { cost.add_cell(); }

    void update_stop()
    {
        const double t = static_cast<double>(hit.t);
        const double t_last = t + std::abs(t) * t_slack;
        stop = static_cast<float>(t_last - walk.shift) + walk.t_pad;
        filter.set_far_end(stop, target.structure->pad);
    }

    /// Takes a hit if it counts; returns whether the ray is done.
    bool offer(Real t, Real u, Real v, PrimitiveId id)
    {
        if (!(t > ray.t_min) || !hit.is_beaten_by(t, id)) return false;
        hit = {t, u, v, id};
        if constexpr (query == Query::any) return true;
        update_stop();
        return false;
    }

    HWY_INLINE bool pack(const TrianglePack& pack)
    {
        cost.add_tests(pack);
        std::uint32_t lanes = candidates(pack, filter);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int lane = __builtin_ctz(lanes);
            const std::uint32_t marked = pack.id[lane];
            const PrimitiveId id = marked & ~transmitting_bit;
            if (id == hit.id || !admits(mask, (marked & transmitting_bit) != 0)) continue;
            const TriangleHit<Real> found = intersect_lane(pack, lane, id);
            if (found.hit && offer(found.t, found.u, found.v, id)) return true;
        }
        return false;
    }

    TriangleHit<Real> intersect_lane(const TrianglePack& pack, int lane, PrimitiveId id) const
    {
        if constexpr (std::is_same_v<Real, float>)
            return intersect_precisely(pack.triangle(lane), ray, target.precision, hit.t);
        else
            return intersect_precisely(target.geometry->triangle(id), ray, target.precision, hit.t);
    }

    bool quadrics(const VoxelList& voxel)
    {
        for (std::uint32_t q = 0; q < voxel.quadrics; ++q) {
            const RootQuadric& quadric =
                target.geometry->quadrics()[target.structure->quadrics[voxel.first_quadric + q]];
            cost.add_quadric();
            if (!admits(mask, quadric.transmits)) continue;
            const Real t = intersect_rounded(quadric, ray);
            if (std::isfinite(t) && offer(t, 0, 0, quadric.id)) return true;
        }
        return false;
    }

    /// Tests a voxel's primitives; returns whether the ray is done.
    HWY_INLINE bool list(const VoxelList& voxel, float t_enter)
    {
        const TrianglePack* packs = target.structure->packs.data() + voxel.first_pack;
        if (voxel.packs < boxed_packs) {
            if (voxel.packs == 1 && pack(packs[0])) return true;
        } else {
            for (std::uint32_t block = 0; block < voxel.box_blocks(); ++block)
                if (boxed(target.structure->boxes[voxel.first_boxes + block], packs + block * pack_size, t_enter))
                    return true;
        }
        return voxel.quadrics > 0 && quadrics(voxel);
    }

    HWY_INLINE bool boxed(const PackBoxes& boxes, const TrianglePack* packs, float t_enter)
    {
        alignas(64) float entries[pack_size];
        for (std::uint32_t met = boxes_met(boxes, walk, t_enter - walk.t_pad, stop, entries); met != 0;
             met &= met - 1) {
            const int lane = __builtin_ctz(met);
            if (entries[lane] <= stop && pack(packs[lane])) return true;
        }
        return false;
    }

    template <class Resolver>
    HWY_NOINLINE bool enter(const Grid& grid, const WalkRay& walk_ray, float t_begin, float t_end,
                            const Resolver& resolve)
    {
        return traverse(grid, walk_ray, t_begin, std::min(t_end, stop), resolve, *this);
    }
};

/// Moves the ray to where it enters the grid's box; false when it does not.
template <typename Real>
HWY_INLINE bool make_walk_ray(const SearchRay<Real>& ray, const Grid& top, float pad, WalkRay& walk)
{
    const glm::dvec3 o(ray.origin), d(ray.direction), lo(top.lo), hi(top.hi());
    // A hit's t is off by its slack; one that lies before t_min by that much can still be found beyond it.
    const double t_min = static_cast<double>(ray.t_min);
    double enter = t_min - std::abs(t_min) * t_slack, leave = static_cast<double>(ray.t_max);
    const double wide = 2.0 * static_cast<double>(pad);
    double length = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        // A ray along a slab meets it everywhere or nowhere: its planes are crossed at minus and plus very far.
        walk.exact_inverse[axis] = d[axis] != 0.0 ? 1.0 / d[axis] : 1e300;
        const double a = (lo[axis] - wide - o[axis]) * walk.exact_inverse[axis];
        const double b = (hi[axis] + wide - o[axis]) * walk.exact_inverse[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
        length = std::max(length, std::abs(d[axis]));
    }
    if (!(enter <= leave)) return false;
    walk.shift = enter;
    walk.t_pad = static_cast<float>(static_cast<double>(pad) / length);
    for (int axis = 0; axis < 3; ++axis) {
        walk.origin[axis] = static_cast<float>(o[axis] + enter * d[axis]);
        walk.direction[axis] = static_cast<float>(d[axis]);
        const float inverse = static_cast<float>(walk.exact_inverse[axis]);
        walk.inverse[axis] = std::abs(inverse) < 1e18f ? inverse : std::copysign(1e18f, inverse);
    }
    walk.origin[3] = walk.direction[3] = 0.0f;
    walk.inverse[3] = 1.0f;
    return true;
}

template <Query query, typename Real, class Cost, class Resolver>
HWY_INLINE void search_ray(const SearchTarget<Real>& target, const Resolver& resolve, const SearchRay<Real>& ray,
                           int lane, Cost cost, RayTile<Real>& tile)
{
    const GridStructure& structure = *target.structure;
    Search<query, Real, Cost> search{target, ray, tile.mask, cost, {}, {}, {ray.t_max}};
    if (!make_walk_ray(ray, structure.grids[0], structure.pad, search.walk)) return;
    search.filter =
        make_filter_ray(ray, search.walk.exact_inverse, structure.largest, target.precision == Precision::fast);
    search.filter.set_near_end(search.walk, structure.pad);
    search.update_stop();
    if (!search.list(structure.large, 0.0f))
        traverse(structure.grids[0], search.walk, 0.0f, search.stop, resolve, search);
    store_hit(ray, search.hit, tile, lane);
}

template <Query query, typename Real, class Resolver>
void search_tile(const SearchTarget<Real>& target, const Resolver& resolve, RayTile<Real>& tile)
{
    using Clock = std::chrono::steady_clock;
    for (int lane = 0; lane < tile.count; ++lane) {
        tile.primitive[static_cast<std::size_t>(lane)] = no_primitive;
        SearchRay<Real> ray;
        if (!make_search_ray(tile, lane, ray)) continue;
        if (tile.cost == nullptr) {
            search_ray<query>(target, resolve, ray, lane, NoCost{}, tile);
            continue;
        }
        const Clock::time_point begin = Clock::now();
        search_ray<query>(target, resolve, ray, lane, CountCost{tile.cost + lane}, tile);
        tile.cost[lane].nanoseconds += static_cast<std::uint64_t>((Clock::now() - begin).count());
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
