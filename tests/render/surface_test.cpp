#include "engine/render/shade.h"
#include "engine/render/surface.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/support/reference_strategy.h"
#include "tests/support/small_scene.h"

using namespace firstray;

namespace {

const Material grey;

}  // namespace

TEST_CASE("a triangle's surface lies at its barycentric weights, normals turned to the ray")
{
    test::SmallScene small;
    small.triangle(grey, {1, 1, -5}, {3, 1, -5}, {1, 4, -5});
    const Scene scene = small.build();
    const Pose at_start = pose(scene, 0.0);
    for (const double side : {1.0, -1.0}) {
        const RayHit hit{.direction = {0, 0, -side}, .t = 5.0, .u = 0.5, .v = 0.25, .primitive = 0};
        const Surface s = surface_at(at_start, {}, hit);
        CHECK(s.point == glm::dvec3(2.0, 1.75, -5.0));
        CHECK(s.geometric == glm::dvec3(0, 0, side));
        CHECK(s.normal == glm::dvec3(0, 0, side));
        CHECK(s.from_outside == (side > 0.0));
        CHECK(s.extent == 5.0);
        CHECK(s.place.colour() == glm::vec3(1.0f));
    }
}

TEST_CASE("a shading normal that points away from the ray is flipped")
{
    test::SmallScene small;
    small.triangle(grey, {0, 0, -5}, {1, 0, -5}, {0, 1, -5});
    small.scene.normals = {{0.6f, 0.0f, -0.8f}};
    small.scene.triangles[0].normal = glm::uvec3(0);
    const Scene scene = small.build();
    const RayHit hit{.direction = {0, 0, -1}, .t = 5.0, .u = 0.25, .v = 0.25, .primitive = 0};
    const Surface s = surface_at(pose(scene, 0.0), {}, hit);
    CHECK(s.from_outside);
    CHECK(s.geometric == glm::dvec3(0, 0, 1));
    CHECK(glm::distance(s.normal, {-0.6, 0.0, 0.8}) < 1e-7);
}

TEST_CASE("normals that cancel out and corners that coincide leave no NaN")
{
    test::SmallScene small;
    small.triangle(grey, {0, 0, -5}, {1, 0, -5}, {0, 1, -5});
    small.triangle(grey, {0, 0, -5}, {0, 0, -5}, {0, 0, -5});
    small.scene.normals = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}};
    small.scene.triangles[0].normal = {0, 1, 1};
    const Scene scene = small.build();
    const Pose at_start = pose(scene, 0.0);
    const RayHit cancelling{.direction = {0, 0, -1}, .t = 5.0, .u = 0.25, .v = 0.25, .primitive = 0};
    CHECK(surface_at(at_start, {}, cancelling).normal == glm::dvec3(0, 0, 1));
    const RayHit degenerate{.direction = {0.6, 0, -0.8}, .t = 5.0, .primitive = 1};
    CHECK(surface_at(at_start, {}, degenerate).geometric == glm::dvec3(-0.6, 0, 0.8));
    CHECK(glm::distance(surface_at(at_start, {}, degenerate).normal, {-0.6, 0, 0.8}) < 1e-15);
}

TEST_CASE("a triangle's texture is looked up at its interpolated coordinates")
{
    test::SmallScene small;
    small.triangle(grey, {0, 0, -5}, {1, 0, -5}, {0, 1, -5}).triangle(grey, {0, 0, -6}, {1, 0, -6}, {0, 1, -6});
    small.scene.uvs = {{0.25f, 0.5f}, {1.25f, 0.5f}, {-3.75f, 0.5f}};
    small.scene.triangles[0].uv = {0, 1, 2};
    Scene scene = small.build();
    scene.parts[0].texture = scene.parts[1].texture = 0;
    // Left texel red, right texel blue. At (1/4, 1/4, 1/2), u is -1.5: the same as 0.5, between the texels.
    const Texture textures[] = {{.width = 2, .height = 1, .pixels = {255, 0, 0, 0, 0, 255}}};
    const Pose at_start = pose(scene, 0.0);
    RayHit hit{.direction = {0, 0, -1}, .t = 5.0, .u = 0.25, .v = 0.5, .primitive = 0};
    CHECK(glm::distance(surface_at(at_start, textures, hit).place.colour(), {0.5f, 0.0f, 0.5f}) < 1e-6f);
    hit.u = hit.v = 0.0;
    CHECK(glm::distance(surface_at(at_start, textures, hit).place.colour(), {1.0f, 0.0f, 0.0f}) < 1e-6f);
    hit.primitive = 1;  // in a textured part, but without coordinates
    CHECK(surface_at(at_start, textures, hit).place.colour() == glm::vec3(1.0f));
}

