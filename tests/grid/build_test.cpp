#include "engine/grid/build.h"

#include <doctest/doctest.h>

#include "bench/strategies.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// Builds the grid, finds one ray's hit with it, and gives its report.
StructureReport build_and_hit(const Scene& scene, const TestRay& ray, bool hit, const StrategyOptions& options = {})
{
    const Pose now = pose(scene, 0.0);
    const auto grid = find_strategy("grid")->make(scene, options);
    grid->update(now);
    const auto tile = make_tile<float>({ray}, 0);
    grid->closest(*tile);
    CHECK((tile->primitive[0] != no_primitive) == hit);
    return grid->report();
}

std::vector<glm::uvec3> separate_triangles(std::size_t corners)
{
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i + 2 < corners; i += 3) triangles.emplace_back(i, i + 1, i + 2);
    return triangles;
}

}  // namespace

TEST_CASE("a million copies of one triangle stay one list")
{
    const std::vector<glm::uvec3> copies(1'000'000, {0, 1, 2});
    const Scene scene = mesh_scene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}, copies);
    const StructureReport report = build_and_hit(scene, {{0.2, 0.2, 5}, {0, 0, -1}}, true);
    CHECK(report.references <= 6 * report.primitives);
    CHECK(report.peak_bytes < 400 * report.primitives);
}

TEST_CASE("a million small triangles in one spot of a large scene get a grid of their own")
{
    Random random(11);
    std::vector<glm::dvec3> corners = {{-1e4, -1e4, 0}, {1e4, -1e4, 0}, {0, 1e4, 1}};
    while (corners.size() < 3'000'000) {
        const glm::dvec3 a = random.in_cube(1.0);
        corners.insert(corners.end(), {a, a + random.in_cube(0.01), a + random.in_cube(0.01)});
    }
    const StructureReport report =
        build_and_hit(mesh_scene(corners, separate_triangles(corners.size())), {{0, 0, 1e4}, {0, 0, -1}}, true);
    CHECK(report.depth >= 2);
    CHECK(report.largest_list < 20'000);
    CHECK(report.references <= 6 * report.primitives);
    CHECK(report.peak_bytes < 400 * report.primitives);
}

TEST_CASE("triangles as large as everything do not multiply")
{
    Random random(12);
    std::vector<glm::dvec3> corners;
    while (corners.size() < 60'000) corners.push_back(random.in_cube(100.0));
    const StructureReport report =
        build_and_hit(mesh_scene(corners, separate_triangles(corners.size())), {{0, 0, 0}, {1, 2, 3}}, true);
    CHECK(report.references <= 6 * report.primitives + 64);
    CHECK(report.peak_bytes < 600 * report.primitives);
}

TEST_CASE("flat scenes, straight scenes and points are built")
{
    Random random(13);
    std::vector<glm::dvec3> flat, straight, points;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 p = random.in_cube(1.0);
        flat.emplace_back(p.x, p.y, 0.25);
        straight.emplace_back(p.x, 0.0, 0.0);
        points.emplace_back(1.0, 2.0, 3.0);
    }
    const auto triangles = separate_triangles(flat.size());
    build_and_hit(mesh_scene(flat, triangles), {{0, 0, 1}, {0, 0, -1}}, true);
    build_and_hit(mesh_scene(straight, triangles), {{0, 0, 1}, {0, 0, -1}}, false);
    build_and_hit(mesh_scene(points, triangles), {{1, 2, 4}, {0, 0, -1}}, false);
}

TEST_CASE("limits on lists and levels are respected where progress can be made")
{
    const Scene scene = sphere_mesh(60, 10.0, glm::dvec3(0.0));
    const TestRay ray{{0, 0, 0}, {1, 0.2, 0.1}};
    CHECK(build_and_hit(scene, ray, true, {.grid_density = 0.05f, .max_list = 10, .grid_depth = 1}).depth == 1);
    const StructureReport paper =
        build_and_hit(scene, ray, true, {.grid_density = 0.05f, .max_list = 10, .grid_depth = 4});
    CHECK(paper.depth > 1);
    CHECK(paper.depth <= 4);
    const StructureReport deep =
        build_and_hit(scene, ray, true, {.grid_density = 0.05f, .max_list = 40, .grid_depth = 8});
    CHECK(deep.largest_list < 200);
}

TEST_CASE("the structure does not depend on the number of threads")
{
    const Scene scene = random_scene(21, 20000);
    const Pose now = pose(scene, 0.0);
    const std::vector<TestRay> rays = awkward_rays(22, scene, 1024);
    std::vector<StructureReport> reports;
    std::vector<std::unique_ptr<RayTile<float>>> answers;
    for (const int threads : {1, 2, 7}) {
        const Executor executor(threads);
        const auto grid = find_strategy("grid")->make(scene, {.executor = &executor});
        grid->update(now);
        reports.push_back(grid->report());
        answers.push_back(make_tile<float>(rays, 0));
        grid->closest(*answers.back());
    }
    for (std::size_t i = 1; i < reports.size(); ++i) {
        CHECK(reports[i].references == reports[0].references);
        CHECK(reports[i].bytes == reports[0].bytes);
        CHECK(answers[i]->primitive == answers[0]->primitive);
        CHECK(answers[i]->t_max == answers[0]->t_max);
    }
}
