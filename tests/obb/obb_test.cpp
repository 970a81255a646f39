#include "obb/obb.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/strategy/list.h"
#include "tests/support/compare_hits.h"
#include "tests/support/moving_scenes.h"
#include "tests/support/obb_variants.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// Compares hits with the list's, frame after frame.
template <typename Real>
void check_frames(const Scene& scene, std::span<const obb::Options> variants, Precision precision, int rays, int& hits)
{
    const StrategyOptions options{.precision = precision};
    const auto list = make_list<Real>(scene, options);
    std::vector<std::unique_ptr<Strategy<Real>>> strategies;
    for (const obb::Options& variant : variants) strategies.push_back(obb::make_obb<Real>(scene, options, variant));
    for (const int frame : {2, 4, 0, 8}) {
        CAPTURE(frame);
        const Pose now = pose(scene, scene.time_of(frame));
        const auto seed = static_cast<std::uint64_t>(frame);
        const Scene targets = targets_of(now);
        const std::vector<TestRay> aimed = awkward_rays(seed, targets, rays),
                                   fan = rays_from(seed / 2, targets, targets.positions[0] + glm::dvec3(3, 4, 5), rays);
        list->update(now);
        const Expected<Real> expected_aimed(*list, aimed), expected_fan(*list, fan);
        for (std::size_t i = 0; i < variants.size(); ++i) {
            CAPTURE(static_cast<int>(variants[i].groups));
            CAPTURE(static_cast<int>(variants[i].top));
            CAPTURE(static_cast<int>(variants[i].inside));
            strategies[i]->update(now);
            CHECK(expected_aimed.differences(*strategies[i], hits) == 0);
            CHECK(expected_fan.differences(*strategies[i], hits) == 0);
        }
    }
}

/// Every variant in robust, every fifth in the other precisions, starting with one that differs from call to call.
void check_scene(const Scene& scene, std::size_t call, int rays, int& hits)
{
    const std::vector<obb::Options> all = obb_variants();
    std::vector<obb::Options> some;
    for (std::size_t i = call % 5; i < all.size(); i += 5) some.push_back(all[i]);
    check_frames<float>(scene, all, Precision::robust, rays, hits);
    check_frames<float>(scene, some, Precision::fast, rays, hits);
    check_frames<double>(scene, some, Precision::double_, rays, hits);
}

}  // namespace

