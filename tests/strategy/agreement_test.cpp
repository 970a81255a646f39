#include <doctest/doctest.h>

#include "bench/strategies.h"
#include "engine/core/simd.h"
#include "tests/support/compare_hits.h"
#include "tests/support/moving_scenes.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

template <typename Real>
using MakeStrategy = std::unique_ptr<Strategy<Real>> (*)(const Scene&, const StrategyOptions&);

template <typename Real>
MakeStrategy<Real> maker(const StrategyEntry& entry)
{
    if constexpr (std::is_same_v<Real, float>)
        return entry.make;
    else
        return entry.make_double;
}

/// What testing all primitives finds.
template <typename Real>
Expected<Real> expected_hits(const Scene& scene, const std::vector<TestRay>& rays, Precision precision)
{
    const Pose now = pose(scene, scene.start);
    const auto list = maker<Real>(*find_strategy("list"))(scene, {.precision = precision});
    list->update(now);
    return {*list, rays};
}

/// Checks every strategy of ours on one scene.
template <typename Real>
void check_agreement(const Scene& scene, const Expected<Real>& expected, const StrategyOptions& options, int& hits)
{
    const Pose now = pose(scene, scene.start);
    for (const StrategyEntry& entry : strategies()) {
        if (entry.peer || entry.name == "list") continue;
        CAPTURE(entry.name);
        const auto strategy = maker<Real>(entry)(scene, options);
        strategy->update(now);
        CHECK(expected.differences(*strategy, hits) == 0);
    }
}

void check_all_precisions(const Scene& scene, const std::vector<TestRay>& rays, int& hits)
{
    for (const Precision precision : {Precision::fast, Precision::robust}) {
        CAPTURE(static_cast<int>(precision));
        check_agreement(scene, expected_hits<float>(scene, rays, precision), {.precision = precision}, hits);
    }
    const auto precision = Precision::double_;
    check_agreement(scene, expected_hits<double>(scene, rays, precision), {.precision = precision}, hits);
}

}  // namespace

TEST_CASE("every strategy finds the hits that testing all primitives finds, bit for bit, in every precision")
{
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        const Scene scene =
            random_scene(seed, seed % 3 == 0 ? 30 : 1200, seed % 4 == 0 ? glm::dvec3(3e4) : glm::dvec3(0));
        check_all_precisions(scene, awkward_rays(seed, scene, 1024), hits);
    }
    CHECK(hits > 30000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("rays with a common apex find the hits that testing all primitives finds, wherever the apex is")
{
    int hits = 0;
    std::uint64_t rays_sent = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const glm::dvec3 offset(seed % 5 == 0 ? 3e4 : 0.0);
        const Scene scene = random_scene(seed, seed % 3 == 0 ? 30 : 1200, offset);
        const glm::dvec3 apexes[] = {offset, scene.positions[5], offset + random.in_cube(40.0),
                                     offset + random.in_cube(1.0) * 1e6};
        const int count = seed % 4 == 0 ? 37 : 1024;
        for (const glm::dvec3& apex : apexes) {
            CAPTURE(apex.x);
            const std::vector<TestRay> rays = rays_from(seed + 100, scene, apex, count);
            rays_sent += rays.size();
            for (const Precision precision : {Precision::fast, Precision::robust})
                check_agreement(scene, expected_hits<float>(scene, rays, precision),
                                {.precision = precision, .max_list = seed % 2 == 0 ? 20 : 0}, hits);
        }
    }
    CHECK(hits > 100000);
    MESSAGE(rays_sent << " rays, hits compared: " << hits);
}

