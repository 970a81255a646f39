#include "scenes/generator/mesh.h"

#include <doctest/doctest.h>

#include <array>
#include <map>

using namespace firstray;
using namespace firstray::scenes;

namespace {

using Place = std::array<long, 3>;

Place place_of(const glm::dvec3& p)
{
    return {std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6)};
}

/// Edges, by place, that are not met once each way.
int open_edges(const Mesh& mesh)
{
    std::map<std::pair<Place, Place>, int> edges;
    for (const Mesh::Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const Place a = place_of(mesh.positions[t.vertex[i]]), b = place_of(mesh.positions[t.vertex[(i + 1) % 3]]);
            if (a != b) ++edges[{a, b}], --edges[{b, a}];
        }
    int open = 0;
    for (const auto& [edge, count] : edges) open += count != 0;
    return open;
}

double volume(const Mesh& mesh)
{
    double six = 0.0;
    for (const Mesh::Triangle& t : mesh.triangles)
        six += glm::dot(mesh.positions[t.vertex.x], glm::cross(mesh.positions[t.vertex.y], mesh.positions[t.vertex.z]));
    return six / 6.0;
}

/// Triangles whose normals point away from the side that they are wound about.
int turned_normals(const Mesh& mesh)
{
    int turned = 0;
    for (const Mesh::Triangle& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.vertex.x],
                         flat = glm::cross(mesh.positions[t.vertex.y] - a, mesh.positions[t.vertex.z] - a);
        for (int i = 0; i < 3; ++i) turned += glm::dot(flat, mesh.normals[t.normal[i]]) < 0.0;
    }
    return turned;
}

constexpr glm::dvec2 vase[] = {{0.0, 0.0}, {1.0, 0.0}, {1.5, 1.0}, {0.5, 2.0}, {0.5, 2.5}, {0.0, 2.6}};

}  // namespace

TEST_CASE("balls, turned and rounded shapes are closed, face outwards and are as large as they should be")
{
    const Mesh sphere = ball(2.0, 40, 80), turned = lathe(vase, 12), rounded = rounded_box({1.0, 2.0, 3.0}, 0.25, 3);
    for (const Mesh* mesh : {&sphere, &turned, &rounded}) {
        CHECK(open_edges(*mesh) == 0);
        CHECK(turned_normals(*mesh) == 0);
        for (const glm::dvec3& n : mesh->normals) REQUIRE(glm::length(n) == doctest::Approx(1.0));
    }
    CHECK(volume(sphere) == doctest::Approx(4.0 / 3.0 * M_PI * 8.0).epsilon(0.01));
    CHECK(volume(rounded) == doctest::Approx(48.0).epsilon(0.03));
    CHECK(volume(turned) > 0.0);
    CHECK(rounded.triangles.size() == 12 * 49);
    Mesh box;
    add_box(box, {0, 0, 0}, {1, 2, 3});
    CHECK(open_edges(box) == 0);
    CHECK(volume(box) == doctest::Approx(6.0));
}

TEST_CASE("sharp bends of a turned shape have two normals, gentle ones share theirs")
{
    constexpr glm::dvec2 sharp[] = {{1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}},
                         gentle[] = {{1.0, 0.0}, {1.0, 1.0}, {0.9, 2.0}};
    CHECK(lathe(sharp, 8).normals.size() == 4 * 8);
    CHECK(lathe(gentle, 8).normals.size() == 3 * 8);
}

TEST_CASE("tubes and surfaces face outwards and up")
{
    const glm::dvec3 path[] = {{0, 0, 0}, {0, 1, 0}, {0.5, 2, 0}, {2, 2, 1}};
    const double radius[] = {0.3, 0.2, 0.2, 0.1};
    const Mesh pipe = tube(path, radius, 7);
    CHECK(turned_normals(pipe) == 0);
    CHECK(pipe.triangles.size() == 3 * 7 * 2);
    const Mesh hill = surface(5, 4, [](double u, double v) { return glm::dvec3(u, 0.2 * u * v, -v); }, {3, 2});
    CHECK(turned_normals(hill) == 0);
    CHECK(hill.triangles.size() == 40);
    for (const glm::dvec3& n : hill.normals) CHECK(n.y > 0.9);
    CHECK(hill.uvs.back() == glm::dvec2(3, 2));
}

TEST_CASE("parts of a mesh make up the mesh, without what they do not use")
{
    const Mesh whole = ball(1.0, 8, 12);
    const auto upper = [](const glm::dvec3& p) { return p.y > 0.1; };
    const Mesh top = part_of(whole, upper), rest = part_of(whole, [&](const glm::dvec3&p) { return !upper(p); });
    CHECK(top.triangles.size() + rest.triangles.size() == whole.triangles.size());
    CHECK(top.triangles.size() > 0);
    CHECK(top.positions.size() < whole.positions.size());
    Mesh joined = top;
    append(joined, rest);
    CHECK(volume(joined) == doctest::Approx(volume(whole)));
    CHECK(turned_normals(joined) == 0);
}

TEST_CASE("a part that is appended goes where its transform says, its normals too")
{
    Mesh mesh;
    append(mesh, ball(1.0, 10, 20), shift({5, 0, 0}) * turn({0, 0, 1}, 30) * size({1, 3, 1}));
    CHECK(turned_normals(mesh) == 0);
    CHECK(volume(mesh) == doctest::Approx(4.0 * M_PI).epsilon(0.05));
    snap(mesh, 0.25);
    for (const glm::dvec3& p : mesh.positions) CHECK(p.x * 4.0 == std::round(p.x * 4.0));
}
