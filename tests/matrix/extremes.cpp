// T11: geometry that grids are bad at: everything in one cell, triangles as large as the scene, a stadium around a
// speck.
#include <fmt/format.h>

#include <algorithm>

#include "bench/measure/stopwatch.h"
#include "engine/aff/reader.h"
#include "scenes/generator/generate.h"
#include "tests/matrix/shoot.h"
#include "tests/support/temp_folder.h"

namespace firstray::matrix {
namespace {

using test::Random;

/// Small triangles in a cube.
Scene soup(std::uint64_t count, double cube, double size, bool has_far_one)
{
    Random random(count);
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 at = has_far_one && i == 0 ? glm::dvec3(1.0) : random.in_cube(cube);
        for (int corner = 0; corner < 3; ++corner) positions.push_back(at + random.in_cube(size));
        const auto first = static_cast<std::uint32_t>(3 * i);
        triangles.emplace_back(first, first + 1, first + 2);
    }
    return test::mesh_scene(std::move(positions), triangles);
}

Scene stadium(double ratio)
{
    const test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "stadium.aff";
    for (const scenes::SceneEntry& entry : scenes::scene_entries())
        if (entry.name == "stadium") entry.write({.file = file, .seed = 1, .amount = ratio});
    return read_aff(file);
}

struct Build {
    double seconds = 0.0, per_primitive = 0.0, mebibytes = 0.0;
    Agreement agreement;
};

/// Builds with every strategy and compares rays with the list.
/// returns  what `grid` took at least in three rounds, and the agreement of all
Build measure(const Matrix& matrix, const Scene& scene, std::uint64_t batches)
{
    Build result;
    const Pose now = pose(scene, scene.start);
    const StrategyOptions options{.executor = &matrix.executor()};
    for (int round = 0; round < 3; ++round) {
        const auto grid = find_strategy("grid")->make(scene, options);
        const Stopwatch watch;
        grid->update(now);
        result.seconds = round == 0 ? watch.seconds() : std::min(result.seconds, watch.seconds());
        const StructureReport report = grid->report();
        result.per_primitive = static_cast<double>(report.references) / static_cast<double>(report.primitives);
        result.mebibytes = static_cast<double>(report.peak_bytes) / 0x1p20;
    }
    const auto all = contenders<float>(scene, now, options, false);
    const auto make = [&](std::size_t batch) {
        const auto rays = batch % 2 == 0 ? test::awkward_rays(batch, scene, 64)
                                         : test::rays_from(batch, scene, scene.positions[batch] + glm::dvec3(0.1), 256);
        return rays;
    };
    for (const Agreement& one : agreements(matrix.executor(), all, batches, make)) result.agreement += one;
    return result;
}

void add(Matrix& matrix, const std::string& what, const Build& build, double uniform_seconds, double most_time)
{
    const double ratio = build.seconds / uniform_seconds;
    const Agreement& agreement = build.agreement;
    matrix.add({.id = "T11",
                .tried = what +
                         ": grid's build time over that of as many spread evenly, references per primitive, peak "
                         "MiB; hits of all strategies that are not the list's",
                .n = agreement.rays,
                .result = fmt::format("{:.1f}x, {:.1f}, {:.0f}; {}", ratio, build.per_primitive, build.mebibytes,
                                      agreement.different),
                .target = fmt::format("<= {:.0f}x, <= 8; 0", most_time),
                .met = ratio <= most_time && build.per_primitive <= 8.0 && agreement.different == 0,
                .known_miss = {}});
}

}  // namespace

void extreme_rows(Matrix& matrix)
{
    const std::uint64_t count = matrix.part_of(1'000'000, 20'000), huge = count / 10;
    const Build even = measure(matrix, soup(count, 1.0, 0.01, false), 4),
                fewer = measure(matrix, soup(huge, 1.0, 0.02, false), 4);
    add(matrix, fmt::format("{} triangles, all but one in a millionth of the scene's size", count),
        measure(matrix, soup(count, 1e-6, 1e-8, true), 4), even.seconds, 5.0);
    add(matrix, fmt::format("{} triangles as large as the scene", huge),
        measure(matrix, soup(huge, 1.0, 2.0, false), 4), fewer.seconds, 5.0);
    const Scene wide = stadium(1e6);
    const Build as_many = measure(matrix, soup(wide.primitive_count(), 1.0, 0.02, false), 4);
    add(matrix,
        fmt::format("stadium a million times as large as what stands in it, {} primitives", wide.primitive_count()),
        measure(matrix, wide, 20), as_many.seconds, 5.0);
}

}  // namespace firstray::matrix