TEST_CASE("a sphere's surface faces out, or in where the ray comes from inside")
{
    test::SmallScene small;
    small.sphere(grey, {0, 0, -10}, 2.0);
    const Scene scene = small.build();
    const Pose at_start = pose(scene, 0.0);
    const Surface out = surface_at(at_start, {}, {.direction = {0, 0, -1}, .t = 8.0, .primitive = 0});
    CHECK(out.point == glm::dvec3(0, 0, -8));
    CHECK(glm::distance(out.normal, {0, 0, 1}) < 1e-15);
    CHECK(out.from_outside);
    const RayHit from_inside{.origin = {0, 0, -10}, .direction = {0, 1, 0}, .t = 2.0, .primitive = 0};
    const Surface in = surface_at(at_start, {}, from_inside);
    CHECK(glm::distance(in.normal, {0, -1, 0}) < 1e-15);
    CHECK_FALSE(in.from_outside);
}

TEST_CASE("a point on a cone is exact although t is coarse")
{
    Scene scene = test::SmallScene().sphere(grey, {5, 0, 0}, 1.0).build();
    scene.quadrics[0].kind = Quadric::Kind::cone;  // axis from (5, 0, 0) to (5, 0, 1)
    scene.quadrics[0].r0 = 2.0;
    scene.quadrics[0].r1 = 1.0;
    const RayHit hit{.origin = {9, 0, 0.5}, .direction = {-1, 0, 0}, .t = 2.5001, .primitive = 0};
    const Surface s = surface_at(pose(scene, 0.0), {}, hit);
    CHECK(glm::distance(s.point, {6.5, 0, 0.5}) < 1e-14);
    CHECK(glm::distance(s.normal, glm::normalize(glm::dvec3(1, 0, 1))) < 1e-14);
    CHECK(s.extent == 6.5);
}

TEST_CASE_TEMPLATE("rays that leave a surface begin beside it, at a distance that scales with the scene", Real, float,
                   double)
{
    test::SmallScene small;
    small.triangle(grey, {0, 0, -5}, {1, 0, -5}, {0, 1, -5});
    const Scene scene = small.build();
    const Surface s = surface_at(pose(scene, 0.0), {}, {.direction = {0, 0, -1}, .t = 5.0, .u = 0.25, .primitive = 0});
    const double off = self_hit_margin<Real> * 5.0;
    CHECK(start_of_ray<Real>(s, {0.6, 0, 0.8}).z == -5.0 + off);
    CHECK(start_of_ray<Real>(s, {0.6, 0, -0.8}).z == -5.0 - off);
    CHECK(end_of_shadow_ray<Real>(s, {0, 3, 0}).z == -5.0 + off);
    CHECK(end_of_shadow_ray<Real>(s, {0, 300, 0}).z == -5.0 + 60.0 * off);
}

TEST_CASE_TEMPLATE("no ray that leaves a triangle meets it again, whatever its size and place", Real, float, double)
{
    const auto rays = std::make_unique<RayTile<Real>>();
    unsigned state = 1;
    const auto random = [&] { return static_cast<double>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24; };
    const auto random_point = [&] { return 2.0 * glm::dvec3(random(), random(), random()) - 1.0; };
    int hits = 0, self_hits = 0, from_apexes = 0, turned = 0;
    for (int round = 0; round < 4000; ++round) {
        const double scale = std::exp2(std::floor(60.0 * random() - 30.0));
        const glm::dvec3 place = scale * std::exp2(10.0 * random()) * random_point();
        test::SmallScene small;
        small.triangle(grey, place + scale * random_point(), place + scale * random_point(),
                       place + scale * random_point());
        const Scene scene = small.build();
        const Pose at_start = pose(scene, 0.0);
        test::ReferenceStrategy<Real> strategy;
        strategy.update(at_start);
        const auto aim = [&](const glm::dvec3& origin, const glm::dvec3& direction, Real end, Real begin = 0) {
            rays->count = 1;
            rays->set_origin(0, typename RayTile<Real>::Vec(origin));
            rays->set_direction(0, typename RayTile<Real>::Vec(direction));
            rays->set_interval(0, begin, end);
            strategy.closest(*rays);
            return rays->primitive[0] != no_primitive;
        };
        const auto corners = triangle_corners(at_start, 0);
        const double u = random(), v = (1.0 - u) * random();
        const glm::dvec3 target = (1.0 - u - v) * corners[0] + u * corners[1] + v * corners[2];
        const glm::dvec3 eye = place + 3.0 * scale * random_point();
        if (!aim(eye, glm::normalize(target - eye), std::numeric_limits<Real>::infinity())) continue;
        ++hits;
        const Surface s = surface_at(at_start, {}, ray_hit(*rays, 0));
        const auto aim_from = [&](const std::optional<glm::dvec3>& apex, const glm::dvec3& direction) {
            const auto ray = apex ? ray_from_apex<Real>(s, *apex) : std::nullopt;
            if (!ray) return;
            ++from_apexes;
            const glm::dvec3 way(ray->direction);
            turned += glm::length(glm::normalize(way) - direction) > 1e-4;
            self_hits += aim(glm::dvec3(ray->apex), way, std::numeric_limits<Real>::infinity(), ray->t_min);
        };
        aim_from(reflected_origin(s), reflected_direction(s));
        aim_from(transmitted_origin(s), transmitted_direction(s));
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3 d = glm::normalize(random_point());
            self_hits += aim(start_of_ray<Real>(s, d), d, std::numeric_limits<Real>::infinity());
            const glm::dvec3 light = place + 10.0 * scale * random_point();
            const glm::dvec3 apex{typename RayTile<Real>::Vec(light)};
            if (glm::dot(s.geometric, light - s.point) < 0.0) continue;
            self_hits += aim(light, end_of_shadow_ray<Real>(s, light) - apex, Real(1));
        }
    }
    CHECK(hits > 3000);
    CHECK(from_apexes > 3000);
    CHECK(turned == 0);
    CHECK(self_hits == 0);
}

