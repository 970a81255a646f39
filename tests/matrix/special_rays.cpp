// T4: rays along axes and in planes, with components that are zero, denormal, NaN or infinite, of any length, from far
// away, and of random bits.
#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "bench/measure/stopwatch.h"
#include "tests/matrix/shoot.h"
#include "tests/support/moving_scenes.h"
#include "tests/support/reference_strategy.h"

namespace firstray::matrix {
namespace {

using test::Random;
using test::TestRay;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Closed boxes and a floor on whole coordinates: every sign of a side is exact in double, and so is every tie.
Scene lattice_scene()
{
    test::SmallScene small;
    const auto box = [&](const glm::dvec3& centre, double half) {
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-half, half}) {
                glm::dvec3 normal(0.0), u(0.0), v(0.0);
                normal[axis] = side, u[(axis + 1) % 3] = half, v[(axis + 2) % 3] = half;
                small.quad({}, centre + normal, u, v);
            }
    };
    for (int x = -4; x <= 4; x += 4)
        for (int y = -4; y <= 4; y += 4)
            for (int z = -4; z <= 4; z += 4)
                if (x != 0 || y != 0 || z != 0) box({x, y, z}, 1.0);
    for (int i = -8; i < 8; i += 2)
        for (int j = -8; j < 8; j += 2) small.quad({}, {i + 1, -8, j + 1}, {1, 0, 0}, {0, 0, 1});
    return small.build();
}

/// Rays whose nearest hit plain arithmetic tells exactly: whole and half starting points, the 26 directions of a
/// lattice with both zeros, of every length.
std::vector<TestRay> directed_rays()
{
    std::vector<TestRay> rays;
    const double places[] = {-8.0, -5.0, -3.0, -0.5, 0.0, 1.0, 2.0, 4.5, 5.0, 9.0};
    const int lengths[] = {0, -149, -130, -60, 60, 126};
    Random random(4);
    for (int start = 0; start < 60; ++start) {
        const auto pick = [&] { return places[random.below(std::size(places))]; };
        const glm::dvec3 origin(pick(), pick(), pick());
        for (int code = 0; code < 27; ++code) {
            glm::dvec3 direction(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
            if (direction == glm::dvec3(0.0)) continue;
            for (int axis = 0; axis < 3; ++axis)
                if (direction[axis] == 0.0 && random.unit() < 0.5) direction[axis] = -0.0;
            rays.push_back({origin, direction * std::exp2(lengths[rays.size() % std::size(lengths)])});
        }
    }
    return rays;
}

/// From 1e12 and farther, along axes, where the place that is met is known.
std::vector<TestRay> far_rays()
{
    std::vector<TestRay> rays;
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        TestRay ray{glm::dvec3(random.below(17), random.below(17), random.below(17)) - 8.0, glm::dvec3(0.0)};
        const int axis = static_cast<int>(random.below(3));
        const double way = random.unit() < 0.5 ? -1.0 : 1.0;
        ray.direction[axis] = way;
        ray.origin[axis] = -way * std::exp2(40.0 + random.below(20));
        rays.push_back(ray);
    }
    return rays;
}

/// How many rays' nearest hits are not what exact arithmetic finds. Where many share the nearest t because t is coarse,
/// the primitive may be another.
template <typename Real>
std::uint64_t wrong(const Strategy<Real>& strategy, const Scene& scene, const std::vector<TestRay>& rays,
                    bool t_is_exact)
{
    const Pose now = pose(scene, 0.0);
    test::ReferenceStrategy<Real> reference;
    reference.update(now);
    std::uint64_t count = 0;
    for (std::size_t first = 0; first < rays.size(); first += RayTile<Real>::capacity) {
        const auto found = test::make_tile<Real>(rays, first), expected = test::make_tile<Real>(rays, first);
        strategy.closest(*found);
        reference.closest(*expected);
        for (std::size_t i = 0; i < static_cast<std::size_t>(found->count); ++i) {
            const bool is_hit = expected->primitive[i] != no_primitive && std::isfinite(expected->t_max[i]);
            const bool same = t_is_exact ? !is_hit || (found->primitive[i] == expected->primitive[i] &&
                                                       found->t_max[i] == expected->t_max[i])
                                         : true;
            count += is_hit != (found->primitive[i] != no_primitive) || !same;
        }
    }
    return count;
}

