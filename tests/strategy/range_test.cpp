// What is very large and very far, up to the ends of the range of coordinates.
#include <doctest/doctest.h>

#include "bench/strategies.h"
#include "tests/support/compare_hits.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// Gives all strategies of ours to `check`.
template <typename Check>
void with_each(const Scene& scene, const Pose& now, const Check& check)
{
    for (const StrategyEntry& entry : strategies()) {
        if (entry.peer) continue;
        CAPTURE(entry.name);
        const auto strategy = entry.make(scene, {});
        strategy->update(now);
        check(*strategy);
    }
}

/// Checks that all strategies of ours find what the list finds.
void check_agreement(const Scene& scene, const Pose& now, const std::vector<TestRay>& rays, int& hits)
{
    const auto list = find_strategy("list")->make(scene, {});
    list->update(now);
    const Expected<float> expected(*list, rays);
    with_each(scene, now, [&](const Strategy<float>& strategy) { CHECK(expected.differences(strategy, hits) == 0); });
}

}  // namespace

TEST_CASE("rays from up to 5e17 away find what the list finds, in boxes too")
{
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        const Scene scene = moving_scene(seed);
        const Pose now = pose(scene, 3.0);
        const Scene targets = targets_of(now);
        Random random(seed);
        const glm::dvec3 apex = glm::vec3(random.in_cube(1.0) * 3e16);
        std::vector<TestRay> rays;
        for (int i = 0; i < 512; ++i) {
            const auto target = random.below(static_cast<std::uint32_t>(targets.positions.size()));
            const glm::dvec3 from = targets.positions[target] + random.in_cube(1.0) * std::exp2(random.between(10, 58));
            rays.push_back({seed % 2 ? glm::dvec3(glm::vec3(from)) : apex, {}});
            rays.back().direction = targets.positions[target] - rays.back().origin;
            if (seed % 2 && i % 5 == 0) {  // along an axis the place where it arrives is known
                const int axis = i % 3;
                rays.back() = {targets.positions[target], {}};
                rays.back().direction[axis] = i % 2 ? 1.0 : -1.0;
                rays.back().origin[axis] = -rays.back().direction[axis] * std::exp2(30 + i % 29);
            }
        }
        check_agreement(scene, now, rays, hits);
    }
    CHECK(hits > 4000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("a scene of 1e13 is hit as the list says, by single rays and from common apexes")
{
    int hits = 0;
    Scene scene = random_scene(8, 1200);
    for (glm::dvec3& p : scene.positions) p *= 0x1p40;
    const Pose now = pose(scene, 0.0);
    check_agreement(scene, now, awkward_rays(1, scene, 1024), hits);
    for (const std::uint64_t seed : {2u, 3u})
        check_agreement(scene, now, rays_from(seed, scene, scene.positions[seed], 1024), hits);
    CHECK(hits > 5000);
}

TEST_CASE("rays that start beyond 1e18 meet nothing, nor are there triangles")
{
    SmallScene small;
    small.triangle({}, {-1, -1, -5}, {1, -1, -5}, {0, 1, -5});
    small.triangle({}, {-1, -1, -4}, {1, -1, -4}, {0, 1e19, -4});
    const Scene scene = small.build();
    const Pose now = pose(scene, 0.0);
    std::vector<TestRay> rays = {
        {{0, 0, 0.9e18}, {0, 0, -1}}, {{0, 0, 1.1e18}, {0, 0, -1}}, {{0, 0, 3e38}, {0, 0, -1}}};
    for (int i = 0; i < 64; ++i) rays.push_back({{0, 0, 3e38}, {0.001 * i, 0, -1}});
    with_each(scene, now, [&](const Strategy<float>& strategy) {
        const auto single = make_tile<float>(rays, 0), near = make_tile<float>({{{0, 0, 0}, {0, 0, -1}}}, 0);
        CHECK_FALSE(single->common_apex);
        const auto apex = make_tile<float>(rays, 2);
        CHECK(apex->common_apex);
        strategy.closest(*single);
        strategy.closest(*apex);
        strategy.closest(*near);
        CHECK(single->primitive[0] == 0);
        CHECK(near->primitive[0] == 0);
        for (std::size_t i = 1; i < rays.size(); ++i) CHECK(single->primitive[i] == no_primitive);
        for (std::size_t i = 0; i < static_cast<std::size_t>(apex->count); ++i)
            CHECK(apex->primitive[i] == no_primitive);
    });
}