TEST_CASE("rays from one point that a plane mirrors come from one point, those that anything else mirrors do not")
{
    test::SmallScene small;
    small.quad(grey, {0, 0, -5}, {4, 0, 0}, {0, 4, 0});
    const Scene scene = small.build();
    const Pose at_start = pose(scene, 0.0);
    const glm::dvec3 eye(1.0, 2.0, 3.0);
    for (const double u : {0.1, 0.3, 0.6}) {
        const auto corners = triangle_corners(at_start, u < 0.5 ? 0 : 1);
        const glm::dvec3 place = (0.9 - u) * corners[0] + u * corners[1] + 0.1 * corners[2];
        Surface s = surface_at(
            at_start, {},
            {.origin = eye, .direction = place - eye, .t = 1.0, .u = u, .v = 0.1, .primitive = u < 0.5 ? 0u : 1u});
        REQUIRE(reflected_origin(s));
        CHECK(glm::length(*reflected_origin(s) - glm::dvec3(1.0, 2.0, -13.0)) < 1e-12);
        const auto ray = ray_from_apex<float>(s, *reflected_origin(s));
        REQUIRE(ray);
        CHECK(ray->apex == glm::vec3(1.0f, 2.0f, -13.0f));
        CHECK(glm::length(glm::dvec3(ray->direction) - (place - glm::dvec3(ray->apex))) < 1e-6);
        CHECK(ray->t_min > 1.0f);
        CHECK(ray->t_min < 1.0001f);
        CHECK(transmitted_origin(s) == eye);
        CHECK(!ray_from_apex<float>(s, s.point + 1e-4 * s.geometric));  // rounding would turn it
        CHECK(!ray_from_apex<float>(s, s.point + 1e3 * s.geometric));
        CHECK(!ray_from_apex<float>(s, s.point + 3.0 * glm::cross(s.geometric, glm::dvec3(0.6, 0.8, 0.0))));
        s.normal = glm::normalize(s.normal + glm::dvec3(1e-3, 0.0, 0.0));
        CHECK(!reflected_origin(s));
        const Material glass{.transmittance = 0.5f, .ior = 1.5f};
        s.material = &glass;
        CHECK(!transmitted_origin(s));
    }
}

TEST_CASE_TEMPLATE("no ray that leaves a sphere outwards meets it again, however far the ray came that found it", Real,
                   float, double)
{
    test::SmallScene small;
    small.sphere(grey, {0.1, 0.2, 0.3}, 1.0);
    const Scene scene = small.build();
    const Pose at_start = pose(scene, 0.0);
    test::ReferenceStrategy<Real> strategy;
    strategy.update(at_start);
    const auto rays = std::make_unique<RayTile<Real>>();
    const auto aim = [&](const glm::dvec3& origin, const glm::dvec3& direction) {
        rays->count = 1;
        rays->set_origin(0, typename RayTile<Real>::Vec(origin));
        rays->set_direction(0, typename RayTile<Real>::Vec(direction));
        rays->set_interval(0, Real(0));
        strategy.closest(*rays);
        return rays->primitive[0] != no_primitive;
    };
    int hits = 0, self_hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 eye(200.0 + i, 100.0, -50.0), place_seen(0.1, 0.2 + 0.0009 * i, 0.3);
        if (!aim(eye, glm::normalize(place_seen - eye))) continue;
        ++hits;
        const Surface s = surface_at(at_start, {}, ray_hit(*rays, 0));
        for (const glm::dvec3& aside : {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 0.9), glm::dvec3(0, 0.9, 0)}) {
            const glm::dvec3 d = glm::normalize(s.normal + aside);
            self_hits += aim(start_of_ray<Real>(s, d), d);
        }
    }
    CHECK(hits == 1000);
    CHECK(self_hits == 0);
}
