#include "bench/micro/terrain.h"

#include <cmath>

namespace firstray {
namespace {

/// Height at a place, of 0 to 1 each, and a time: waves, and every other small square stands up as a boulder.
double height(double x, double y, double time)
{
    const double hills = 0.05 * std::sin(9.0 * x + time) * std::cos(7.0 * y - time);
    const double boulders = 0.01 * std::max(0.0, std::sin(90.0 * x) * std::sin(90.0 * y));
    return hills + boulders;
}

glm::dvec3 corner(int i, int j, int side, double time)
{
    const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side;
    return {x, y, height(x, y, time)};
}

/// Calls add with the three corners, as (i, j), of every triangle.
template <typename Add>
void for_each_triangle(int side, const Add& add)
{
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const glm::ivec2 a(i, j), b(i + 1, j), c(i + 1, j + 1), d(i, j + 1);
            add({a, b, c});
            add({a, c, d});
        }
}

void add_static(Scene& scene, int side)
{
    const auto across = static_cast<std::size_t>(side);
    scene.positions.reserve((across + 1) * (across + 1));  // a hundred million triangles fit in memory but once
    scene.triangles.reserve(2 * across * across);
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) scene.positions.push_back(corner(i, j, side, 0.0));
    for_each_triangle(side, [&](const std::array<glm::ivec2, 3>& c) {
        const auto place = [&](const glm::ivec2& at) { return static_cast<std::uint32_t>(at.x + at.y * (side + 1)); };
        scene.triangles.push_back({.vertex = {place(c[0]), place(c[1]), place(c[2])}});
    });
}

void add_deforming(Scene& scene, int side)
{
    for_each_triangle(side, [&](const std::array<glm::ivec2, 3>& c) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        scene.deforming.push_back({static_cast<std::uint32_t>(scene.deforming_keys.size()), 2});
        scene.triangles.push_back({.vertex = {first, first + 1, first + 2}});
        for (int time = 0; time < 2; ++time) {
            DeformingKey& key = scene.deforming_keys.emplace_back();
            key.time = time;
            for (int k = 0; k < 3; ++k) {
                const glm::ivec2& at = c[static_cast<std::size_t>(k)];
                key.position[k] = corner(at.x, at.y, side, time);
                key.normal[k] = {0.0f, 0.0f, 1.0f};
            }
        }
        for (int k = 0; k < 3; ++k)
            scene.positions.push_back(scene.deforming_keys[scene.deforming.back().first_key].position[k]);
    });
}

}  // namespace

Scene make_terrain(std::size_t triangles, bool deforms)
{
    const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0))));
    Scene scene;
    scene.name = "terrain";
    scene.view = {.from = {0.5, -0.3, 0.4}, .at = {0.5, 0.5, 0.0}, .up = {0, 0, 1}, .hither = 0.01};
    scene.end = 1.0;
    scene.frames = 2;
    scene.lights.push_back({.position = {0.2, 0.3, 2.0}});
    scene.nodes.emplace_back();
    scene.materials.emplace_back();
    scene.groups.emplace_back();
    if (deforms)
        add_deforming(scene, side);
    else
        add_static(scene, side);
    Group group;
    group.deforming = deforms;
    group.triangles = static_cast<std::uint32_t>(scene.triangles.size());
    group.vertices = static_cast<std::uint32_t>(scene.positions.size());
    if (deforms)
        scene.groups.push_back(group);
    else
        scene.groups[0] = group;
    scene.parts.push_back({.group = deforms ? 1u : 0u, .count = group.triangles});
    scene.part_of_primitive.assign(group.triangles, 0);
    return scene;
}

}  // namespace firstray