TEST_CASE("rays with a common apex close to triangles far larger than the way to them find the same hits")
{
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        SmallScene small;
        for (int i = 0; i < 12; ++i)  // planes through the neighbourhood of the origin, and one seen edge-on
            small.quad(i % 4 == 0 ? Material{.transmittance = 0.5f} : Material{}, random.in_cube(2.0),
                       random.in_cube(900.0), random.in_cube(900.0));
        small.quad({}, {0.0, 0.0, 0.0}, {700.0, 0.0, 0.0}, {0.0, 0.0, 700.0});
        const Scene scene = small.build();
        const glm::dvec3 apex = seed % 3 == 0 ? glm::dvec3(0.0) : glm::dvec3(glm::vec3(random.in_cube(3.0)));
        const glm::dvec3 forward = random.in_cube(1.0);
        std::vector<TestRay> rays;
        for (int i = 0; i < 1024; ++i) rays.push_back({apex, forward + random.in_cube(seed % 2 == 0 ? 0.02 : 0.3)});
        for (const Precision precision : {Precision::fast, Precision::robust})
            check_agreement(scene, expected_hits<float>(scene, rays, precision), {.precision = precision}, hits);
    }
    CHECK(hits > 50000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("rays that look only for what transmits light find it among what does not, in every group, frame after frame")
{
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        const Scene scene = moving_scene(seed, {.motions = {Motion::rigid, Motion::grows, Motion::blinks}});
        std::vector<std::pair<std::string, std::unique_ptr<Strategy<float>>>> all;
        for (const StrategyEntry& entry : strategies())
            if (!entry.peer && entry.name != "list") all.emplace_back(entry.name, entry.make(scene, {}));
        for (const auto& [name, flag, word] : {std::tuple("lazy", "lazy-top", "primitives"),
                                               {"obb", "obb-groups", "all"},
                                               {"adaptive", "list-or-grid", "always-list"}})
            all.emplace_back(word, find_strategy(name)->make(scene, {.own = {{flag, word}}}));
        const auto list = find_strategy("list")->make(scene, {});
        for (const double time : {0.0, 3.0, 7.0}) {
            CAPTURE(time);
            const Pose now = pose(scene, time);
            const Scene targets = targets_of(now);
            list->update(now);
            std::vector<TestRay> rays = rays_from(seed, targets, {1, 2, 3}, 512);
            const Expected<float> beams(*list, rays), singles(*list, awkward_rays(seed, targets, 512));
            for (const auto& named : all) {
                CAPTURE(named.first);
                named.second->update(now);
                CHECK(beams.differences(*named.second, hits) == 0);
                CHECK(singles.differences(*named.second, hits) == 0);
            }
        }
    }
    CHECK(hits > 30000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("looking for what is opaque tells, by the way, which rays may pass what transmits")
{
    SmallScene small;
    small.quad({}, {-9, 0, -9}, {18, 0, 0}, {0, 0, 18});
    for (int i = 0; i < 40; ++i)  // a window of many panes
        small.quad({.transmittance = 0.5f}, {-4.0 + 0.1 * i, 3, -4}, {0.1, 0, 0}, {0, 0, 4});
    const Scene scene = small.build();
    std::vector<TestRay> beams, singles;
    for (int i = 0; i < 1024; ++i) {
        const glm::dvec3 end(-8.0 + 0.5 * (i % 32), 1, -8.0 + 0.5 * (i / 32));
        beams.push_back({{1, 9, 1}, end - glm::dvec3(1, 9, 1), 0.0, 1.0});
        singles.push_back({{1 + 1e-3 * i, 9, 1}, end - glm::dvec3(1 + 1e-3 * i, 9, 1), 0.0, 1.0});
    }
    for (const StrategyEntry& entry : strategies()) {
        if (!entry.make || entry.name == "list") continue;
        CAPTURE(entry.name);
        const auto strategy = entry.make(scene, {});
        strategy->update(pose(scene, 0.0));
        for (const auto& rays : {beams, singles}) {
            const auto any = make_tile<float>(rays, 0, RayMask::opaque),
                       met = make_tile<float>(rays, 0, RayMask::transmitting);
            std::vector<std::uint8_t> may_pass(1024, 1);
            any->may_pass = may_pass.data();
            strategy->occluded(*any);
            strategy->closest(*met);
            int wrong = 0, needless = 0, passing = 0;
            for (std::size_t i = 0; i < 1024; ++i) {
                CHECK(any->primitive[i] == no_primitive);
                const bool passes = met->primitive[i] != no_primitive;
                passing += passes;
                wrong += passes && !may_pass[i];
                needless += !passes && may_pass[i];
            }
            CHECK(wrong == 0);
            CHECK(passing > 50);
            CHECK(needless < (any->common_apex ? 150 : 15));  // packets of a beam are told together
        }
    }
}

TEST_CASE("every shape of grid finds the same hits")
{
    int hits = 0;
    const Scene scene = random_scene(77, 1500);
    const auto expected = expected_hits<float>(scene, awkward_rays(78, scene, 1024), Precision::robust);
    for (const float density : {0.001f, 0.03f, 1.0f, 8.0f})
        for (const int max_list : {1, 10, 300})
            for (const int depth : {1, 2, 4}) {
                CAPTURE(density);
                CAPTURE(max_list);
                CAPTURE(depth);
                check_agreement(scene, expected, {.grid_density = density, .max_list = max_list, .grid_depth = depth},
                                hits);
            }
    CHECK(hits > 50000);
}

TEST_CASE("every instruction set finds the same hits")
{
    const Scene scene = random_scene(5, 1500);
    const Pose now = pose(scene, 0.0);
    REQUIRE(!instruction_sets().empty());
    for (const std::vector<TestRay>& rays :
         {awkward_rays(6, scene, 1024), rays_from(6, scene, {30, 1, 2}, 1024), rays_from(7, scene, {0, 1, 2}, 1024)}) {
        std::unique_ptr<RayTile<float>> expected;
        for (const std::string& set : instruction_sets()) {
            CAPTURE(set);
            use_instruction_set(set);
            CHECK(instruction_set() == set);
            for (const StrategyEntry& entry : strategies()) {
                if (entry.peer) continue;
                CAPTURE(entry.name);
                const auto strategy = entry.make(scene, {});
                strategy->update(now);
                auto tile = make_tile<float>(rays, 0);
                strategy->closest(*tile);
                if (!expected) {
                    expected = std::move(tile);
                    continue;
                }
                int different = 0;
                for (std::size_t i = 0; i < rays.size(); ++i)
                    different += tile->primitive[i] != expected->primitive[i] || tile->t_max[i] != expected->t_max[i];
                CHECK(different == 0);
            }
        }
    }
    use_instruction_set("");
}

TEST_CASE("no ray from inside leaves a closed mesh, wherever it stands")
{
    Random random(3);
    for (const double offset : {0.0, 1e3, 2.7e5}) {
        CAPTURE(offset);
        const Scene scene = sphere_mesh(16, 100.0, glm::dvec3(offset, -offset * 0.5, offset * 0.25));
        const Pose now = pose(scene, 0.0);
        const glm::dvec3 centre = (scene.positions[0] + scene.positions[1]) * 0.5;
        std::vector<TestRay> rays;
        for (int i = 0; i < 20480; ++i) {
            const TriangleIndices& t =
                scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))];
            const glm::dvec3 a(glm::vec3(scene.positions[t.vertex.x])), b(glm::vec3(scene.positions[t.vertex.y]));
            const glm::dvec3 from = glm::vec3(centre + random.in_cube(40.0));
            rays.push_back({from, (i % 2 ? a : glm::mix(a, b, random.unit())) - from});
        }
        for (const StrategyEntry& entry : strategies()) {
            if (entry.peer) continue;
            CAPTURE(entry.name);
            const auto strategy = entry.make(scene, {});
            strategy->update(now);
            int misses = 0;
            for (std::size_t first = 0; first < rays.size(); first += RayTile<float>::capacity) {
                const auto tile = make_tile<float>(rays, first);
                strategy->closest(*tile);
                for (int i = 0; i < tile->count; ++i)
                    misses += tile->primitive[static_cast<std::size_t>(i)] == no_primitive;
            }
            CHECK(misses == 0);
        }
    }
}

