#include "lazy/lazy.h"

#include <doctest/doctest.h>

#include <atomic>

#include "engine/strategy/list.h"
#include "tests/lazy/lazy_world.h"
#include "tests/support/crew.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// A scene, rays in it, and the hits that testing all primitives finds.
struct Exam {
    Scene scene;
    std::vector<TestRay> rays;
    StrategyOptions options{.grid_density = 1.0f, .max_list = 8};

    explicit Exam(std::uint64_t seed, int movers = 4)
        : scene(scene_with_movers(seed, 600, movers, 100)),
          rays(seed % 2 == 0 ? awkward_rays(seed, scene, 600) : rays_from(2 * seed, scene, {1, 2, 30}, 600))
    {
    }
    std::unique_ptr<RayTile<float>> truth(const Pose& now) const
    {
        const auto list = make_list<float>(scene, options);
        list->update(now);
        return hits(*list);
    }
    std::unique_ptr<RayTile<float>> hits(const Strategy<float>& strategy) const
    {
        auto tile = make_tile<float>(rays, 0);
        strategy.closest(*tile);
        return tile;
    }
    /// The scene, the given groups elsewhere.
    Pose moved(const std::vector<std::uint32_t>& groups, double by) const
    {
        Pose result = pose(scene, 0.0);
        for (const std::uint32_t group : groups) {
            Transform& place = result.root_from_node[scene.groups[group].node];
            place.linear = rotation_about({0, 1, 0}, by);
            place.offset += glm::dvec3(by, -by, 0.5 * by);
        }
        return result;
    }
};

}  // namespace

TEST_CASE("lazy: an update builds no voxel, rays do, and the same frame again costs nothing")
{
    const Exam exam(1);
    const Pose now = exam.moved({}, 0.0), same = exam.moved({}, 0.0);
    const auto lazy = lazy::make_lazy<float>(exam.scene, exam.options);
    lazy->update(now);
    StructureReport report = lazy->report();
    CHECK(report.built_voxels == 0);
    CHECK(report.grids == 1);  // the scenery's: of what moves there is none
    CHECK(report.lazy_build_ms == 0.0);
    CHECK(report.filled_voxels > 100);

    const auto expected = exam.truth(now);
    CHECK(differing_hits(*expected, *exam.hits(*lazy)) == 0);
    report = lazy->report();
    const std::uint64_t built = report.built_voxels, grids = report.grids, bytes = report.bytes;
    CHECK(built > 100);
    CHECK(built < report.filled_voxels);
    CHECK(report.kept_voxels == 0);
    CHECK(report.lazy_build_ms > 0.0);

    lazy->update(same);
    CHECK(differing_hits(*expected, *exam.hits(*lazy)) == 0);
    report = lazy->report();
    CHECK(report.kept_voxels == built);
    CHECK(report.built_voxels == built);
    CHECK(report.dropped_voxels == 0);
    CHECK(report.regridded == 0);
    CHECK(report.grids == grids);
    CHECK(report.bytes == bytes);
    CHECK(report.lazy_build_ms == 0.0);
    MESSAGE("600 rays: " << built << " of " << report.filled_voxels << " voxels built, all kept");
}

TEST_CASE("lazy: what moved loses its voxels, what stands keeps them")
{
    const Exam exam(2, 6);
    const auto lazy = lazy::make_lazy<float>(exam.scene, exam.options);
    std::vector<Pose> poses;  // they live until the next update
    poses.reserve(8);
    const auto frame = [&](const std::vector<std::uint32_t>& groups, double by, std::uint64_t moved) {
        poses.push_back(exam.moved(groups, by));
        lazy->update(poses.back());
        const StructureReport before_rays = lazy->report();
        CHECK(before_rays.built_voxels == before_rays.kept_voxels);
        CHECK(before_rays.grids == 7 - moved);
        CHECK(differing_hits(*exam.truth(poses.back()), *exam.hits(*lazy)) == 0);
        return lazy->report();
    };
    const StructureReport first = frame({}, 0.0, 6);
    CHECK(first.grids == 7);

    const StructureReport second = frame({3}, 0.1, 1);
    CHECK(second.dropped_voxels > 0);
    CHECK(second.kept_voxels == first.built_voxels - second.dropped_voxels);
    CHECK(second.built_voxels > second.kept_voxels);

    const StructureReport third = frame({3, 5}, 0.1, 1);  // 3 stays where it was
    CHECK(third.dropped_voxels > 0);
    CHECK(third.kept_voxels == second.built_voxels - third.dropped_voxels);

    const StructureReport all = frame({1, 2, 3, 4, 5, 6}, 0.2, 6);
    CHECK(all.kept_voxels > 0);  // the scenery's
    CHECK(all.dropped_voxels > third.dropped_voxels);
    CHECK(all.kept_voxels == third.built_voxels - all.dropped_voxels);

    const StructureReport again = frame({1, 2, 3, 4, 5, 6}, 0.2, 0);
    CHECK(again.dropped_voxels == 0);
    CHECK(again.kept_voxels == all.built_voxels);
    CHECK(again.built_voxels == all.built_voxels);
}

