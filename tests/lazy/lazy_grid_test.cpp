#include "lazy/lazy_grid.h"

#include <doctest/doctest.h>

#include <atomic>
#include <barrier>

#include "engine/primitive/triangle.h"
#include "engine/strategy/list.h"
#include "tests/lazy/lazy_world.h"
#include "tests/support/crew.h"

using namespace firstray;
using namespace firstray::test;

namespace {

constexpr GridOptions fine = {.density = 1.0f, .subdensity = 0.5f, .max_list = 8};

/// Whether a line, between two ts, passes through a cell that is made wider (narrower: negative) on all sides.
bool passes(const Grid& grid, std::uint32_t cell, const TestRay& ray, double begin, double end, const glm::dvec3& wider)
{
    const auto i = static_cast<std::int32_t>(cell), row = grid.dims.x, layer = row * grid.dims.y;
    const glm::dvec3 place(i % row, i % layer / row, i / layer);
    const glm::dvec3 lo = glm::dvec3(grid.lo) + place * glm::dvec3(grid.cell) - wider,
                     hi = lo + glm::dvec3(grid.cell) + 2.0 * wider;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = ray.origin[axis], d = ray.direction[axis];
        if (d == 0.0) {
            if (o < lo[axis] || o > hi[axis]) return false;
            continue;
        }
        const double a = (lo[axis] - o) / d, b = (hi[axis] - o) / d;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end;
}

/// How a ray's voxels compare with those that a walk in double finds.
struct Walked {
    std::uint64_t missing = 0;   ///< entered by more than a ten-thousandth of a cell, and not built
    std::uint64_t needless = 0;  ///< built, and not even touched
    std::uint64_t entered = 0, doubtful = 0;

    /// ray  rounded to float
    /// end  where the ray ends: at its hit
    void add(const lazy::LazyGrid& lazy, const TestRay& ray, double end)
    {
        const Grid& grid = lazy.top().grids[0];
        const double longest =
            std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
        const double pad = 4.0 * static_cast<double>(lazy.top().pad), t_pad = pad / longest;
        const double slack = static_cast<double>(t_slack);  // a hit's t is off by this part of it
        const glm::dvec3 margin = 1e-4 * glm::dvec3(grid.cell);
        for (std::uint32_t cell = 0; cell < grid.cells(); ++cell) {
            if (lazy.listed(cell).empty()) continue;
            const bool must = passes(grid, cell, ray, ray.t_min, end - t_pad, -margin);
            const bool may = passes(grid, cell, ray, ray.t_min - std::abs(ray.t_min) * slack - t_pad,
                                    end + std::abs(end) * slack + t_pad, glm::dvec3(pad));
            const bool is_built = lazy.built(cell) != nullptr;
            missing += must && !is_built;
            needless += is_built && !may;
            entered += must;
            doubtful += may && !must;
        }
    }
};

TestRay rounded(const TestRay& ray)
{
    return {glm::vec3(ray.origin), glm::vec3(ray.direction), static_cast<float>(ray.t_min),
            static_cast<float>(ray.t_max)};
}

std::uint64_t built_voxels(const LazyWorld& world)
{
    return world.scenery.counts().built;
}

/// Has every voxel built.
void enter_all(const lazy::LazyGrid& grid)
{
    for (std::uint32_t cell = 0; cell < grid.top().cells.size(); ++cell)
        if (!grid.listed(cell).empty()) grid.voxel(cell);
}

}  // namespace

TEST_CASE("without a ray no voxel is built")
{
    const Scene scene = scene_with_movers(1, 500, 3, 50);
    const Pose now = pose(scene, 0.0);
    lazy::Ledger ledger(0);
    const LazyWorld world(scene, now, fine, ledger);
    CHECK(world.scenery.counts().filled > 50);
    CHECK(world.built() == 0);
    CHECK(ledger.built() == 0);
    CHECK(ledger.bytes() == 0);
    const auto tile = make_tile<float>({{{1e6, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}}, 0);
    world.closest(*tile);
    CHECK(world.built() == 0);
}

TEST_CASE("one ray builds the filled voxels that it enters before its hit, and no others")
{
    Walked walked;
    int rays = 0, hits = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        const Scene scene = random_scene(seed, 300);
        const Pose now = pose(scene, 0.0);
        for (const TestRay& exact : awkward_rays(seed, scene, 60)) {
            const TestRay ray = rounded(exact);
            lazy::Ledger ledger(0);
            const LazyWorld world(scene, now, fine, ledger);
            const auto tile = make_tile<float>({ray}, 0);
            world.closest(*tile);
            walked.add(world.scenery, ray, static_cast<double>(tile->t_max[0]));
            CHECK(ledger.built() == built_voxels(world));
            hits += tile->primitive[0] != no_primitive;
            ++rays;
        }
    }
    CHECK(walked.missing == 0);
    CHECK(walked.needless == 0);
    CHECK(walked.entered > 1000);
    CHECK(walked.doubtful < walked.entered / 4);
    CHECK(hits > 100);
    MESSAGE(rays << " rays, " << hits << " hits: " << walked.entered << " voxels entered and built, " << walked.doubtful
                 << " touched within the pad");
}

