#pragma once
#include <glm/glm.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/small_scene.h"

namespace firstray::test {

/// Reproducible random numbers, the same with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
    glm::dvec3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(unit() * n); }

private:
    std::mt19937_64 engine_;
};

struct TestRay {
    glm::dvec3 origin, direction;
    double t_min = 0.0, t_max = std::numeric_limits<double>::infinity();
};

/// Triangles of every size and shape: ordinary ones, slivers, needles, points, a few as large as everything, and
/// copies.
inline Scene random_scene(std::uint64_t seed, int triangles, const glm::dvec3& offset = glm::dvec3(0.0))
{
    Random random(seed);
    SmallScene small;
    const Material glass{.transmittance = 0.5f};
    for (int i = 0; i < triangles; ++i) {
        const double size = std::pow(10.0, random.between(-3.0, 0.5));
        const glm::dvec3 a = offset + random.in_cube(10.0);
        glm::dvec3 b = a + random.in_cube(size), c = a + random.in_cube(size);
        if (i % 17 == 3) c = a + (b - a) * 0.5 + random.in_cube(size * 1e-6);
        if (i % 61 == 5) c = b = a;
        if (i % 97 == 7) b = offset + random.in_cube(12.0), c = offset + random.in_cube(12.0);
        const Material material = i % 5 == 0 ? glass : Material{};
        small.triangle(material, a, b, c);
        if (i % 41 == 2) small.triangle(material, a, b, c);
    }
    for (int i = 0; i < triangles / 50; ++i)
        small.sphere(Material{}, offset + random.in_cube(10.0), random.between(0.01, 1.0));
    return small.build();
}

/// Rays that random ones would not find: along axes, from and to corners, through edges, on planes, tiny and huge
/// directions, from far away, with short intervals; and random ones.
inline std::vector<TestRay> awkward_rays(std::uint64_t seed, const Scene& scene, int count)
{
    Random random(seed);
    std::vector<TestRay> rays;
    const auto corner = [&] {
        return scene.positions[random.below(static_cast<std::uint32_t>(scene.positions.size()))];
    };
    const glm::dvec3 middle = corner();
    while (static_cast<int>(rays.size()) < count) {
        const glm::dvec3 from = middle + random.in_cube(15.0), to = corner();
        const glm::dvec3 half_way = (to + scene.positions[rays.size() % scene.positions.size()]) * 0.5;
        switch (rays.size() % 10) {
            case 0:
                rays.push_back({from, random.in_cube(1.0)});
                break;
            case 1:
                rays.push_back({from, to - from});
                break;
            case 2:
                rays.push_back({from, half_way - from});
                break;
            case 3: {
                glm::dvec3 axis(0.0);
                axis[static_cast<int>(random.below(3))] = random.unit() < 0.5 ? -1.0 : 1.0;
                rays.push_back({to - axis * random.between(0.0, 20.0), axis});
                break;
            }
            case 4:
                rays.push_back({to, random.in_cube(1.0)});
                break;
            case 5:
                rays.push_back({from, (to - from) * 0x1p-60});
                break;
            case 6:
                rays.push_back({from, (to - from) * 0x1p+70});
                break;
            case 7:
                rays.push_back({to + random.in_cube(1.0) * 1e6, glm::dvec3(0.0)});
                rays.back().direction = to - rays.back().origin;
                break;
            case 8: {
                const double end = random.between(0.5, 1.5);
                rays.push_back({from, to - from, end * random.unit(), end});
                break;
            }
            default: {
                glm::dvec3 flat = random.in_cube(1.0);
                flat[static_cast<int>(random.below(3))] = random.unit() < 0.5 ? 0.0 : -0.0;
                rays.push_back({half_way - flat * 3.0, flat});
            }
        }
    }
    return rays;
}