/// Rays from up to 5e17 away, at corners and edges or through the middle; every other batch has a common apex.
std::vector<TestRay> far_rays_at(const Scene& targets, std::size_t batch)
{
    Random random(batch + 500);
    const auto corner = [&] {
        return targets.positions[random.below(static_cast<std::uint32_t>(targets.positions.size()))];
    };
    const auto place = [&] {
        return glm::dvec3(
            glm::vec3(corner() + glm::normalize(random.in_cube(1.0)) * std::pow(10.0, random.between(4.0, 17.7))));
    };
    std::vector<TestRay> rays(RayTile<float>::capacity);
    const glm::dvec3 apex = place();
    for (TestRay& ray : rays) {
        ray.origin = batch % 2 == 0 ? place() : apex;
        ray.direction = (random.unit() < 0.5 ? corner() : random.in_cube(5.0)) - ray.origin;
        if (random.unit() < 0.3) ray.t_max = 1.0;
        if (random.unit() < 0.2) ray.direction *= std::exp2(std::floor(random.between(-60.0, 60.0)));
    }
    return rays;
}

/// Numbers of any bits: NaNs, infinities and denormals as often as they come.
template <typename Real>
Real random_bits(Random& random)
{
    const auto high = static_cast<std::uint64_t>(random.unit() * 0x1p32),
               low = static_cast<std::uint64_t>(random.unit() * 0x1p32);
    if constexpr (std::is_same_v<Real, float>)
        return std::bit_cast<float>(static_cast<std::uint32_t>(high));
    else
        return std::bit_cast<double>(high << 32 | low);
}

template <typename Real>
std::vector<TestRay> random_rays(std::size_t batch)
{
    Random random(batch + 1000);
    std::vector<TestRay> rays(RayTile<Real>::capacity);
    const auto any = [&] { return static_cast<double>(random_bits<Real>(random)); };
    const glm::dvec3 apex = random.in_cube(9.0);
    for (TestRay& ray : rays) {
        ray = {apex, {any(), any(), any()}};
        if (batch % 4 == 0) ray.origin = {any(), any(), any()};  // else a common apex
        if (batch % 4 == 1) ray.t_min = any(), ray.t_max = any();
        if (batch % 4 == 2) ray.direction[static_cast<int>(random.below(3))] = 0.0;
    }
    return rays;
}

/// Rays that are none.
std::vector<TestRay> invalid_rays()
{
    std::vector<TestRay> rays;
    Random random(6);
    for (int i = 0; i < RayTile<float>::capacity; ++i) {
        TestRay ray{random.in_cube(9.0), random.in_cube(1.0)};
        const int axis = static_cast<int>(random.below(3));
        if (i % 4 == 0) ray.origin[axis] = i % 8 == 0 ? nan : infinity;
        if (i % 4 == 1) ray.direction[axis] = i % 8 == 1 ? nan : -infinity;
        if (i % 4 == 2) ray.t_min = nan;
        if (i % 4 == 3) ray.direction = glm::dvec3(0.0);
        rays.push_back(ray);
    }
    return rays;
}

template <typename Real>
double seconds(const Strategy<Real>& strategy, const std::vector<TestRay>& rays)
{
    double best = infinity;
    for (int round = 0; round < 5; ++round) {
        const auto tile = test::make_tile<Real>(rays, 0);
        const Stopwatch watch;
        for (int again = 0; again < 4; ++again) strategy.closest(*tile);
        best = std::min(best, watch.seconds());
    }
    return best;
}