TEST_CASE("oriented boxes give the list's hits bit for bit, however they are nested, moved and searched")
{
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        CAPTURE(seed);
        const glm::dvec3 offset = seed % 3 == 0 ? glm::dvec3(3e4, -1e5, 7e3) : glm::dvec3(0.0);
        check_scene(moving_scene(seed, {.clusters = 4, .offset = offset}), seed, 300, hits);
    }
    CHECK(hits > 50000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("oriented boxes give the list's hits bit for bit, whatever a transform does")
{
    int hits = 0;
    for (int i = 0; i < static_cast<int>(Motion::count); ++i) {
        CAPTURE(i);
        const Scene scene = moving_scene(static_cast<std::uint64_t>(100 + i),
                                         {.clusters = 2, .has_deforming = false, .motions = {static_cast<Motion>(i)}});
        check_scene(scene, static_cast<std::size_t>(i), 200, hits);
    }
    CHECK(hits > 50000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("oriented boxes give the list's hits bit for bit in supergrids, without scenery and far from it")
{
    const std::pair<const char*, MovingScene> shapes[] = {
        {"no scenery", {.scenery = 0, .clusters = 3}},
        {"nothing but what deforms", {.scenery = 0, .clusters = 0, .triangles = 100}},
        {"many boxes in a cluster", {.clusters = 1, .triangles = 6, .boxes = 18, .motions = {Motion::rigid}}},
        {"many clusters", {.clusters = 20, .triangles = 6, .boxes = 1, .motions = {Motion::rigid, Motion::grows}}},
        {"many clusters without scenery",
         {.scenery = 0, .clusters = 20, .triangles = 6, .boxes = 1, .motions = {Motion::rigid}}},
        {"boxes far outside", {.clusters = 3, .triangles = 80, .motions = {Motion::flies_away}}},
        {"crowded boxes", {.scenery = 3000, .clusters = 2, .triangles = 900, .motions = {Motion::rigid}}},
    };
    int hits = 0;
    for (const auto& [name, shape] : shapes) {
        const auto name_now = name;  // clang 14 captures no structured bindings
        CAPTURE(name_now);
        check_scene(moving_scene(200, shape), 0, 200, hits);
    }
    CHECK(hits > 50000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("clusters of more than sixteen boxes have a supergrid of several cells")
{
    const Scene scene = moving_scene(200, {.clusters = 1, .triangles = 6, .boxes = 18, .motions = {Motion::rigid}});
    const auto strategy = obb::make_obb<float>(scene, {});
    const Pose now = pose(scene, 2.0);
    strategy->update(now);
    const std::vector<StructureBox> outline = strategy->outline();
    const auto supergrid = std::find_if(outline.begin(), outline.end(), [](const StructureBox& box) {
        return box.kind == StructureBox::Kind::supergrid && box.name == "x0";
    });
    REQUIRE(supergrid != outline.end());
    CHECK(supergrid->dims.x * supergrid->dims.y * supergrid->dims.z > 4);
}

TEST_CASE("a corner out of range hides nothing else of its box, as long as it stays there and after")
{
    // Triangles of the group's own, and of a static transform in it, which may have a box of their own. The group
    // shrinks to 1e-25 of its size, where all of it is in range, and grows back.
    const std::string triangle = "p 3 -1e25 -1e25 5e24 1e25 -1e25 5e24 0 1e25 5e24 ",
                      small = "p 3 -2 -2 3 2 -2 3 0 2 3 ";
    const Scene scene = scene_of("a 0 4 5 x a {" + small + triangle + "xs 1 1 1 0 0 1 0 0.5 0 1 {" + small +
                                 "p 3 0 0 4 1 0 4 0 3e38 4 } } k a { scale 6 -1 1 1 1 0 0 0 0 1 1 1 0 0 0 "
                                 "1 1e-25 1e-25 1e-25 0 0 0 2 1 1 1 0 0 0 3 1 1 1 0 0 0 4 1 1 1 0 0 0 }");
    std::vector<TestRay> rays;
    for (int i = 0; i < 400; ++i) rays.push_back({{0, 0, -9}, {0.02 * (i % 20) - 0.2, 0.02 * (i / 20) - 0.2, 1}});
    const auto list = make_list<float>(scene, {});
    for (const obb::Options& variant : obb_variants()) {
        CAPTURE(static_cast<int>(variant.groups));
        CAPTURE(static_cast<int>(variant.inside));
        const auto boxes = obb::make_obb<float>(scene, {}, variant);
        for (const double time : {0.0, 1.0, 2.0}) {
            CAPTURE(time);
            const Pose now = pose(scene, time);
            list->update(now);
            boxes->update(now);
            int hits = 0;
            CHECK(differences(*list, *boxes, rays, hits) == 0);
            CHECK(hits > 100);
        }
    }
}

TEST_CASE("a ray is sent into a box once, in however many cells it stands")
{
    // A sheaf of 192 needles that rays along z pass between, in front of, among and behind scenery of many cells.
    std::string text = "p 3 -50 -50 -50 -49 -50 -50 -50 -49 -50 p 3 50 50 50 49 50 50 50 49 50 x a { m vertices 576\n";
    for (int i = 0; i < 192; ++i) {
        const std::string z = std::to_string(-40.0 + 0.4 * i);
        text += (i % 2 ? "-30 30.25 " : "-30 30.24 ") + z + " 30 -29.75 " + z + " 30 -29.76 " + z + "\n";
    }
    text += "triangles 192\n";
    for (int i = 0; i < 192; ++i)
        text += std::to_string(3 * i) + ' ' + std::to_string(3 * i + 1) + ' ' + std::to_string(3 * i + 2) + '\n';
    const Scene scene = scene_of(text + "}");
    std::vector<TestRay> rays;
    for (int i = 0; i < 100; ++i) rays.push_back({{-25 + 0.2 * i, 25.245 - 0.2 * i, 60}, {0, 0, -1}});
    const Pose now = pose(scene, 0.0);
    for (const obb::Top top : {obb::Top::grid, obb::Top::list}) {
        const auto strategy =
            obb::make_obb<float>(scene, {.grid_density = 4000.0f}, {.top = top, .inside = obb::Inside::list});
        strategy->update(now);
        CHECK(strategy->report().voxels > 1000);
        for (const bool any : {false, true}) {
            const auto tile = make_tile<float>(rays, 0);
            std::vector<RayCost> costs(rays.size());
            tile->cost = costs.data();
            any ? strategy->occluded(*tile) : strategy->closest(*tile);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                CAPTURE(i);
                CHECK(tile->primitive[i] == no_primitive);
                CHECK(costs[i].cells > 10);
                CHECK(costs[i].tests == 192);
            }
        }
    }
}