/// Rays from one point: to corners and edges, along axes and close to them, in all directions or in a narrow cone.
/// apex  rounded to float, so that the rays have it in common in every precision
inline std::vector<TestRay> rays_from(std::uint64_t seed, const Scene& scene, const glm::dvec3& apex, int count)
{
    Random random(seed);
    const auto corner = [&] {
        return scene.positions[random.below(static_cast<std::uint32_t>(scene.positions.size()))];
    };
    const glm::dvec3 from(glm::vec3{apex}), to = corner();
    const double narrow = 0.05 * glm::length(to - from);
    const bool everywhere = seed % 2 == 0;
    std::vector<TestRay> rays;
    while (static_cast<int>(rays.size()) < count) {
        const glm::dvec3 a = everywhere ? corner() : to + random.in_cube(narrow), b = everywhere ? corner() : a;
        TestRay ray{from, a - from};
        switch (rays.size() % 8) {
            case 0:
                ray.direction = (a + b) * 0.5 - from;
                break;
            case 1:
                ray.t_max = 1.0;
                break;
            case 2:
                ray.t_min = random.between(0.0, 1.0);
                ray.t_max = ray.t_min + random.between(-0.1, 1.0);
                break;
            case 3:
                ray.direction *= std::pow(10.0, random.between(-12.0, 12.0));
                break;
            case 4:
                if (everywhere) ray.direction = glm::dvec3(0.0);
                ray.direction[static_cast<int>(random.below(3))] = random.unit() < 0.5 ? 0.0 : -1.0;
                break;
            case 5:
                if (random.unit() < 0.05) ray.direction.x = std::numeric_limits<double>::quiet_NaN();
                if (random.unit() < 0.05) ray.direction.y = std::numeric_limits<double>::infinity();
                if (random.unit() < 0.05) ray.t_min = -1.0;
                break;
            default:
                break;
        }
        rays.push_back(ray);
    }
    return rays;
}

/// A tile of rays; it has a common apex where all of them have.
template <typename Real>
std::unique_ptr<RayTile<Real>> make_tile(const std::vector<TestRay>& rays, std::size_t first,
                                         RayMask mask = RayMask::all)
{
    auto tile = std::make_unique<RayTile<Real>>();
    tile->mask = mask;
    for (std::size_t i = first; i < std::min(rays.size(), first + static_cast<std::size_t>(tile->capacity)); ++i) {
        using Vec = typename RayTile<Real>::Vec;
        tile->set_origin(tile->count, Vec(rays[i].origin));
        tile->set_direction(tile->count, Vec(rays[i].direction));
        tile->set_interval(tile->count, static_cast<Real>(rays[i].t_min), static_cast<Real>(rays[i].t_max));
        ++tile->count;
    }
    tile->apex = tile->count > 0 ? tile->origin_of(0) : tile->apex;
    tile->common_apex = tile->count > 1;
    for (int i = 1; i < tile->count; ++i)
        tile->common_apex = tile->common_apex && rays[first + static_cast<std::size_t>(i)].origin == rays[first].origin;
    return tile;
}

/// A static mesh as a scene: one part, one material.
inline Scene mesh_scene(std::vector<glm::dvec3> positions, const std::vector<glm::uvec3>& triangles)
{
    Scene scene = SmallScene().scene;
    scene.materials.emplace_back();
    scene.positions = std::move(positions);
    for (const glm::uvec3& triangle : triangles) scene.triangles.push_back({.vertex = triangle});
    const auto count = static_cast<std::uint32_t>(triangles.size());
    scene.parts.push_back({.count = count});
    scene.groups[0].triangles = count;
    scene.groups[0].vertices = static_cast<std::uint32_t>(scene.positions.size());
    scene.part_of_primitive.assign(count, 0);
    return scene;
}

/// A closed sphere of triangles around a point, `rings` from pole to pole.
inline Scene sphere_mesh(int rings, double radius, const glm::dvec3& centre)
{
    const int around = 2 * rings;
    const auto vertex = [&](int ring, int turn) {
        return static_cast<std::uint32_t>(ring == 0 ? 0 : ring == rings ? 1 : 2 + (ring - 1) * around + turn % around);
    };
    std::vector<glm::dvec3> positions = {centre + glm::dvec3(0, radius, 0), centre - glm::dvec3(0, radius, 0)};
    for (int ring = 1; ring < rings; ++ring)
        for (int turn = 0; turn < around; ++turn) {
            const double theta = M_PI * ring / rings, phi = M_PI * turn / rings;
            positions.push_back(centre + radius * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                             std::sin(theta) * std::sin(phi)));
        }
    std::vector<glm::uvec3> triangles;
    for (int ring = 0; ring < rings; ++ring)
        for (int turn = 0; turn < around; ++turn) {
            const std::uint32_t a = vertex(ring, turn), b = vertex(ring, turn + 1), c = vertex(ring + 1, turn),
                                e = vertex(ring + 1, turn + 1);
            if (ring > 0) triangles.emplace_back(a, b, e);
            if (ring < rings - 1) triangles.emplace_back(a, e, c);
        }
    return mesh_scene(std::move(positions), triangles);
}

}  // namespace firstray::test
