// T5: a scene that is scaled by a power of two is hit as before.
#include <fmt/format.h>

#include <cmath>

#include "engine/core/search_ray.h"
#include "tests/matrix/shoot.h"

namespace firstray::matrix {
namespace {

using test::TestRay;

struct Change {
    std::uint64_t rays = 0, hits = 0, ids = 0, ts = 0;
    Change& operator+=(const Change& other)
    {
        rays += other.rays, hits += other.hits, ids += other.ids, ts += other.ts;
        return *this;
    }
};

/// The same with positions that float holds, so that a power of two changes no digit.
Scene scaled(Scene scene, double by)
{
    for (glm::dvec3& p : scene.positions) p = glm::dvec3(glm::vec3(p)) * by;
    for (Quadric& quadric : scene.quadrics) {
        quadric.group_from_quadric.linear *= by;
        quadric.group_from_quadric.offset *= by;
    }
    return scene;
}

std::vector<TestRay> scaled(std::vector<TestRay> rays, double by)
{
    for (TestRay& ray : rays) {
        ray.origin = glm::dvec3(glm::vec3(ray.origin)) * by;
        ray.direction = glm::dvec3(glm::vec3(ray.direction));
        ray.t_min = static_cast<float>(ray.t_min);
        ray.t_max = static_cast<float>(ray.t_max);
        ray.t_min *= by, ray.t_max *= by;
    }
    return rays;
}

template <typename Real>
Change change(const Matrix& matrix, const Scene& base, int exponent, Precision precision, std::uint64_t batches)
{
    const double by = std::exp2(exponent);
    const Scene as_is = scaled(base, 1.0), other = scaled(base, by);
    const Pose now = pose(as_is, 0.0), then = pose(other, 0.0);
    const auto list = std::move(contenders<Real>(as_is, now, {.precision = precision}, false)[0].strategy);
    Change sum;
    for (const Contender<Real>& contender : contenders<Real>(other, then, {.precision = precision}, false))
        sum += shoot<Change>(
            matrix.executor(), *contender.strategy, batches,
            [&](std::size_t batch) {
                return scaled(batch % 2 == 0 ? test::awkward_rays(batch, as_is, 1024)
                                             : test::rays_from(batch, as_is, as_is.positions[batch], 1024),
                              by);
            },
            [&](const RayTile<Real>& found, const std::vector<TestRay>& rays) {
                const auto expected = test::make_tile<Real>(scaled(rays, 1.0 / by), 0);
                list->closest(*expected);
                Change one;
                one.rays = rays.size();
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    const glm::dvec3 from = glm::abs(rays[i].origin);
                    if (std::max({from.x, from.y, from.z}) > farthest_place) continue;  // meets nothing, at this scale
                    one.hits += expected->primitive[i] != no_primitive;
                    one.ids += expected->primitive[i] != found.primitive[i];
                    one.ts += expected->primitive[i] != no_primitive &&
                              expected->t_max[i] * static_cast<Real>(by) != found.t_max[i];
                }
                return one;
            });
    return sum;
}

}  // namespace

void scaling_rows(Matrix& matrix)
{
    const Scene base = test::random_scene(8, 1200);
    for (const Precision precision : all_precisions) {
        Change sum;
        for (const int exponent : {-40, -20, 20, 40})
            in_type_of(precision, [&](auto real) {
                sum += change<decltype(real)>(matrix, base, exponent, precision, matrix.part_of(50, 2));
            });
        const bool is_reported = precision == Precision::fast;
        // At 2^-40 and 2^40 products of three lengths leave float's range, and t comes from double.
        const bool is_rounding = precision == Precision::robust && sum.ids * 10'000 <= sum.hits;
        matrix.add({.id = "T5",
                    .tried = "scene and rays scaled by 2^-40, 2^-20, 2^20, 2^40, each strategy of ours against list at "
                             "scale 1, " +
                             name_of(precision),
                    .n = sum.rays,
                    .result = fmt::format("{} ids differ, {} t, of {} hits", sum.ids, sum.ts, sum.hits),
                    .target = is_reported ? "reported" : "0 ids",
                    .met = is_reported || sum.ids == 0,
                    .known_miss = is_rounding ? "t rounds otherwise: surfaces within that change places" : ""});
    }
}

}  // namespace firstray::matrix