std::vector<TestRay> ordinary_rays()
{
    std::vector<TestRay> rays;
    Random random(7);
    for (int i = 0; i < RayTile<float>::capacity; ++i) rays.push_back({random.in_cube(9.0), random.in_cube(1.0)});
    return rays;
}

}  // namespace

void special_ray_rows(Matrix& matrix)
{
    const Scene lattice = lattice_scene(), scene = test::random_scene(3, 1200);
    const Pose at_lattice = pose(lattice, 0.0), now = pose(scene, 0.0);
    const std::vector<TestRay> directed = directed_rays(), far = far_rays(), invalid = invalid_rays(),
                               ordinary = ordinary_rays();
    std::uint64_t cases = 0, wrong_hits = 0;
    Agreement random_sum[std::size(all_precisions)];
    double slowest = 0.0;
    const std::uint64_t batches = matrix.part_of(1000, 20);
    for (std::size_t p = 0; p < std::size(all_precisions); ++p) {
        const StrategyOptions options{.precision = all_precisions[p]};
        in_type_of(all_precisions[p], [&](auto real) {
            using Real = decltype(real);
            for (const Contender<Real>& contender : contenders<Real>(lattice, at_lattice, options, false)) {
                if (all_precisions[p] == Precision::fast) continue;
                cases += directed.size() + far.size();
                wrong_hits += wrong(*contender.strategy, lattice, directed, true);
                wrong_hits += wrong(*contender.strategy, lattice, far, false);
            }
            for (const Contender<Real>& contender : contenders<Real>(scene, now, options, false))
                slowest =
                    std::max(slowest, seconds(*contender.strategy, invalid) / seconds(*contender.strategy, ordinary));
        });
        random_sum[p] =
            ours_against_list(matrix.executor(), scene, now, options, batches,
                              all_precisions[p] == Precision::double_ ? random_rays<double> : random_rays<float>);
    }
    matrix.add(
        {.id = "T4",
         .tried =
             "directed: on, along and across planes, edges and corners of a lattice, both zeros, lengths 2^-149 "
             "to 2^126, from 1e12 to 5e17 away, against exact arithmetic, each strategy of ours, robust and double",
         .n = cases,
         .result = fmt::format("{} wrong", wrong_hits),
         .target = "0",
         .met = wrong_hits == 0,
         .known_miss = {}});
    for (std::size_t p = 0; p < std::size(all_precisions); ++p)
        matrix.add({.id = "T4",
                    .tried = "rays of random bits, each strategy of ours against list, " + name_of(all_precisions[p]),
                    .n = random_sum[p].rays,
                    .result = fmt::format("{} differ, {} NaN out, {} hits", random_sum[p].different,
                                          random_sum[p].not_numbers, random_sum[p].hits),
                    .target = "0, 0",
                    .met = random_sum[p].different + random_sum[p].not_numbers == 0,
                    .known_miss = {}});
    for (const Precision precision : all_precisions) {
        Agreement sum;
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const Scene moving = test::moving_scene(seed);
            const Pose then = pose(moving, 3.0);
            const Scene targets = test::targets_of(then);
            sum += ours_against_list(matrix.executor(), moving, then, {.precision = precision}, matrix.part_of(100, 4),
                                     [&](std::size_t batch) { return far_rays_at(targets, batch); });
        }
        matrix.add(
            {.id = "T4",
             .tried = "rays from 1e4 to 5e17 away, one by one and from common apexes, at what moves: each strategy of "
                      "ours against list, " +
                      name_of(precision),
             .n = sum.rays,
             .result = fmt::format("{} of {} hits differ", sum.different, sum.hits),
             .target = "0",
             .met = sum.different == 0 && sum.hits > 0,
             .known_miss = {}});
    }
    matrix.add(
        {.id = "T4",
         .tried = "time of rays that are NaN, infinite, empty or zero, over ordinary ones, slowest of our strategies",
         .n = invalid.size(),
         .result = fmt::format("{:.2f}", slowest),
         .target = "<= 2.5",
         .met = slowest <= 2.5,
         .known_miss = {}});
}

}  // namespace firstray::matrix