TEST_CASE("no ray from a light far away passes between the triangles of a mesh, and its hits are the list's")
{
    Random random(5);
    int hits = 0;
    const Scene scene = sphere_mesh(24, 1.0, glm::dvec3(3.0, -2.0, 1.0));
    const Pose now = pose(scene, 0.0);
    const glm::dvec3 centre = (scene.positions[0] + scene.positions[1]) * 0.5;
    for (const double distance : {1e2, 1e3, 1e4, 1e5}) {
        CAPTURE(distance);
        const glm::dvec3 light(glm::vec3(centre + distance * glm::normalize(random.in_cube(1.0))));
        const glm::dvec3 towards = glm::normalize(light - centre);
        std::vector<TestRay> rays;
        while (rays.size() < 4096) {
            const TriangleIndices& t =
                scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))];
            const glm::dvec3 a(glm::vec3(scene.positions[t.vertex.x])), b(glm::vec3(scene.positions[t.vertex.y]));
            const glm::dvec3 target = rays.size() % 2 == 0 ? a : glm::mix(a, b, random.unit());
            if (glm::dot(target - centre, towards) > 0.3)  // not where the mesh ends, seen from there
                rays.push_back({light, target - light, 0.0, rays.size() % 3 == 0 ? 1.01 : 1e30});
        }
        const Expected<float> expected = expected_hits<float>(scene, rays, Precision::robust);
        const int before = hits;
        check_agreement(scene, expected, {}, hits);
        const int asked = (hits - before) / static_cast<int>(rays.size());
        CHECK(hits - before == asked * static_cast<int>(rays.size()));
        CHECK(asked > 0);
    }
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("rays that are not rays meet nothing")
{
    const Scene scene = random_scene(2, 200);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const std::vector<TestRay> rays = {
        {{nan, 0, 0}, {1, 0, 0}},      {{0, 0, 0}, {0, nan, 1}},       {{infinity, 0, 0}, {-1, 0, 0}},
        {{0, 0, 0}, {infinity, 0, 0}}, {{0, 0, 0}, {0, 0, 0}},         {{0, 0, 0}, {1, 1, 1}, nan},
        {{0, 0, 0}, {1, 1, 1}, 5, 4},  {{0, 0, 0}, {1, 1, 1}, 0, nan}, {{0, 0, 0}, {-0.0, 0, -0.0}}};
    const Pose now = pose(scene, 0.0);
    for (const StrategyEntry& entry : strategies()) {
        CAPTURE(entry.name);
        const auto strategy = entry.make(scene, {});
        strategy->update(now);
        const auto tile = make_tile<float>(rays, 0), any = make_tile<float>(rays, 0);
        strategy->closest(*tile);
        strategy->occluded(*any);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            CAPTURE(i);
            CHECK(tile->primitive[i] == no_primitive);
            CHECK(any->primitive[i] == no_primitive);
        }
    }
}

TEST_CASE("an empty scene is no trouble")
{
    const Scene scene = SmallScene().build();
    const Pose now = pose(scene, 0.0);
    for (const StrategyEntry& entry : strategies()) {
        CAPTURE(entry.name);
        const auto strategy = entry.make(scene, {});
        strategy->update(now);
        const auto tile = make_tile<float>({{{0, 0, 0}, {1, 2, 3}}}, 0);
        strategy->closest(*tile);
        CHECK(tile->primitive[0] == no_primitive);
    }
}
