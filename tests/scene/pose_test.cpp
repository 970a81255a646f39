#include "engine/scene/pose.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "tests/support/bart.h"
#include "tests/support/scene_files.h"

namespace firstray {
namespace {

using test::scene_of;

bool near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9)
{
    return glm::length(a - b) <= tolerance;
}

std::vector<glm::vec3> carried(const Pose& p)
{
    std::vector<glm::vec3> all;
    for (const Group& group : p.scene->groups) {
        std::vector<glm::vec3> vertices(group.vertices);
        carry_vertices(p, group, vertices.data());
        all.insert(all.end(), vertices.begin(), vertices.end());
    }
    return all;
}

template <typename Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

/// Box, in the root system, of the triangles below the dynamic node of that name.
DAabb box_below(const Pose& p, const std::string& name)
{
    const Scene& scene = *p.scene;
    DAabb box;
    for (PrimitiveId id = 0; id < scene.primitive_count(); ++id)
        for (std::uint32_t node = scene.part(id).node; node != none; node = scene.nodes[node].parent)
            if (scene.nodes[node].name == name)
                for (const glm::dvec3& corner : triangle_corners(p, id)) box.grow(corner);
    return box;
}

DAabb box_of_deforming(const Pose& p)
{
    DAabb box;
    for (PrimitiveId id = 0; id < p.scene->primitive_count(); ++id)
        if (p.scene->group(id).deforming)
            for (const glm::dvec3& corner : triangle_corners(p, id)) box.grow(corner);
    return box;
}

/// A BART scene, read once for all tests; null where it is missing.
const Scene* bart_scene(const std::string& name)
{
    static std::map<std::string, Scene> scenes;
    const auto file = test::bart_file(name);
    if (!file) return nullptr;
    const auto [entry, is_new] = scenes.try_emplace(name);
    if (is_new) entry->second = read_aff(*file);
    return &entry->second;
}

constexpr const char* triangle = "p 3 0 0 0 1 0 0 0 1 0\n";

}  // namespace

TEST_CASE("BART's cameras stand and look where the published animations have them")
{
    struct Row {
        const char* file;
        int frame;
        glm::dvec3 eye, direction;
    };
    const Row rows[] = {
        {"robots/Robot.aff", 0, {-3.5, 2, -203}, {0.059, 0.099, -0.993}},
        {"robots/Robot.aff", 208, {-2.159, 11.292, -165.320}, {-0.982, -0.115, 0.151}},
        {"robots/Robot.aff", 456, {-0.670, 5.298, 55.854}, {0.308, 0.001, 0.951}},
        {"robots/Robot.aff", 557, {0, 19.426, 83.372}, {0.084, -0.098, -0.992}},
        {"kitchen/kitchen.aff", 0, {3.75, 2.3, 3.6}, {-0.313, -0.420, -0.852}},
        {"kitchen/kitchen.aff", 410, {3.108, 0.481, 1.050}, {-0.681, -0.559, -0.474}},
        {"museum/museum5.aff", 0, {0, 1.8, -9}, {0, 0, 1}},
        {"museum/museum5.aff", 75, {3.000, 2.403, -0.977}, {-1.000, -0.001, -0.008}},
    };
    for (const Row& row : rows) {
        const Scene* scene = bart_scene(row.file);
        if (!scene) return;
        CAPTURE(row.file);
        CAPTURE(row.frame);
        const CameraPose camera = pose(*scene, scene->time_of(row.frame)).camera;
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(std::abs(camera.eye[axis] - row.eye[axis]) < 5.1e-4);
            CHECK(std::abs(camera.forward[axis] - row.direction[axis]) < 5.1e-4);
        }
        CHECK(near(camera.right, glm::cross(camera.forward, camera.up)));
        CHECK(glm::length(camera.right) == doctest::Approx(1.0));
    }
}

