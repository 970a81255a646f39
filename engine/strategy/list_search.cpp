#include "engine/strategy/list_search.h"

#include <chrono>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/strategy/list_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/primitive/intersect-inl.h"
#include "engine/primitive/ray_kernels-inl.h"
#include "engine/primitive/triangle_pack.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// The rays of a tile that can meet anything, packed, with the best hit of each.
template <typename Real>
struct ListSearch {
    RayLanes<Real> lanes;
    std::array<SearchRay<Real>, RayTile<Real>::capacity> rays;
    std::array<Hit<Real>, RayTile<Real>::capacity> hits;
    std::array<int, RayTile<Real>::capacity> tile_lane;

    explicit ListSearch(RayTile<Real>& tile)
    {
        for (int lane = 0; lane < tile.count; ++lane) {
            tile.primitive[static_cast<std::size_t>(lane)] = no_primitive;
            const auto i = static_cast<std::size_t>(lanes.count);
            if (!make_search_ray(tile, lane, rays[i])) continue;
            hits[i] = {rays[i].t_max};
            tile_lane[i] = lane;
            set_lane(i, rays[i].origin, rays[i].direction);
            ++lanes.count;
        }
        // The last block is filled up with its first ray, whose answers there are not looked at.
        for (auto i = static_cast<std::size_t>(lanes.count); i % lanes.block != 0; ++i)
            set_lane(i, rays[0].origin, rays[0].direction);
    }

    void set_lane(std::size_t i, const typename RayTile<Real>::Vec& origin,
                  const typename RayTile<Real>::Vec& direction)
    {
        for (int axis = 0; axis < 3; ++axis) {
            lanes.origin[axis][i] = origin[axis];
            lanes.direction[axis][i] = direction[axis];
        }
        const auto along = glm::abs(direction);
        lanes.length[i] = std::max(std::max(along.x, along.y), along.z);
    }

    void offer(std::size_t i, Real t, Real u, Real v, PrimitiveId id)
    {
        if (t > rays[i].t_min && hits[i].is_beaten_by(t, id)) hits[i] = {t, u, v, id};
    }
};

template <typename Real>
void test_triangle(const RootTriangle<Real>& triangle, PrimitiveId id, Precision precision, ListSearch<Real>& search)
{
    for (int first = 0; first < search.lanes.count; first += search.lanes.block) {
        std::uint32_t maybe = not_passing(triangle, search.lanes, first, precision != Precision::fast);
        for (; maybe != 0; maybe &= maybe - 1) {
            const int lane = first + __builtin_ctz(maybe);
            if (lane >= search.lanes.count) break;
            const auto i = static_cast<std::size_t>(lane);
            const TriangleHit<Real> hit = intersect_precisely(triangle, search.rays[i], precision, search.hits[i].t);
            if (hit.hit) search.offer(i, hit.t, hit.u, hit.v, id);
        }
    }
}

template <typename Real>
void search_tile(const RootGeometry<Real>& geometry, Precision precision, bool any, RayTile<Real>& tile)
{
    const auto begin = std::chrono::steady_clock::now();
    const auto search = std::make_unique<ListSearch<Real>>(tile);
    const auto is_done = [&] {
        return any && std::all_of(search->hits.begin(), search->hits.begin() + search->lanes.count,
                                  [](const Hit<Real>& hit) { return hit.id != no_primitive; });
    };
    std::uint32_t tests = 0;
    for (const PrimitiveId id : geometry.visible().triangles) {
        if (!admits(tile.mask, geometry.transmits(id))) continue;
        if (++tests % 4096 == 0 && is_done()) break;
        test_triangle(geometry.triangle(id), id, precision, *search);
    }
    for (const PrimitiveId id : geometry.visible().quadrics) {
        const RootQuadric& quadric = geometry.quadric(id);
        if (!admits(tile.mask, quadric.transmits)) continue;
        ++tests;
        for (std::size_t i = 0; i < static_cast<std::size_t>(search->lanes.count); ++i) {
            const Real t = intersect_rounded(quadric, search->rays[i]);
            if (std::isfinite(t)) search->offer(i, t, 0, 0, quadric.id);
        }
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(search->lanes.count); ++i)
        store_hit(search->rays[i], search->hits[i], tile, search->tile_lane[i]);
    if (tile.cost == nullptr) return;
    const auto spent = static_cast<std::uint64_t>((std::chrono::steady_clock::now() - begin).count());
    for (int i = 0; i < tile.count; ++i) {
        tile.cost[i].tests += tests;
        tile.cost[i].nanoseconds += spent / static_cast<std::uint64_t>(tile.count);
    }
}

void list_float(const RootGeometry<float>& geometry, Precision precision, bool any, RayTile<float>& tile)
{
    search_tile(geometry, precision, any, tile);
}
void list_double(const RootGeometry<double>& geometry, Precision precision, bool any, RayTile<double>& tile)
{
    search_tile(geometry, precision, any, tile);
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace firstray::inline v0 {

HWY_EXPORT(list_float);
HWY_EXPORT(list_double);

void search_list(const RootGeometry<float>& geometry, Precision precision, bool any, RayTile<float>& tile)
{
    HWY_DYNAMIC_DISPATCH(list_float)(geometry, precision, any, tile);
}
void search_list(const RootGeometry<double>& geometry, Precision precision, bool any, RayTile<double>& tile)
{
    HWY_DYNAMIC_DISPATCH(list_double)(geometry, precision, any, tile);
}

}  // namespace firstray::inline v0
#endif  // HWY_ONCE
