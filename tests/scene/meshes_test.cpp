#include "engine/scene/meshes.h"

#include <doctest/doctest.h>

#include <limits>

#include "engine/core/errors.h"
#include "engine/scene/pose.h"

using namespace firstray;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

const std::vector<glm::vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<glm::uvec3> two = {{0, 1, 2}, {0, 2, 3}}, second = {{0, 2, 3}};

std::vector<glm::vec3> moved(std::vector<glm::vec3> points, const glm::vec3& by)
{
    for (glm::vec3& point : points) point += by;
    return points;
}

/// What adding says of a mesh; empty where it takes it.
std::string refusal(const Mesh& mesh, std::uint32_t group = Meshes::scenery)
{
    Meshes meshes;
    meshes.add({.positions = square, .indices = two});
    try {
        meshes.add(mesh, group);
    } catch (const Error& error) {
        CHECK(error.fault() == Fault::usage);
        CHECK(meshes.meshes() == 1);
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("a mesh is a part, and a group holds its meshes together however they were added")
{
    Meshes meshes;
    const std::uint32_t a = meshes.add_group("a"), b = meshes.add_group("b");
    CHECK(meshes.add({.positions = square, .indices = two}, b) == 0);
    CHECK(meshes.add({.positions = square, .indices = second}, a) == 1);
    CHECK(meshes.add({.positions = square, .indices = two}) == 2);
    CHECK(meshes.add({.positions = square, .indices = two}, a) == 3);
    const Scene scene = meshes.scene();
    REQUIRE(scene.groups.size() == 3);
    CHECK(scene.primitive_count() == 7);
    std::vector<std::uint32_t> order, nodes;
    for (const Part& part : scene.parts) {
        order.push_back(part.mesh);
        nodes.push_back(part.node);
    }
    CHECK(order == std::vector<std::uint32_t>{2, 1, 3, 0});
    CHECK(nodes == std::vector<std::uint32_t>{0, a, a, b});
    CHECK(scene.nodes[a].name == "a");
}

TEST_CASE("copied, shared and live vertices are found under their numbers, whatever their order")
{
    for (int kinds = 0; kinds < 27; ++kinds) {
        CAPTURE(kinds);
        const Vertices kind[] = {static_cast<Vertices>(kinds % 3), static_cast<Vertices>(kinds / 3 % 3),
                                 static_cast<Vertices>(kinds / 9)};
        std::vector<std::vector<glm::vec3>> memory;
        for (int i = 0; i < 3; ++i) memory.push_back(moved(square, {i, 10 * i, 0}));
        Meshes meshes;
        const std::uint32_t group = meshes.add_group();
        for (std::size_t i = 0; i < 3; ++i)
            meshes.add({.positions = memory[i], .indices = second, .vertices = kind[i]}, i == 1 ? 0 : group);
        const Scene scene = meshes.scene();
        CHECK(scene.vertex_count() == 12);
        for (PrimitiveId id = 0; id < scene.primitive_count(); ++id) {
            const std::uint32_t mesh = scene.part(id).mesh;
            const glm::uvec3 corner = scene.triangles[scene.triangle_slot(id)].vertex;
            for (int k = 0; k < 3; ++k) CHECK(scene.position(corner[k]) == glm::dvec3(memory[mesh][second[0][k]]));
        }
        for (const Group& g : scene.groups) CHECK(g.live == (g.deforming && g.triangles > 0));
    }
}

TEST_CASE("a scene keeps copied vertices and reads live ones where the caller has them")
{
    std::vector<glm::vec3> copied = square, live = square;
    Meshes meshes;
    meshes.add({.positions = copied, .indices = two});
    meshes.add({.positions = live, .indices = two, .vertices = Vertices::live});
    const Scene scene = meshes.scene();
    copied[0] = live[0] = {7, 8, 9};
    CHECK(triangle_corners(pose(scene, 0.0), 0)[0] == glm::dvec3(0));
    CHECK(triangle_corners(pose(scene, 0.0), 2)[0] == glm::dvec3(7, 8, 9));
}

TEST_CASE("only what triangles name is kept and checked")
{
    std::vector<glm::vec3> points(1000, glm::vec3(nan_value));
    points[500] = {0, 0, 0};
    points[501] = {1, 0, 0};
    points[503] = {0, 1, 0};
    const std::vector<glm::uvec3> triangle = {{500, 501, 503}};
    Meshes meshes;
    meshes.add({.positions = points, .indices = triangle});
    CHECK(meshes.scene().vertex_count() == 4);
    CHECK(triangle_corners(pose(meshes.scene(), 0.0), 0)[2] == glm::dvec3(0, 1, 0));
}

TEST_CASE("meshes without triangles and groups without meshes are taken and leave the numbers of others as they are")
{
    Meshes meshes;
    const std::uint32_t empty = meshes.add_group("empty"), full = meshes.add_group("full");
    meshes.add({}, full);
    meshes.add({.positions = square, .indices = two}, full);
    const Scene scene = meshes.scene();
    CHECK(scene.groups.size() == 2);  // the scenery is always there
    CHECK(scene.groups[1].node == full);
    CHECK(scene.part(0).mesh == 1);
    CHECK(empty == 1);
}

TEST_CASE("what is wrong with a mesh is named, and nothing of it is added")
{
    std::vector<glm::vec3> broken = square;
    broken[2].y = nan_value;
    const std::vector<glm::uvec3> beyond = {{0, 1, 2}, {0, 4, 3}};
    CHECK(refusal({.positions = broken, .indices = two}) == "mesh 1: vertex 2 is not finite, expected numbers");
    broken[2].y = std::numeric_limits<float>::infinity();
    CHECK(refusal({.positions = broken, .indices = two}) == "mesh 1: vertex 2 is not finite, expected numbers");
    CHECK(refusal({.positions = square, .indices = beyond}) ==
          "mesh 1: triangle 1 names vertex 4, expected an index below 4");
    CHECK(refusal({.positions = square, .indices = two}, 1) ==
          "mesh 1: there is no group 1, expected one that add_group made, or Meshes::scenery");
    CHECK(refusal({.positions = square, .indices = two}) == "");
}