TEST_CASE("a ray that looks for any hit builds nothing behind the nearest")
{
    Walked walked;
    int rays = 0;
    const Scene scene = random_scene(21, 400);
    const Pose now = pose(scene, 0.0);
    for (const TestRay& exact : awkward_rays(22, scene, 200)) {
        const TestRay ray = rounded(exact);
        lazy::Ledger ledger(0);
        const LazyWorld world(scene, now, fine, ledger);
        const auto any = make_tile<float>({ray}, 0), nearest = make_tile<float>({ray}, 0);
        world.occluded(*any);
        const std::uint64_t built = ledger.built();
        lazy::Ledger other(0);
        const LazyWorld again(scene, now, fine, other);
        again.closest(*nearest);
        walked.add(world.scenery, ray, static_cast<double>(nearest->t_max[0]));
        CHECK(built <= other.built());
        ++rays;
    }
    CHECK(walked.needless == 0);
    MESSAGE(rays << " rays, " << walked.missing << " of " << walked.entered << " voxels spared by ending early");
}

TEST_CASE("the same ray again builds nothing")
{
    const Scene scene = scene_with_movers(5, 800, 4, 100);
    const Pose now = pose(scene, 0.0);
    lazy::Ledger ledger(0);
    const LazyWorld world(scene, now, fine, ledger);
    const std::vector<TestRay> rays = awkward_rays(6, scene, 200);
    const auto first = make_tile<float>(rays, 0), second = make_tile<float>(rays, 0), any = make_tile<float>(rays, 0);
    world.closest(*first);
    const std::uint64_t built = ledger.built(), bytes = ledger.bytes();
    CHECK(built > 100);
    CHECK(built == world.built());
    world.closest(*second);
    world.occluded(*any);
    CHECK(ledger.built() == built);
    CHECK(ledger.bytes() == bytes);
    CHECK(differing_hits(*first, *second) == 0);
}

TEST_CASE("a ray that is stopped short builds nothing behind its end")
{
    SmallScene small;
    Random random(8);
    for (int i = 0; i < 500; ++i) {  // crowds at both ends, a wall between them
        const glm::dvec3 a = random.in_cube(1.0) + glm::dvec3(0, 0, i % 2 ? 10 : -10);
        small.triangle(Material{}, a, a + random.in_cube(0.2), a + random.in_cube(0.2));
    }
    const Scene open = small.build();
    small.quad(Material{}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Scene walled = small.build();
    const auto built_behind = [&](const Scene& scene, double t_max) {
        const Pose now = pose(scene, 0.0);
        lazy::Ledger ledger(0);
        const LazyWorld world(scene, now, fine, ledger);
        std::vector<TestRay> rays;
        Random places(9);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 from = places.in_cube(0.9);
            rays.push_back({{from.x, from.y, -8.0}, {0, 0, 1}, 0.0, t_max});
        }
        const auto tile = make_tile<float>(rays, 0);
        world.closest(*tile);
        const Grid& grid = world.scenery.top().grids[0];
        std::uint64_t behind = 0;
        for (std::uint32_t cell = 0; cell < grid.cells(); ++cell) {
            const auto layer = static_cast<float>(cell / static_cast<std::uint32_t>(grid.dims.x * grid.dims.y));
            behind += world.scenery.built(cell) != nullptr && grid.lo.z + layer * grid.cell.z > 5.0f;
        }
        return behind;
    };
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(built_behind(open, infinity) > 20);
    CHECK(built_behind(open, 10.0) == 0);
    CHECK(built_behind(walled, infinity) == 0);
}

