#include <doctest/doctest.h>

#include <algorithm>

#include "bench/strategies.h"
#include "engine/aff/reader.h"
#include "engine/scene/pose.h"
#include "tests/support/compare_hits.h"

using namespace firstray;

namespace {

constexpr const char* names[] = {"everything", "primitives", "tracks", "orrery"};

Scene hand_written(const std::string& name)
{
    return read_aff("scenes/" + name + ".aff");  // tests run in the project's folder
}

/// From the eye and from anywhere towards where the things stand; all of them are within 6 of the middle.
std::vector<test::TestRay> rays_at(const Pose& now)
{
    test::Random random(4);
    std::vector<test::TestRay> rays;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 from = i % 2 ? now.camera.eye : random.in_cube(9.0);
        const glm::dvec3 to(random.between(-5.0, 5.0), random.between(-0.5, 2.5), random.between(-3.0, 4.0));
        rays.push_back({from, to - from});
    }
    return rays;
}

}  // namespace

TEST_CASE("all strategies agree about the scenes written by hand")
{
    for (const char* name : names) {
        CAPTURE(name);
        const Scene scene = hand_written(name);
        int hits = 0;
        for (const double part : {0.0, 0.3, 0.8}) {
            const Pose now = pose(scene, scene.start + part * (scene.end - scene.start));
            const std::vector<test::TestRay> rays = rays_at(now);
            const auto list = find_strategy("list")->make(scene, {});
            list->update(now);
            const test::Expected<float> expected(*list, rays);
            for (const StrategyEntry& other : strategies()) {
                if (other.peer || other.name == "list") continue;
                CAPTURE(other.name);
                const auto strategy = other.make(scene, {});
                strategy->update(now);
                CHECK(expected.differences(*strategy, hits) == 0);
            }
        }
        CHECK(hits > 300);
    }
}

TEST_CASE("the scenes written by hand show what their notes say")
{
    const Scene primitives = hand_written("primitives");
    for (const char* statement : {"s", "c", "p", "pp", "tt", "ttp", "m", "tpa"}) {
        CAPTURE(statement);
        CHECK(primitives.census.count(statement) > 0);
    }
    const Scene tracks = hand_written("tracks");
    bool translates = false, turns = false, scales = false, blinks = false;
    for (const Animation& a : tracks.animations) {
        translates = translates || !a.translation.empty();
        turns = turns || !a.rotation.empty();
        scales = scales || !a.scale.empty();
        blinks = blinks || !a.visibility.empty();
    }
    CHECK((translates && turns && scales && blinks));
    const Scene orrery = hand_written("orrery");
    std::vector<int> depth(orrery.nodes.size(), 0);
    for (std::size_t i = 1; i < depth.size(); ++i) depth[i] = depth[orrery.nodes[i].parent] + 1;
    CHECK(*std::max_element(depth.begin(), depth.end()) >= 3);
    CHECK(orrery.animations.size() == 7);
}
