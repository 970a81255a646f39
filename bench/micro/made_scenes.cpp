#include "bench/micro/made_scenes.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "engine/core/errors.h"
#include "engine/render/camera_rays.h"
#include "engine/scene/pose.h"

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

void add_static_terrain(Scene& scene, int side)
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

using Corners = std::array<glm::dvec3, 3>;

void add_static(Scene& scene, const Corners& corners)
{
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.triangles.push_back({.vertex = {first, first + 1, first + 2}});
    scene.positions.insert(scene.positions.end(), corners.begin(), corners.end());
}

/// Corners at the times 0 and 1.
void add_deforming(Scene& scene, const Corners& before, const Corners& after)
{
    scene.deforming.push_back({static_cast<std::uint32_t>(scene.deforming_keys.size()), 2});
    add_static(scene, before);
    for (int time = 0; time < 2; ++time) {
        DeformingKey& key = scene.deforming_keys.emplace_back();
        key.time = time;
        for (int k = 0; k < 3; ++k) key.position[k] = (time == 0 ? before : after)[static_cast<std::size_t>(k)];
        for (glm::vec3& normal : scene.deforming_normals.emplace_back().corner) normal = {0.0f, 0.0f, 1.0f};
    }
}

Scene empty_scene(std::string_view name)
{
    Scene scene;
    scene.name = name;
    scene.view = {.from = {0.5, -0.3, 0.4}, .at = {0.5, 0.5, 0.0}, .up = {0, 0, 1}, .hither = 0.01};
    scene.end = 1.0;
    scene.frames = 2;
    scene.lights.push_back({.position = {0.2, 0.3, 2.0}});
    scene.nodes.emplace_back();
    scene.materials.emplace_back();
    scene.groups.emplace_back();
    return scene;
}

/// Puts all triangles into a group.
void finish(Scene& scene, bool deforms)
{
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
}

Scene make_terrain(std::size_t triangles, bool deforms)
{
    const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0))));
    Scene scene = empty_scene("terrain");
    if (deforms)
        for_each_triangle(side, [&](const std::array<glm::ivec2, 3>& c) {
            const auto at = [&](double time) {
                return Corners{corner(c[0].x, c[0].y, side, time), corner(c[1].x, c[1].y, side, time),
                               corner(c[2].x, c[2].y, side, time)};
            };
            add_deforming(scene, at(0.0), at(1.0));
        });
    else
        add_static_terrain(scene, side);
    finish(scene, deforms);
    return scene;
}

/// Triangles of the size that n of them have apart, each drifting its own way.
Scene make_cloud(std::size_t triangles, bool deforms)
{
    Scene scene = empty_scene("cloud");
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()); };
    const auto vector = [&] { return glm::dvec3{number(), number(), number()}; };  // braces: in this order
    const double size = 1.0 / std::cbrt(static_cast<double>(triangles));
    for (std::size_t i = 0; i < triangles; ++i) {
        const glm::dvec3 place = vector(), drift = 4.0 * size * (vector() - 0.5);
        Corners before, after;
        for (std::size_t k = 0; k < 3; ++k) {
            before[k] = place + size * (vector() - 0.5);
            after[k] = before[k] + drift;
        }
        if (deforms)
            add_deforming(scene, before, after);
        else
            add_static(scene, before);
    }
    finish(scene, deforms);
    return scene;
}

}  // namespace

std::span<const MadeScene> made_scenes()
{
    static constexpr MadeScene scenes[] = {{"terrain", &make_terrain}, {"cloud", &make_cloud}};
    return scenes;
}

std::unique_ptr<RayTile<float>> small_picture(const Pose& now, bool common_apex)
{
    constexpr int side = 16, block = 4;
    auto tile = std::make_unique<RayTile<float>>();
    std::vector<glm::ivec2> pixels;
    for (int b = 0; b < side * side / (block * block); ++b)
        for (int i = 0; i < block * block; ++i)
            pixels.emplace_back(b % (side / block) * block + i % block, b / (side / block) * block + i / block);
    aim(camera_rays(now, side, side), pixels, glm::dvec2(0.5), *tile);
    if (common_apex) return tile;
    for (int i = 0; i < tile->count; ++i) tile->set_origin(i, tile->apex);
    tile->common_apex = false;
    return tile;
}

void reset(RayTile<float>& tile)
{
    for (int i = 0; i < tile.count; ++i) tile.set_interval(i, tile.t_min[static_cast<std::size_t>(i)]);
}

void check_hits(const RayTile<float>& found, const RayTile<float>& right, const std::string& name)
{
    for (int lane = 0; lane < found.count; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        const bool same = found.primitive[i] == right.primitive[i] ||
                          std::abs(found.t_max[i] - right.t_max[i]) < 1e-4f * right.t_max[i];
        if (!same) throw Error(Fault::rendering, name + " gives wrong answers");
    }
}

}  // namespace firstray