TEST_CASE("BART's moving things are where the published animations have them")
{
    struct Row {
        const char* file;
        const char* node;  // empty: what deforms
        int frame;
        glm::dvec3 lo, hi;
        double tolerance;
    };
    const Row rows[] = {
        {"robots/Robot.aff", "robot_transl1", 0, {-12.3010, -0.0420, -239.8072}, {-0.9974, 9.2121, -229.0876}, 1e-4},
        {"robots/Robot.aff", "robot_transl1", 400, {-14.6629, -0.1397, -114.7149}, {-3.2933, 9.4767, -104.0319}, 1e-4},
        {"robots/Robot.aff", "robot_transl10", 400, {-11.6891, -0.0800, -67.5785}, {-1.3934, 9.5047, -56.8572}, 1e-4},
        {"kitchen/kitchen.aff", "toycar", 0, {4.3121, 0, 2.6709}, {4.5761, 0.1378, 2.8293}, 1e-4},
        {"kitchen/kitchen.aff", "toycar", 400, {2.5777, 0, 0.4692}, {2.7750, 0.1378, 0.7575}, 1e-4},
        {"kitchen/kitchen.aff", "toycar", 799, {2.6709, 0, 3.3369}, {2.8293, 0.1378, 3.4689}, 1e-4},
        {"museum/museum5.aff", "", 0, {-0.4604, 1.4484, -0.4754}, {0.4621, 1.6007, 0.4745}, 1e-4},
        {"museum/museum5.aff", "", 150, {-0.503, 1.997, -0.503}, {0.503, 3.003, 0.503}, 1e-3},
        {"museum/museum5.aff", "", 299, {-0.75, 1.5, -0.6}, {1.25, 4.4, 0.55}, 1e-4},
    };
    for (const Row& row : rows) {
        const Scene* scene = bart_scene(row.file);
        if (!scene) return;
        CAPTURE(row.file);
        CAPTURE(row.node);
        CAPTURE(row.frame);
        const Pose p = pose(*scene, scene->time_of(row.frame));
        const DAabb box = *row.node ? box_below(p, row.node) : box_of_deforming(p);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(std::abs(box.lo[axis] - row.lo[axis]) < row.tolerance);
            CHECK(std::abs(box.hi[axis] - row.hi[axis]) < row.tolerance);
        }
    }
}

TEST_CASE("BART's scenes have the published bounds in frame 0")
{
    struct Row {
        const char* file;
        glm::dvec3 lo, hi;
    };
    const Row rows[] = {{"robots/Robot.aff", {-164.148, -0.620, -435.355}, {164.148, 535.355, 250.097}},
                        {"kitchen/kitchen.aff", {-2, -1.1, -3.75}, {6, 2.9, 4.33}},
                        {"museum/museum5.aff", {-5, -1.068, -9.938}, {5, 5, 5}}};
    for (const Row& row : rows) {
        const Scene* scene = bart_scene(row.file);
        if (!scene) return;
        const DAabb box = bounds(pose(*scene, scene->start));
        CAPTURE(row.file);
        CHECK(glm::length(box.lo - row.lo) < 1e-3);
        CHECK(glm::length(box.hi - row.hi) < 1e-3);
        CHECK(scene->origin == glm::dvec3(0.0));
    }
}

TEST_CASE("a pose depends on its time alone: frame 500 has the same bits after others")
{
    const auto file = test::bart_file("robots/Robot.aff");
    if (!file) return;
    const Scene fresh = read_aff(*file);
    const Pose alone = pose(fresh, fresh.time_of(500));
    const std::vector<glm::vec3> alone_vertices = carried(alone);

    const Scene used = read_aff(*file);
    for (const int frame : {0, 100, 499, 501, 799, 3}) carried(pose(used, used.time_of(frame)));
    const Pose after = pose(used, used.time_of(500));
    CHECK(same_bits(carried(after), alone_vertices));
    CHECK(same_bits(after.root_from_node, alone.root_from_node));
    CHECK(after.camera.eye == alone.camera.eye);
    CHECK(after.camera.forward == alone.camera.forward);
}

TEST_CASE("vertices are carried in double and rounded once")
{
    const Scene scene = scene_of(std::string("k a { transl 4 0 0.1 0 0 0 0 0  1 0.1 0 0 0 0 0  2 0.1 0 0 0 0 0"
                                             " 3 0.1 0 0 0 0 0 } x a { xs 0.3 0.3 0.3 0 0 1 30 7 8 9 {") +
                                 triangle + "} }");
    const Pose p = pose(scene, 0.0);
    const Group& group = scene.groups[1];
    std::vector<glm::vec3> rounded(group.vertices);
    std::vector<glm::dvec3> exact(group.vertices);
    carry_vertices(p, group, rounded.data());
    carry_vertices(p, group, exact.data());
    const auto corners = triangle_corners(p, group.first);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(rounded[i] == glm::vec3(exact[i]));
        CHECK(corners[i] ==
              exact[scene.triangles[group.first_triangle].vertex[static_cast<int>(i)] - group.first_vertex]);
    }
    CHECK(near(exact[1] + scene.origin, {7.1 + 0.3 * std::cos(glm::radians(30.0)), 8.0 + 0.15, 9.0}));
}

