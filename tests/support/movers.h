#pragma once
#include <glm/glm.hpp>

#include "tests/support/test_rays.h"

namespace firstray::test {

/// Appends a static scene's primitives as a group that moves.
inline void add_mover(Scene& scene, const Scene& piece)
{
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    Group group = piece.groups[0];
    group.node = size(scene.nodes);
    group.first = size(scene.part_of_primitive);
    group.first_triangle = size(scene.triangles);
    group.first_quadric = size(scene.quadrics);
    group.first_vertex = size(scene.positions);
    scene.nodes.emplace_back();
    scene.nodes.back().parent = 0;
    scene.nodes.back().dynamic = true;
    for (TriangleIndices triangle : piece.triangles) {
        triangle.vertex += group.first_vertex;
        scene.triangles.push_back(triangle);
    }
    for (const std::uint32_t part : piece.part_of_primitive)
        scene.part_of_primitive.push_back(size(scene.parts) + part);
    for (Part part : piece.parts) {
        part.node = group.node;
        part.group = size(scene.groups);
        part.material += size(scene.materials);
        part.first += group.first;
        scene.parts.push_back(part);
    }
    scene.groups.push_back(group);
    scene.materials.insert(scene.materials.end(), piece.materials.begin(), piece.materials.end());
    scene.positions.insert(scene.positions.end(), piece.positions.begin(), piece.positions.end());
    scene.quadrics.insert(scene.quadrics.end(), piece.quadrics.begin(), piece.quadrics.end());
}

/// A random scene with so many random groups in it that poses may move.
inline Scene scene_with_movers(std::uint64_t seed, int scenery, int movers, int in_each)
{
    Random random(seed * 1000);
    Scene scene = random_scene(seed, scenery);
    for (int i = 0; i < movers; ++i)
        add_mover(scene, random_scene(seed * 1000 + static_cast<std::uint64_t>(i), in_each, random.in_cube(8.0)));
    return scene;
}

}  // namespace firstray::test
