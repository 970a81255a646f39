#include "scenes/generator/generate.h"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "bench/strategies.h"
#include "engine/aff/reader.h"
#include "engine/render/camera_rays.h"
#include "engine/scene/pose.h"
#include "tests/support/compare_hits.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::scenes;
using test::TempFolder;
using test::TestRay;

namespace {

/// The smallest version of a scene that is still like it.
double small_amount(const SceneEntry& entry)
{
    return entry.name == "robots" ? 3.0 : entry.name == "stadium" ? 500.0 : entry.low;
}

std::map<std::string, std::string> files_of(const SceneEntry& entry, std::uint64_t seed)
{
    const TempFolder folder;
    entry.write({folder.path() / "scene.aff", seed, small_amount(entry)});
    std::map<std::string, std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
        std::ifstream in(file.path(), std::ios::binary);
        files[file.path().filename()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return files;
}

/// Scenes never change, so tests share them: the larger ones take a while to write and to read.
const Scene& made(std::string_view name, double amount)
{
    static std::map<std::pair<std::string, double>, Scene> scenes;
    const auto [place, is_new] = scenes.try_emplace({std::string(name), amount});
    if (is_new) {
        const TempFolder folder;
        for (const SceneEntry& entry : scene_entries())
            if (entry.name == name) entry.write({folder.path() / "scene.aff", 1, amount});
        place->second = read_aff(folder.path() / "scene.aff");
    }
    return place->second;
}

/// Rays of the camera for a picture of the given size, scattered where `random` is given.
std::vector<TestRay> view_rays(const Pose& now, int width, int height, test::Random* random = nullptr)
{
    const CameraRays camera = camera_rays(now, width, height);
    std::vector<TestRay> rays;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            rays.push_back({camera.eye, direction(camera, {x + 0.5, y + 0.5})});
            if (random) rays.back().direction += random->in_cube(0.3);
        }
    return rays;
}

std::size_t moving_groups(const Scene& scene)
{
    return scene.groups.size() - 1;
}

}  // namespace

TEST_CASE("the same seed gives the same bytes, another seed others")
{
    for (const SceneEntry& entry : scene_entries()) {
        CAPTURE(entry.name);
        const auto files = files_of(entry, 1);
        CHECK(files == files_of(entry, 1));
        CHECK(files != files_of(entry, 2));
    }
}

TEST_CASE("as many triangles are made as were asked for")
{
    for (const double amount : {1e5, 150000.0})
        CHECK(static_cast<double>(made("crowd", amount).triangles.size()) == doctest::Approx(amount).epsilon(0.01));
    for (const double amount : {1e4, 20000.0})
        CHECK(static_cast<double>(made("art", amount).triangles.size()) == doctest::Approx(amount).epsilon(0.01));
    CHECK(made("robots", 10).triangles.size() == doctest::Approx(70000).epsilon(0.01));
    CHECK(made("robot", 0).triangles.size() == doctest::Approx(6000).epsilon(0.02));
}

TEST_CASE("what moves in the scenes are groups of their own")
{
    CHECK(moving_groups(made("robot", 0)) == 18);
    CHECK(moving_groups(made("robots", 3)) == 3 * 18);
    CHECK(moving_groups(made("stadium", 500)) == 18 + 1);
    CHECK(moving_groups(made("explode", 0)) == 320 + 80);
    CHECK(moving_groups(made("crowd", 1e5)) == 3 + 8);
    const Scene& art = made("art", 1e4);
    REQUIRE(moving_groups(art) == 1);
    CHECK(art.groups[1].deforming);
}

TEST_CASE("everything of the scenes that a transform should move does move")
{
    for (const SceneEntry& entry : scene_entries()) {
        CAPTURE(entry.name);
        const Scene& scene = made(entry.name, small_amount(entry));
        int still = 0;
        for (const Animation& animation : scene.animations) {
            const Transform start = animation.at(0.0);
            bool moves = false;
            for (int i = 1; i < 20; ++i) {
                const Transform now = animation.at(scene.end * i / 20.0);
                moves = moves || now.offset != start.offset || now.linear != start.linear;
            }
            still += !moves;
        }
        CHECK(still == 0);
    }
}

TEST_CASE("the stadium is as many times longer than the walker is high as was asked for")
{
    for (const double ratio : {50.0, 500.0}) {
        const Scene& scene = made("stadium", ratio);
        const Pose now = pose(scene, 0.0);
        double low = 1e9, high = -1e9, longest = 0.0;
        for (const Group& group : scene.groups)
            for (std::uint32_t i = 0; i < group.vertices; ++i) {
                const glm::dvec3 p = now.root_from_node[group.node].point(scene.positions[group.first_vertex + i]);
                if (group.node == 0 && std::abs(p.x) < 399.0) longest = std::max(longest, 2.0 * p.x);
                if (group.node != 0) low = std::min(low, p.y), high = std::max(high, p.y);
            }
        CHECK(longest / (high - low) == doctest::Approx(ratio).epsilon(0.2));
    }
}

TEST_CASE("a street hides nearly all of the crowd")
{
    const Scene& scene = made("crowd", 150000);
    const auto strategy = find_strategy("grid")->make(scene, {});
    const Pose now = pose(scene, 4.0);
    strategy->update(now);
    const std::vector<TestRay> rays = view_rays(now, 320, 240);
    std::set<PrimitiveId> seen;
    for (std::size_t first = 0; first < rays.size(); first += RayTile<float>::capacity) {
        const auto tile = test::make_tile<float>(rays, first);
        strategy->closest(*tile);
        for (int i = 0; i < tile->count; ++i)
            if (tile->primitive[static_cast<std::size_t>(i)] != no_primitive)
                seen.insert(tile->primitive[static_cast<std::size_t>(i)]);
    }
    CHECK(seen.size() > 1000);
    CHECK(static_cast<double>(seen.size()) < 0.03 * static_cast<double>(scene.primitive_count()));
}

TEST_CASE("all strategies agree about the scenes that are made")
{
    for (const SceneEntry& entry : scene_entries()) {
        CAPTURE(entry.name);
        const Scene& scene = made(entry.name, small_amount(entry));
        test::Random random(7);
        int hits = 0;
        for (const double part : {0.1, 0.7}) {
            const Pose now = pose(scene, part * scene.end);
            std::vector<TestRay> rays = view_rays(now, 12, 9);
            const std::vector<TestRay> around = view_rays(now, 12, 9, &random),
                                       awkward = test::awkward_rays(3, scene, 40);
            rays.insert(rays.end(), around.begin(), around.end());
            rays.insert(rays.end(), awkward.begin(), awkward.end());
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
        CHECK(hits > 200);
    }
}
