#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "obb/obb.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// How hits that are decided in the boxes' systems compare with those that are decided in the root system.
struct Comparison {
    std::uint64_t rays = 0, hits = 0, hit_or_miss = 0, other_primitive = 0;
    std::vector<double> errors;  ///< relative, of t, where the same primitive in a box is hit

    double per_million(std::uint64_t count) const
    {
        return 1e6 * static_cast<double>(count) / static_cast<double>(rays);
    }
    double percentile(double share)
    {
        const auto at = errors.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(errors.size() - 1));
        std::nth_element(errors.begin(), at, errors.end());
        return *at;
    }
    void add(const Scene& scene, const RayTile<float>& root, const RayTile<float>& local)
    {
        rays += static_cast<std::uint64_t>(root.count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(root.count); ++i) {
            const bool hit = root.primitive[i] != no_primitive;
            hits += hit;
            hit_or_miss += hit != (local.primitive[i] != no_primitive);
            if (!hit || local.primitive[i] == no_primitive) continue;
            const double error = std::abs(static_cast<double>(local.t_max[i]) - static_cast<double>(root.t_max[i])) /
                                 static_cast<double>(root.t_max[i]);
            if (root.primitive[i] == local.primitive[i] && scene.part(root.primitive[i]).group != 0)
                errors.push_back(error);
            other_primitive += root.primitive[i] != local.primitive[i] && error > 2e-5;
        }
    }
};

/// Rays like a camera's: from outside into the scene.
std::vector<TestRay> ordinary_rays(Random& random, int count)
{
    std::vector<TestRay> rays;
    while (static_cast<int>(rays.size()) < count) {
        const glm::dvec3 from = random.in_cube(30.0);
        if (glm::length(from) < 18.0) continue;
        rays.push_back({from, glm::normalize(random.in_cube(9.0) - from)});
    }
    return rays;
}

/// Three clusters of three boxes, most of what rays hit moves; 7 frames a scene.
Comparison compare(int scenes, int rays_per_frame, double offset)
{
    Comparison result;
    Random random(11);
    for (int seed = 1; seed <= scenes; ++seed) {
        const Scene scene = moving_scene(static_cast<std::uint64_t>(seed),
                                         {.scenery = 4,
                                          .clusters = 3,
                                          .triangles = 60,
                                          .boxes = 3,
                                          .motions = {Motion::rigid, Motion::grows, Motion::tiny, Motion::mirrors},
                                          .offset = glm::dvec3(offset, -offset, 0.5 * offset)});
        const auto root = obb::make_obb<float>(scene, {}),
                   local = obb::make_obb<float>(scene, {}, {.hits = obb::Hits::local});
        for (int frame = 1; frame < 8; ++frame) {
            const Pose now = pose(scene, scene.time_of(frame));
            root->update(now);
            local->update(now);
            const glm::dvec3 middle = glm::dvec3(offset, -offset, 0.5 * offset) - scene.origin;
            std::vector<TestRay> rays = ordinary_rays(random, rays_per_frame);
            for (TestRay& ray : rays) ray.origin += middle;
            for (std::size_t first = 0; first < rays.size(); first += RayTile<float>::capacity) {
                const auto a = make_tile<float>(rays, first), b = make_tile<float>(rays, first);
                root->closest(*a);
                local->closest(*b);
                result.add(scene, *a, *b);
            }
        }
    }
    return result;
}

void check_local_hits(int scenes, int rays_per_frame)
{
    for (const double offset : {0.0, 1e6}) {
        CAPTURE(offset);
        Comparison found = compare(scenes, rays_per_frame, offset);
        MESSAGE("offset " << offset << ": " << found.rays << " rays, " << found.hits << " hits, " << found.errors.size()
                          << " of them in boxes, hit or miss differs " << found.hit_or_miss << ", other primitive "
                          << found.other_primitive << ", |dt|/t p50 " << found.percentile(0.5) << ", p99.9 "
                          << found.percentile(0.999) << ", largest " << found.percentile(1.0));
        CHECK(static_cast<double>(found.errors.size()) > 0.1 * static_cast<double>(found.rays));
        CHECK(found.percentile(0.9) > 0.0);  // local hits are not the root's
        CHECK(found.percentile(0.999) <= 2e-5);
        CHECK(found.per_million(found.hit_or_miss) <= 10.0);
        CHECK(found.per_million(found.other_primitive) <= 10.0);
    }
}

}  // namespace

TEST_CASE("hits decided in the boxes' systems are those of the root system but for rounding, wherever the scene lies")
{
    check_local_hits(8, 10240);
}

TEST_CASE("hits decided in the boxes' systems, at length" * doctest::skip())
{
    check_local_hits(20, 51200);
}
