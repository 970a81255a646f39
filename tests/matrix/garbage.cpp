// T6 and T7: geometry that no modeller would make: random bits, slivers, points, heaps of copies.
#include <fmt/format.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>

#include "tests/matrix/shoot.h"

namespace firstray::matrix {
namespace {

using test::Random;
using test::TestRay;

/// 20 meshes of up to 255 triangles: corners of random bits, or of few digits so that they coincide and line up.
/// largest  beyond it, and where they are not finite, bits make no number: infinity lets any stand
Scene garbage_scene(std::uint64_t seed, double largest)
{
    Random random(seed);
    test::SmallScene small;
    const auto any = [&] {
        for (;;) {
            const auto bits = static_cast<std::uint32_t>(random.unit() * 0x1p32);
            const auto number = static_cast<double>(std::bit_cast<float>(bits));
            if (!std::isfinite(largest) || std::abs(number) <= largest) return number;
        }
    };
    for (int mesh = 0; mesh < 20; ++mesh) {
        const std::uint32_t kind = random.below(4), count = random.below(256);
        const double unit = std::exp2(std::floor(random.between(-20.0, 20.0)));
        for (std::uint32_t i = 0; i < count; ++i) {
            glm::dvec3 corner[3];
            for (glm::dvec3& p : corner)
                for (int axis = 0; axis < 3; ++axis)
                    p[axis] = kind == 0 ? any() : unit * (static_cast<double>(random.below(5)) - 2.0);
            if (kind == 2) corner[2] = corner[0] + (corner[1] - corner[0]) * random.between(-1.0, 2.0);
            if (kind == 3) corner[static_cast<int>(random.below(3))] *= 1.0 + 1e-6 * random.unit();
            small.triangle({}, corner[0], corner[1], corner[2]);
        }
    }
    small.triangle({}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    return small.build();
}

Scene without_numbers_that_are_none(Scene scene)
{
    for (glm::dvec3& p : scene.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(p[axis]) < 1e18)) p[axis] = 0.0;
    return scene;
}

/// Rays among what may be hit at all.
std::vector<TestRay> rays_among(const Scene& scene, std::size_t batch)
{
    Random random(batch);
    std::vector<TestRay> rays = batch % 2 == 0 ? test::awkward_rays(batch, scene, 1024)
                                               : test::rays_from(batch, scene, random.in_cube(4.0), 1024);
    for (std::size_t i = 0; i < rays.size(); i += 3) {
        rays[i].origin = batch % 2 == 0 ? random.in_cube(4.0) : rays[0].origin;
        rays[i].direction = random.in_cube(1.0);
    }
    return rays;
}

Agreement garbage(const Matrix& matrix, std::uint64_t scenes, double largest, Precision precision)
{
    std::vector<Agreement> sums(scenes);
    const Executor alone(1);
    matrix.executor().for_each(scenes, [&](std::size_t i) {
        const std::uint64_t seed = i + 1;
        const Scene scene = garbage_scene(seed, largest), targets = without_numbers_that_are_none(scene);
        const auto make = [&](std::size_t) { return rays_among(targets, 11 * seed); };
        sums[i] = ours_against_list(alone, scene, pose(scene, 0.0), {.precision = precision}, 1, make);
    });
    return std::accumulate(sums.begin(), sums.end(), Agreement{},
                           [](Agreement a, const Agreement& b) { return a += b; });
}

/// Ids that rays find on copies of a few triangles, by one strategy, with many threads at once.
struct Finding {
    std::uint64_t rays = 0, wrong = 0;
};

Finding find_copies(const Scene& scene, const StrategyEntry& entry, int threads, Precision precision)
{
    Finding finding;
    const Executor executor(threads);
    const Pose now = pose(scene, 0.0);
    in_type_of(precision, [&](auto real) {
        using Real = decltype(real);
        std::unique_ptr<Strategy<Real>> strategy;
        const StrategyOptions options{.precision = precision, .executor = &executor};
        if constexpr (std::is_same_v<Real, float>)
            strategy = entry.make(scene, options);
        else
            strategy = entry.make_double(scene, options);
        strategy->update(now);
        std::atomic<std::uint64_t> wrong{0}, rays{0};
        executor.for_each(static_cast<std::size_t>(threads), [&](std::size_t batch) {
            Random random(batch);
            std::vector<TestRay> some;
            const glm::dvec3 apex(0.1, 0.2, 5.0);
            for (int i = 0; i < 32; ++i)
                some.push_back({batch % 2 ? apex : glm::dvec3(glm::vec3(random.in_cube(0.5))) + apex, {0, 0, 0}});
            for (TestRay& ray : some)
                ray.direction = glm::dvec3(random.between(-0.9, 0.9), random.between(-0.9, 0.9), 0.0) - ray.origin;
            const auto tile = test::make_tile<Real>(some, 0);
            strategy->closest(*tile);
            for (std::size_t i = 0; i < some.size(); ++i) wrong += tile->primitive[i] > 1;  // the first of all copies
            rays += some.size();
        });
        finding = {rays, wrong};
    });
    return finding;
}

}  // namespace

void garbage_rows(Matrix& matrix)
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Precision precision : all_precisions) {
        const std::uint64_t scenes = matrix.part_of(precision == Precision::robust ? 1000 : 100, 5);
        const Agreement sum = garbage(matrix, scenes, 1e18, precision);
        matrix.add({.id = "T6",
                    .tried = fmt::format("{} scenes of 20 meshes of random bits up to 1e18, slivers, points, lines and "
                                         "copies; each strategy of ours against list, {}",
                                         scenes, name_of(precision)),
                    .n = sum.rays,
                    .result = fmt::format("{} of {} hits differ", sum.different, sum.hits),
                    .target = precision == Precision::fast ? "reported" : "0",
                    .met = precision == Precision::fast || (sum.different == 0 && sum.hits > 0),
                    .known_miss = {}});
    }
    const std::uint64_t scenes = matrix.part_of(100, 5);
    const Agreement sum = garbage(matrix, scenes, infinity, Precision::robust);
    matrix.add({.id = "T6",
                .tried = fmt::format("{} such scenes with bits of any size, NaN and infinity too, robust", scenes),
                .n = sum.rays,
                .result = fmt::format("{} NaN out; {} of {} hits differ", sum.not_numbers, sum.different, sum.hits),
                .target = "0; 0",
                .met = sum.not_numbers + sum.different == 0,
                .known_miss = {}});
}

void duplicate_rows(Matrix& matrix)
{
    test::SmallScene small;
    const auto copies = static_cast<int>(matrix.part_of(50'000, 2000));
    for (int i = 0; i < copies; ++i) small.quad({}, glm::dvec3(0.0), {1, 0, 0}, {0, 1, 0});
    const Scene scene = small.build();
    Finding sum;
    for (const StrategyEntry& entry : strategies()) {
        if (entry.peer) continue;
        for (const Precision precision : all_precisions)
            for (const int threads : {1, 2, 8, 64}) {
                const Finding one = find_copies(scene, entry, threads, precision);
                sum.rays += one.rays, sum.wrong += one.wrong;
            }
    }
    matrix.add(
        {.id = "T7",
         .tried = fmt::format("{} coplanar copies, each strategy of ours, each precision, 1, 2, 8 and 64 threads: "
                              "the first of equals",
                              2 * copies),
         .n = sum.rays,
         .result = fmt::format("{} others", sum.wrong),
         .target = "0",
         .met = sum.wrong == 0,
         .known_miss = {}});
}

}  // namespace firstray::matrix