TEST_CASE("a voxel gets a subgrid where its list is longer than the limit, and grids are no deeper than theirs")
{
    const Scene scene = random_scene(31, 1500);
    const Pose now = pose(scene, 0.0);
    std::uint64_t subgrids = 0, plain = 0;
    for (const int max_list : {1, 8, 60, 100000})
        for (const int depth : {1, 2, 3}) {
            CAPTURE(max_list);
            CAPTURE(depth);
            const GridOptions options = {.density = 0.05f, .subdensity = 0.5f, .max_list = max_list, .depth = depth};
            lazy::Ledger ledger(0);
            const LazyWorld world(scene, now, options, ledger);
            enter_all(world.scenery);
            std::uint64_t references = 0, inner = 0;
            for (std::uint32_t cell = 0; cell < world.scenery.top().cells.size(); ++cell) {
                const GridStructure* const built = world.scenery.built(cell);
                const std::size_t listed = world.scenery.listed(cell).size();
                CHECK((built != nullptr) == (listed > 0));
                if (!built) continue;
                references += built->references;
                const bool is_grid = built->cells.size() > 1;
                inner += is_grid ? built->grids.size() : 0;
                ++(is_grid ? subgrids : plain);
                if (is_grid) CHECK(listed > static_cast<std::size_t>(max_list));
                if (is_grid) CHECK(static_cast<int>(built->depth) + 1 <= depth);
                if (!is_grid) CHECK(built->references == listed);
            }
            // once all is entered, all is as if it had been built at once
            PrimitiveList primitives;
            world.geometry.list(0, primitives);
            std::uint64_t peak = 0;
            const GridStructure whole =
                build_grid(make_entries(world.geometry, primitives, nullptr), options, nullptr, peak);
            CHECK(references == whole.references);
            CHECK(inner + 1 == whole.grids.size());
        }
    CHECK(subgrids > 100);
    CHECK(plain > 100);
    MESSAGE("12 shapes: " << subgrids << " subgrids, " << plain << " voxels without");
}

TEST_CASE("where there is no memory to build, lists are searched for the same hits, and every bit of memory comes back")
{
    const Scene scene = scene_with_movers(41, 600, 3, 80);
    const Pose now = pose(scene, 0.0);
    const std::vector<TestRay> rays = awkward_rays(42, scene, 500);
    const auto expected = make_tile<float>(rays, 0);
    const auto list = make_list<float>(scene, {});
    list->update(now);
    list->closest(*expected);
    std::uint64_t last_built = 0;
    for (const std::uint64_t limit : {1ull, 20000ull, 60000ull, 200000ull, 0ull}) {
        CAPTURE(limit);
        lazy::Ledger ledger(limit);
        {
            const LazyWorld world(scene, now, fine, ledger);
            const auto tile = make_tile<float>(rays, 0);
            world.closest(*tile);
            CHECK(differing_hits(*expected, *tile) == 0);
            CHECK((ledger.refused() > 0) == (limit != 0));
            CHECK(world.built() == ledger.built());
            if (limit == 1) CHECK((ledger.built() == 0 && ledger.bytes() == 0));
            CHECK(ledger.built() >= last_built);
            last_built = ledger.built();
        }
        CHECK(ledger.bytes() == 0);
    }
    CHECK(last_built > 100);
}