TEST_CASE("lazy: what is hidden is given up and comes back")
{
    const Exam exam(3, 3);
    const auto lazy = lazy::make_lazy<float>(exam.scene, exam.options);
    const Pose shown = exam.moved({}, 0.0);
    Pose hidden = shown;
    hidden.visible[exam.scene.groups[2].node] = 0;
    lazy->update(shown);
    const auto expected = exam.hits(*lazy);
    const StructureReport before = lazy->report();
    lazy->update(hidden);
    CHECK(differing_hits(*exam.truth(hidden), *exam.hits(*lazy)) == 0);
    CHECK(lazy->report().dropped_voxels > 0);
    CHECK(lazy->report().grids == before.grids - 1);
    lazy->update(shown);
    CHECK(differing_hits(*expected, *exam.hits(*lazy)) == 0);
    CHECK(lazy->report().grids == before.grids);
}

TEST_CASE("lazy: with no bytes to spend nothing is built, and hits are the same")
{
    const Exam exam(4);
    const Pose now = exam.moved({1, 2}, 0.3);
    const auto expected = exam.truth(now);
    const auto with_budget = [&](std::uint64_t bytes) {
        StrategyOptions options = exam.options;
        options.structure_budget = bytes;
        return lazy::make_lazy<float>(exam.scene, options);
    };
    const auto lazy = with_budget(1);
    for (int frame = 0; frame < 2; ++frame) {
        lazy->update(now);
        CHECK(lazy->report().refused_builds == 0);
        CHECK(differing_hits(*expected, *exam.hits(*lazy)) == 0);
        const StructureReport report = lazy->report();
        CHECK(report.refused_builds > 100);  // asked for again in every frame
        CHECK(report.built_voxels == 0);
        CHECK(report.grids == 1);
    }

    const auto some = with_budget(100000);
    const auto all = lazy::make_lazy<float>(exam.scene, exam.options);
    some->update(now);
    all->update(now);
    CHECK(differing_hits(*expected, *exam.hits(*some)) == 0);
    CHECK(differing_hits(*expected, *exam.hits(*all)) == 0);
    CHECK(some->report().refused_builds > 0);
    CHECK(some->report().built_voxels > 0);
    CHECK(some->report().built_voxels < all->report().built_voxels);
}

TEST_CASE("lazy: many threads find what one finds, frame by frame")
{
    constexpr int threads = 16, frames = 6;
    const Exam exam(5);
    const auto lazy = lazy::make_lazy<float>(exam.scene, exam.options);
    const auto alone = lazy::make_lazy<float>(exam.scene, exam.options);
    std::vector<Pose> poses;
    for (int frame = 0; frame < frames; ++frame)
        poses.push_back(exam.moved({1, static_cast<std::uint32_t>(2 + frame % 3)}, 0.1 * frame));
    for (const Pose& now : poses) {
        lazy->update(now);
        alone->update(now);
        const auto expected = exam.hits(*alone);
        std::atomic<int> different{0};
        Crew(threads).run([&](int) { different += differing_hits(*expected, *exam.hits(*lazy)); });
        CHECK(different == 0);
        CHECK(lazy->report().built_voxels <= alone->report().built_voxels);  // who tests lists may end sooner
    }
    MESSAGE(frames << " frames, " << threads << " threads, " << exam.rays.size() << " rays each");
}

TEST_CASE("lazy: with every primitive in a top grid the hits are the same, and what stands stays")
{
    const Exam exam(6);
    StructureReport before;
    const auto lazy = lazy::make_lazy<float>(exam.scene, exam.options, {.top = lazy::LazyTop::primitives});
    for (const double step : {0.0, 0.1, 0.1, 0.2}) {
        CAPTURE(step);
        const Pose now = exam.moved({1}, step);
        before = lazy->report();
        lazy->update(now);
        const StructureReport after = lazy->report();
        CHECK(after.kept_voxels + after.dropped_voxels == before.built_voxels);
        if (before.built_voxels > 0 && step == 0.2) {
            CHECK(after.dropped_voxels > 0);
            CHECK(after.kept_voxels > before.built_voxels / 2);  // where group 1 neither was nor is
        }
        CHECK(differing_hits(*exam.truth(now), *exam.hits(*lazy)) == 0);
        CHECK(lazy->report().built_voxels > 0);
    }
    const Pose now = exam.moved({1}, 0.2);
    before = lazy->report();
    lazy->update(now);
    CHECK(lazy->report().dropped_voxels == 0);
    CHECK(lazy->report().kept_voxels == before.built_voxels);
    CHECK(differing_hits(*exam.truth(now), *exam.hits(*lazy)) == 0);
}