TEST_CASE("an invisible transform hides what is inside it, at its times")
{
    const Scene scene =
        scene_of(std::string("k a { visibility 2 1 0 2 1 } x a { x b { ") + triangle + "} }" + triangle);
    REQUIRE(scene.groups.size() == 2);
    CHECK(pose(scene, 0.5).is_visible(scene.groups[1]));
    CHECK_FALSE(pose(scene, 1.5).is_visible(scene.groups[1]));
    CHECK(pose(scene, 1.5).is_visible(scene.groups[0]));
    CHECK(pose(scene, 2.0).is_visible(scene.groups[1]));
    CHECK(pose(scene, 1.5).singular_nodes.empty());
}

TEST_CASE("a transform that is scaled to nothing hides what is inside it and is recorded once")
{
    const std::string k = "k a { scale 4 0 1 1 1 0 0 0  1 1 1 1 0 0 0  2 1 0 1 0 0 0  3 1 0 1 0 0 0 }";
    const Scene scene = scene_of(k + "x a { x b { " + triangle + "} }");
    CHECK(pose(scene, 1.0).is_visible(scene.groups[1]));
    CHECK(pose(scene, 1.0).singular_nodes.empty());
    const Pose flat = pose(scene, 2.0);
    CHECK_FALSE(flat.is_visible(scene.groups[1]));
    CHECK(flat.singular_nodes == std::vector<std::uint32_t>{1});
    CHECK(bounds(flat).empty());
}

TEST_CASE("a scene far from the world's origin gets an origin of its own, on round coordinates")
{
    const Scene scene = scene_of(
        "v from 1e6 0 5 at 1e6 0 0 up 0 1 0 angle 45 hither 1 resolution 8 8 l 1e6 7 0"
        " p 3 999999.5 -1 0 1000001 -1 0 1e6 1 0");
    CHECK(scene.origin == glm::dvec3(1e6, 0.0, 0.0));  // centre 1000000.25, diagonal 2.5: a multiple of 2
    const Pose p = pose(scene, 0.0);
    CHECK(near(p.camera.eye, {0.0, 0.0, 5.0}));
    CHECK(p.lights[0] == glm::dvec3(0.0, 7.0, 0.0));
    CHECK(p.root_from_node[0].offset == -scene.origin);
    CHECK(bounds(p).lo == glm::dvec3(-0.5, -1.0, 0.0));
    CHECK(bounds(p).hi == glm::dvec3(1.0, 1.0, 0.0));
}

TEST_CASE("a scene less than eight diagonals away keeps the world's origin")
{
    CHECK(scene_of("p 3 10 0 0 11 0 0 10 1 0").origin == glm::dvec3(0.0));
    CHECK(scene_of("p 3 1e6 5 5 1e6 5 5 1e6 5 5").origin == glm::dvec3(0.0));  // no size to compare with
    CHECK(scene_of("").origin == glm::dvec3(0.0));
}

TEST_CASE("the view shows what the camera's animation leaves out")
{
    const std::string view = "v from 0 0 10 at 0 0 0 up 0 2 0 angle 45 hither 1 resolution 8 8\n";
    const std::string move = "transl 4 0 5 0 0 0 0 0  1 5 0 0 0 0 0  2 6 0 0 0 0 0  3 6 0 0 0 0 0 ";
    const std::string turn = "rot 4 0 0 1 0 90 0 0 0  1 0 1 0 90 0 0 0  2 0 1 0 90 0 0 0  3 0 1 0 90 0 0 0 ";
    const Scene still = scene_of(view), moved = scene_of(view + "k camera { " + move + "}"),
                turned = scene_of(view + "k camera { " + turn + "}");
    CHECK(near(pose(still, 1.0).camera.eye, {0, 0, 10}));
    CHECK(near(pose(still, 1.0).camera.right, {1, 0, 0}));
    CHECK(near(pose(moved, 1.0).camera.eye, {5, 0, 0}));
    CHECK(near(pose(moved, 1.0).camera.forward, {0, 0, -1}));
    CHECK(near(pose(turned, 1.0).camera.eye, {0, 0, 10}));
    CHECK(near(pose(turned, 1.0).camera.forward, {-1, 0, 0}));
    CHECK(near(pose(turned, 1.0).camera.up, {0, 1, 0}));
}

TEST_CASE("a named light follows its translation, others stay")
{
    const Scene scene = scene_of(
        "la lamp 1 2 3  la lost 7 7 7  l 4 5 6"
        " k lamp { transl 4 0 9 0 0 0 0 0  1 9 0 0 0 0 0  2 0 9 0 0 0 0  3 0 9 0 0 0 0 }");
    CHECK(pose(scene, 0.0).lights[0] == glm::dvec3(9, 0, 0));
    CHECK(near(pose(scene, 5.0).lights[0], {0, 9, 0}));
    CHECK(pose(scene, 5.0).lights[1] == glm::dvec3(7, 7, 7));
    CHECK(pose(scene, 5.0).lights[2] == glm::dvec3(4, 5, 6));
}