TEST_CASE("nothing of a group is made before a ray meets its box, and only what moved is made anew")
{
    const int movers = 30;
    const Scene scene = scene_with_movers(51, 300, movers, 60);
    Pose first = pose(scene, 0.0);
    for (std::size_t node = 1; node < first.root_from_node.size(); ++node)
        first.root_from_node[node].offset = {50.0 * static_cast<double>(node), 0, 0};
    Pose second = first;
    second.root_from_node[2].offset.x += 0.25;
    second.root_from_node[7].linear = rotation_about({0, 0, 1}, 0.5);

    lazy::Ledger ledger(0);
    {
        LazyWorld world(scene, first, fine, ledger);
        std::vector<TestRay> rays;
        Random random(52);
        for (int group = 1; group <= movers; group += group < 10 ? 1 : 3)
            for (int i = 0; i < 40; ++i)
                rays.push_back({random.in_cube(6.0) + glm::dvec3(50.0 * group, 0, -100), {0.01, 0, 1}});
        const auto one = make_tile<float>(rays, 0), two = make_tile<float>(rays, 0), three = make_tile<float>(rays, 0);
        world.closest(*one);
        for (std::uint32_t group = 1; group <= movers; ++group) {
            CAPTURE(group);
            CHECK((world.groups.made(group) != nullptr) == (group < 10 || group % 3 == 1));
        }
        const std::uint64_t scenery = built_voxels(world), all = world.built();
        const std::uint64_t in_2 = world.groups.made(2)->counts().built, in_7 = world.groups.made(7)->counts().built;
        CHECK(in_2 + in_7 > 5);

        ledger.begin_frame();
        world.update(first);  // nothing has moved
        world.closest(*two);
        CHECK(ledger.built() == 0);
        CHECK(differing_hits(*one, *two) == 0);

        world.update(second);
        CHECK(world.groups.made(2) == nullptr);
        CHECK(world.groups.made(7) == nullptr);
        CHECK(world.built() == all - in_2 - in_7 - 2);
        world.closest(*three);
        CHECK(built_voxels(world) == scenery);
        CHECK(world.groups.made(2) != nullptr);
        CHECK(world.groups.made(7) != nullptr);
        CHECK(ledger.built() == world.built() - (all - in_2 - in_7 - 2));

        const auto expected = make_tile<float>(rays, 0);
        const auto list = make_list<float>(scene, {});
        list->update(second);
        list->closest(*expected);
        CHECK(differing_hits(*expected, *three) == 0);
    }
    CHECK(ledger.bytes() == 0);
}

namespace {

/// Sends many threads through small worlds at once, all with the same rays, and compares with one thread alone.
void run_threads(int threads, int scenes)
{
    struct Round {
        Scene scene;
        Pose now;
        std::vector<TestRay> rays;
        std::unique_ptr<RayTile<float>> expected;
        std::uint64_t built;
        lazy::Ledger ledger{0};
        std::unique_ptr<LazyWorld> world;
    };
    constexpr GridOptions tiny = {.density = 0.05f, .subdensity = 0.5f, .max_list = 8};  // long builds: threads meet
    const auto prepare = [&](int seed) {
        const auto s = static_cast<std::uint64_t>(seed);
        auto round = std::make_unique<Round>();
        round->scene = scene_with_movers(s, 120, 2, 60);
        round->now = pose(round->scene, 0.0);
        round->rays = awkward_rays(s, round->scene, 10);
        round->expected = make_tile<float>(round->rays, 0);
        {
            const LazyWorld alone(round->scene, round->now, tiny, round->ledger);
            alone.closest(*round->expected);
            round->built = alone.built();
        }
        round->ledger.begin_frame();
        round->world = std::make_unique<LazyWorld>(round->scene, round->now, tiny, round->ledger);
        return round;
    };
    std::unique_ptr<Round> round;
    std::barrier<> together(threads);
    std::atomic<std::uint64_t> different{0};
    std::uint64_t built = 0, built_alone = 0, wrong_builds = 0, needless = 0, bytes = 0;
    Crew(threads).run([&](int thread) {
        const auto tile = std::make_unique<RayTile<float>>();
        for (int seed = 1; seed <= scenes; ++seed) {
            if (thread == 0) round = prepare(seed);
            together.arrive_and_wait();
            *tile = *make_tile<float>(round->rays, 0);
            round->world->closest(*tile);
            different += static_cast<std::uint64_t>(differing_hits(*round->expected, *tile));
            together.arrive_and_wait();
            if (thread != 0) continue;
            built += round->world->built();
            wrong_builds += round->ledger.built() != round->world->built();
            built_alone += round->built;
            needless += round->world->built() > round->built;
            round->world.reset();
            bytes += round->ledger.bytes();
        }
    });
    CHECK(different == 0);
    CHECK(wrong_builds == 0);
    CHECK(needless == 0);
    // A thread that does without tests whole lists, finds hits sooner, and may end before a voxel that it would enter.
    CHECK(built * 100 >= built_alone * 99);
    CHECK(bytes == 0);
    CHECK(built > static_cast<std::uint64_t>(scenes) * 3);
    MESSAGE(threads << " threads, " << scenes << " scenes: " << built << " voxels and groups built, each once");
}

}  // namespace

TEST_CASE("threads that meet build each voxel once and find what one alone finds")
{
    run_threads(8, 1000);
    run_threads(64, 1000);
}

TEST_CASE("threads that meet build each voxel once, in ten thousand scenes" * doctest::skip())
{
    run_threads(2, 2000);
    run_threads(8, 4000);
    run_threads(64, 4000);
}
