#include "lazy/calibrate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "engine/scene/pose.h"
#include "lazy/flat_list.h"
#include "lazy/lazy.h"
#include "lazy/lazy_grid.h"

namespace firstray::inline v0::lazy {
namespace {

/// Everything is done so often, and the quickest counts: what disturbs a measurement only ever makes it slower.
constexpr int repeats = 7;

constexpr int few = 16, many = 256;  ///< triangles of a stack: a pack, and sixteen packs with a block of boxes
constexpr int rays = 64;

/// No cost is less: nothing takes no time, and the arithmetic divides by some.
constexpr double least_cost = 0.1;

/// A scene of one group of triangles, which moves or not.
class Builder {
public:
    explicit Builder(bool moves)
    {
        scene_.nodes.emplace_back();
        scene_.groups.emplace_back();
        scene_.materials.emplace_back();
        if (!moves) return;
        scene_.nodes.emplace_back();
        scene_.nodes.back().parent = 0;
        scene_.nodes.back().dynamic = true;
        scene_.groups.push_back({.node = 1});
    }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
    {
        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        scene_.positions.insert(scene_.positions.end(), {a, b, c});
        scene_.triangles.push_back({.vertex = {first, first + 1, first + 2}});
    }

    Scene build()
    {
        Group& group = scene_.groups.back();
        group.triangles = static_cast<std::uint32_t>(scene_.triangles.size());
        group.vertices = static_cast<std::uint32_t>(scene_.positions.size());
        const auto last = static_cast<std::uint32_t>(scene_.groups.size() - 1);
        scene_.parts.push_back({.node = group.node, .group = last, .count = group.triangles});
        scene_.part_of_primitive.assign(group.triangles, 0);
        return std::move(scene_);
    }

private:
    Scene scene_;
};

/// Halves of squares, one behind the other.
Scene stack(int triangles, bool moves)
{
    Builder builder(moves);
    for (int i = 0; i < triangles; ++i) {
        const double z = 0.01 * i;
        builder.add({-1, -1, z}, {1, -1, z}, {-1, 1, z});
    }
    return builder.build();
}

/// A surface of small triangles that is not flat.
Scene hills(int along)
{
    Builder builder(false);
    const auto point = [](int x, int y) { return glm::dvec3(x, y, 3.0 * std::sin(0.5 * x) * std::cos(0.4 * y)); };
    for (int x = 0; x < along; ++x)
        for (int y = 0; y < along; ++y) {
            builder.add(point(x, y), point(x + 1, y), point(x, y + 1));
            builder.add(point(x + 1, y), point(x + 1, y + 1), point(x, y + 1));
        }
    return builder.build();
}

/// Rays through the other halves of a stack's squares: into every box, past every triangle.
std::unique_ptr<RayTile<float>> rays_through(double x)
{
    auto tile = std::make_unique<RayTile<float>>();
    tile->count = rays;
    for (int i = 0; i < rays; ++i) {
        tile->set_origin(i, {static_cast<float>(x), 0.3f + 0.01f * static_cast<float>(i), -5.0f});
        tile->set_direction(i, {0.0f, 0.0f, 1.0f});
        tile->set_interval(i, 0.0f);
    }
    return tile;
}

template <typename Work>
double nanoseconds(const Work& work)
{
    using Clock = std::chrono::steady_clock;
    double best = INFINITY;
    for (int i = 0; i < repeats; ++i) {
        const Clock::time_point start = Clock::now();
        work();
        best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
    return best;
}

/// What a ray takes in a scene under a rule, ns.
double per_ray(const Scene& scene, const Rule& rule, double x = 0.5)
{
    const Pose now = pose(scene, 0.0);
    const auto strategy = make_lazy<float>(scene, {}, {.rule = rule});
    strategy->update(now);
    const auto tile = rays_through(x);
    strategy->closest(*tile);  // has built what is to be built
    return nanoseconds([&] { strategy->closest(*tile); }) / rays;
}

void measure_groups(Costs& costs)
{
    const Scene small = stack(few, true), large = stack(many, true);
    Rule lists{.choice = ListOrGrid::always_list}, grids{.choice = ListOrGrid::always_grid};
    lists.costs.carrying = least_cost;
    costs.test = (per_ray(large, lists) - per_ray(small, lists)) / (many - few);
    lists.costs.carrying = INFINITY;  // nothing is carried
    costs.test_alone = (per_ray(large, lists) - per_ray(small, lists)) / (many - few);
    const double past = per_ray(small, grids, 5.0), one_pack = per_ray(small, grids);
    costs.pack = (per_ray(large, grids) - one_pack) / (many / pack_size);  // one fewer pack, but a block of boxes
    costs.entry = one_pack - past - costs.pack;
}

/// What it takes to build all voxels of a grid.
double build_all(const GridEntries& entries, const GridOptions& options, double& voxels, double& listed)
{
    double best = INFINITY;
    for (int i = 0; i < repeats; ++i) {
        Ledger ledger(0);
        const LazyGrid grid(entries, options, ledger, nullptr);
        voxels = listed = 0.0;
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        for (std::uint32_t cell = 0; cell < grid.top().cells.size(); ++cell) {
            if (grid.listed(cell).empty()) continue;
            grid.voxel(cell);
            listed += static_cast<double>(grid.listed(cell).size());
            ++voxels;
        }
        best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
    return best;
}

void measure_builds(Costs& costs)
{
    const Scene scene = hills(16);
    const auto n = static_cast<double>(scene.triangles.size());
    const Pose now = pose(scene, 0.0);
    RootGeometry<float> geometry(scene);
    geometry.update_on_touch(now);
    geometry.touch(0);
    const double only_made = nanoseconds([&] { RootGeometry<float> another(scene); });
    const double carried_too = nanoseconds([&] {
        RootGeometry<float> another(scene);
        another.update_on_touch(now);
        another.touch(0);
    });
    costs.carrying = (carried_too - only_made) / n;
    PrimitiveList primitives;
    geometry.list(0, primitives);
    costs.packing = nanoseconds([&] { make_flat_list(geometry, primitives); }) / n;
    Ledger ledger(0);
    costs.listing =
        nanoseconds([&] { const LazyGrid grid(make_entries(geometry, primitives, nullptr), {}, ledger, nullptr); }) / n;
    const GridEntries entries = make_entries(geometry, primitives, nullptr);
    double crowds, in_crowds, crumbs, in_crumbs;
    const double crowded = build_all(entries, {.density = 0.02f}, crowds, in_crowds),
                 crumbled = build_all(entries, {.density = 1.0f}, crumbs, in_crumbs);
    costs.making = (crumbled * in_crowds - crowded * in_crumbs) / (crumbs * in_crowds - crowds * in_crumbs);
    costs.building = (crowded - crowds * costs.making) / in_crowds;
}

}  // namespace

Costs calibrate()
{
    Costs costs;
    measure_groups(costs);
    measure_builds(costs);
    for (const CostName& name : cost_names()) costs.*name.cost = std::max(costs.*name.cost, least_cost);
    return costs;
}

const Costs& calibrated_costs()
{
    static const Costs costs = calibrate();
    return costs;
}

}  // namespace firstray::inline v0::lazy