TEST_CASE("deforming triangles blend positions, and normals as written")
{
    // The first normal is 100 times as long: halfway it hides the second.
    const Scene scene = scene_of(
        "tpa 3  1  0 0 0 100 0 0  1 0 0 100 0 0  0 1 0 100 0 0\n"
        "       2  0 0 4 0 1 0    1 0 4 0 1 0    0 1 4 0 1 0\n"
        "       4  0 0 8 0 0 0    1 0 8 0 0 0    0 1 8 0 0 0");
    REQUIRE(scene.groups.size() == 2);
    CHECK(scene.groups[1].deforming);
    CHECK(scene.groups[1].node == 0);
    const auto z_at = [&](double t) { return triangle_corners(pose(scene, t), 0)[0].z; };
    CHECK(z_at(0.0) == 0.0);
    CHECK(z_at(1.5) == 2.0);
    CHECK(z_at(2.0) == 4.0);
    CHECK(z_at(3.0) == 6.0);
    CHECK(z_at(9.0) == 8.0);
    const glm::dvec3 geometric(0, 0, 1);
    CHECK(near(shading_normal(pose(scene, 1.5), 0, 0.2, 0.3, geometric), glm::normalize(glm::dvec3(100, 1, 0))));
    CHECK(near(shading_normal(pose(scene, 2.0), 0, 0.2, 0.3, geometric), {0, 1, 0}));
    CHECK(near(shading_normal(pose(scene, 9.0), 0, 0.2, 0.3, geometric), {0, 0, 1}));  // the file's are zero
    std::vector<glm::vec3> vertices(3);
    carry_vertices(pose(scene, 3.0), scene.groups[1], vertices.data());
    CHECK(vertices[2] == glm::vec3(0, 1, 6));
}

TEST_CASE("normals go through the inverse transpose, statically and dynamically")
{
    const std::string body = "pp 3 0 0 0 1 1 0  1 0 0 1 1 0  0 1 0 1 1 0";
    const std::string k = "k a { scale 4 0 2 1 1 0 0 0  1 2 1 1 0 0 0  2 2 1 1 0 0 0  3 2 1 1 0 0 0 }";
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0.5, 1, 0));
    for (const std::string& text : {"xs 2 1 1 0 0 0 0 0 0 0 {" + body + "}", k + "x a {" + body + "}"}) {
        CAPTURE(text);
        const Scene scene = scene_of(text);
        CHECK(near(shading_normal(pose(scene, 1.0), 0, 0.3, 0.3, {0, 0, 1}), expected, 1e-6));
    }
}

TEST_CASE("a triangle without normals is shaded by its geometric normal")
{
    const Scene scene = scene_of(triangle);
    CHECK(shading_normal(pose(scene, 0.0), 0, 0.3, 0.3, {0, 0, -1}) == glm::dvec3(0, 0, -1));
}

TEST_CASE("quadrics have tight bounds and outward normals under non-uniform scales")
{
    const Scene scene = scene_of("xs 2 1 1 0 0 0 0 10 0 0 { s 0 0 0 1 }");
    const Pose p = pose(scene, 0.0);
    CHECK(near(bounds(p).lo, {8, -1, -1}));
    CHECK(near(bounds(p).hi, {12, 1, 1}));
    CHECK(near(quadric_normal(p, 0, {12, 0, 0}), {1, 0, 0}));
    const double s = std::sqrt(0.5);
    CHECK(near(quadric_normal(p, 0, {10 + 2 * s, s, 0}), glm::normalize(glm::dvec3(0.5, 1, 0))));
}

TEST_CASE("a cone's bounds hold both its circles; its normals lean by its slope")
{
    const Scene scene = scene_of("c 0 0 0 2  0 0 4 0  c 5 0 0 1  9 0 0 1");
    const Pose p = pose(scene, 0.0);
    CHECK(near(bounds(p).lo, {-2, -2, -1}));
    CHECK(near(bounds(p).hi, {9, 2, 4}));
    CHECK(near(quadric_normal(p, 0, {1, 0, 2}), glm::normalize(glm::dvec3(4, 0, 2))));
    CHECK(near(quadric_normal(p, 0, {0, 0, 4}), {0, 0, 1}));  // the tip
    CHECK(near(quadric_normal(p, 1, {7, 0, -1}), {0, 0, -1}));
}

}  // namespace firstray
