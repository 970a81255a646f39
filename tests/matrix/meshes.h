#pragma once
#include <glm/glm.hpp>

#include <map>
#include <vector>

#include "engine/scene/pose.h"
#include "tests/support/movers.h"

namespace firstray::matrix {

/// A closed mesh around the origin: what starts near the origin cannot leave without meeting it.
struct ClosedMesh {
    std::string name;
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    double room = 0.0;  ///< half the cube around the origin that is inside
};

/// The closed sphere of 528 triangles and radius 100.
inline ClosedMesh round_mesh()
{
    const Scene sphere = test::sphere_mesh(12, 100.0, glm::dvec3(0.0));
    ClosedMesh mesh{"sphere", sphere.positions, {}, 40.0};
    for (const TriangleIndices& t : sphere.triangles) mesh.triangles.push_back(t.vertex);
    return mesh;
}

/// The same with radii between 60 and 100, flattened to a twentieth: needles and steep edges.
inline ClosedMesh crumpled_mesh()
{
    ClosedMesh mesh = round_mesh();
    test::Random random(17);
    for (glm::dvec3& p : mesh.positions) p *= random.between(0.6, 1.0) * glm::dvec3(1.0, 0.05, 1.0);
    mesh.name = "crumpled";
    mesh.room = 1.0;
    return mesh;
}

/// A cube of edge 96 whose 432 triangles have their corners on whole coordinates, six to an edge: grids over it put
/// their planes where its edges are.
inline ClosedMesh aligned_mesh()
{
    constexpr int steps = 6, half = 48, step = 2 * half / steps;
    ClosedMesh mesh{"cube", {}, {}, 30.0};
    std::map<std::array<int, 3>, std::uint32_t> known;
    const auto vertex = [&](int axis, int side, int i, int j) {
        std::array<int, 3> at{};
        at[static_cast<std::size_t>(axis)] = side;
        at[static_cast<std::size_t>((axis + 1) % 3)] = i * step - half;
        at[static_cast<std::size_t>((axis + 2) % 3)] = j * step - half;
        const auto [place, is_new] = known.try_emplace(at, static_cast<std::uint32_t>(known.size()));
        if (is_new) mesh.positions.emplace_back(at[0], at[1], at[2]);
        return place->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-half, half})
            for (int i = 0; i < steps; ++i)
                for (int j = 0; j < steps; ++j) {
                    const auto at = [&](int a, int b) { return vertex(axis, side, i + a, j + b); };
                    mesh.triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
                    mesh.triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
                }
    return mesh;
}

/// A mesh as a scene: part of the scenery, its vertices at their places; or what a transform carries there, turned.
struct PlacedMesh {
    Scene scene;
    Transform place{};  ///< of what is carried; the identity for scenery

    PlacedMesh(const ClosedMesh& mesh, const glm::dvec3& offset, bool is_carried)
    {
        std::vector<glm::dvec3> positions = mesh.positions;
        if (!is_carried)
            for (glm::dvec3& p : positions) p += offset;
        scene = test::mesh_scene(std::move(positions), mesh.triangles);
        if (!is_carried) return;
        Scene carried = test::SmallScene().build();
        test::add_mover(carried, scene);
        scene = std::move(carried);
        place = {rotation_about(glm::normalize(glm::dvec3(1, 2, 3)), 0.7), offset};
    }
    Pose posed() const
    {
        Pose now = pose(scene, 0.0);
        if (scene.nodes.size() > 1) now.root_from_node[1] = place;
        return now;
    }
    /// Vertices where every strategy tests them.
    template <typename Real>
    std::vector<glm::dvec3> vertices(const Pose& now) const
    {
        const Group& group = scene.groups.back();
        std::vector<glm::vec<3, Real, glm::defaultp>> carried(group.vertices);
        carry_vertices(now, group, carried.data());
        return {carried.begin(), carried.end()};
    }
};

}  // namespace firstray::matrix
