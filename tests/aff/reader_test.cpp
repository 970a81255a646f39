#include "engine/aff/reader.h"
#include "engine/core/errors.h"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/scene/pose.h"
#include "tests/support/scene_files.h"

namespace firstray {
namespace {

using test::scene_of;
using test::TempFolder;

constexpr const char* triangle = " p 3 0 0 0 1 0 0 0 1 0 ";

bool near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9)
{
    return glm::length(a - b) <= tolerance;
}

glm::dvec3 corner(const Scene& scene, PrimitiveId id, std::size_t k)
{
    return triangle_corners(pose(scene, scene.start), id)[k] + scene.origin;
}

glm::vec2 uv(const Scene& scene, PrimitiveId id, int k)
{
    return scene.uvs[scene.triangles[scene.triangle_slot(id)].uv[k]];
}

std::string still_at(double x)
{
    std::string text = " { transl 4";
    for (int i = 0; i < 4; ++i) text += " " + std::to_string(i) + " " + std::to_string(x) + " 0 0 0 0 0";
    return text + " } ";
}

}  // namespace

TEST_CASE("an empty file is an empty scene with the format's defaults")
{
    const Scene scene = scene_of("");
    CHECK(scene.name == "main");
    CHECK(scene.primitive_count() == 0);
    REQUIRE(scene.groups.size() == 1);
    CHECK(scene.groups[0].node == 0);
    CHECK(scene.nodes.size() == 1);
    CHECK(scene.ambient == glm::vec3(1.0f));
    CHECK(scene.background == glm::vec3(0.0f));
    CHECK(scene.frames == 1);
    CHECK(scene.census.files == 1);
    CHECK(scene.census.bytes == 0);
}

TEST_CASE("settings are read: view, background, ambient light, times")
{
    const Scene scene = scene_of(
        "v from 1 2 3 at 4 5 6 up 0 0 1 angle 30.5 hither 0.5 resolution 640 480\n"
        "b .25 .5 1 am 2.5 2 1 a -1 5 300");
    CHECK(scene.view.from == glm::dvec3(1, 2, 3));
    CHECK(scene.view.at == glm::dvec3(4, 5, 6));
    CHECK(scene.view.up == glm::dvec3(0, 0, 1));
    CHECK(scene.view.angle == 30.5);
    CHECK(scene.view.hither == 0.5);
    CHECK(scene.view.width == 640);
    CHECK(scene.view.height == 480);
    CHECK(scene.background == glm::vec3(0.25f, 0.5f, 1.0f));
    CHECK(scene.ambient == glm::vec3(2.5f, 2.0f, 1.0f));
    CHECK(scene.start == -1.0);
    CHECK(scene.end == 5.0);
    CHECK(scene.frames == 300);
}

TEST_CASE("a near plane below 0.0001 becomes 1")
{
    const auto hither = [](const std::string& h) {
        return scene_of("v from 0 0 0 at 0 0 1 up 0 1 0 angle 30 hither " + h + " resolution 4 4").view.hither;
    };
    CHECK(hither("0.0000999") == 1.0);
    CHECK(hither("-3") == 1.0);
    CHECK(hither("0.0001") == 0.0001);
}

TEST_CASE("a light's colour is optional")
{
    const Scene scene = scene_of("l 1 2 3 l 4 5 6 .5 .25 2 la lamp 7 8 9 l -1 -2 -3 1 0 0 # end");
    REQUIRE(scene.lights.size() == 4);
    CHECK(scene.lights[0].colour == glm::vec3(1.0f));
    CHECK(scene.lights[1].position == glm::dvec3(4, 5, 6));
    CHECK(scene.lights[1].colour == glm::vec3(0.5f, 0.25f, 2.0f));
    CHECK(scene.lights[2].colour == glm::vec3(1.0f));
    CHECK(scene.lights[3].colour == glm::vec3(1.0f, 0.0f, 0.0f));
}

TEST_CASE("a light in a static transform stands in its system")
{
    CHECK(scene_of("xs 2 2 2 0 0 0 0 10 0 0 { l 1 1 1 }").lights[0].position == glm::dvec3(12, 2, 2));
}

TEST_CASE("materials are read in both forms")
{
    const Scene scene = scene_of(std::string("f 1 .5 .25  .5 .125 20 .3 1.5") + triangle +
                                 "fm 1 2 3 4 5 6 7 8 9 10 0.5 1.25" + triangle);
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].ambient == glm::vec3(0.0f));  // NFF has none
    CHECK(scene.materials[0].diffuse == glm::vec3(0.5f, 0.25f, 0.125f));
    CHECK(scene.materials[0].specular == glm::vec3(0.125f));
    CHECK(scene.materials[0].shine == 20.0f);
    CHECK(scene.materials[0].transmittance == 0.3f);
    CHECK(scene.materials[0].ior == 1.5f);
    CHECK(scene.materials[1].ambient == glm::vec3(1, 2, 3));
    CHECK(scene.materials[1].diffuse == glm::vec3(4, 5, 6));
    CHECK(scene.materials[1].specular == glm::vec3(7, 8, 9));
    CHECK(scene.materials[1].shine == 10.0f);
    CHECK(scene.materials[1].ior == 1.25f);
}

TEST_CASE("the material is one global state: braces and includes do not restore it, later ones do not reach back")
{
    const TempFolder folder;
    folder.write("red.aff", "fm 1 0 0 1 0 0 0 0 0 0 0 0");
    const Scene scene = read_aff(folder.write("main.aff", std::string("fm 0 0 1 0 0 1 0 0 0 0 0 0") + triangle +
                                                              "xs 1 1 1 0 0 0 0 0 0 0 { i 0 red.aff }" + triangle +
                                                              "x a { fm 0 1 0 0 1 0 0 0 0 0 0 0 }" + triangle));
    CHECK(scene.material(0).diffuse == glm::vec3(0, 0, 1));
    CHECK(scene.material(1).diffuse == glm::vec3(1, 0, 0));
    CHECK(scene.material(2).diffuse == glm::vec3(0, 1, 0));
}

TEST_CASE("materials that were never set or are equal are stored once")
{
    const Scene scene = scene_of(std::string(triangle) + "fm 0 0 1 0 0 1 0 0 0 0 0 0" + triangle +
                                 "fm 0 0 1 0 0 1 0 0 0 0 0 0.0 fm -0 0 1 0 0 1 0 0 0 0 0 0" + triangle);
    CHECK(scene.materials.size() == 2);
    CHECK(scene.materials[0] == Material{});
    CHECK(scene.part(1).material == scene.part(2).material);
}

TEST_CASE("spheres and cones; a negative radius shows the inside only")
{
    const Scene scene = scene_of("s 1 2 3 4 s 0 0 0 -2 c 1 1 1 2 1 1 5 1 c 0 0 0 -2 0 9 0 -4");
    REQUIRE(scene.quadrics.size() == 4);
    const auto& q = scene.quadrics;
    CHECK(q[0].group_from_quadric.offset == glm::dvec3(1, 2, 3));
    CHECK(q[0].group_from_quadric.linear == glm::dmat3(4.0));
    CHECK_FALSE(q[0].inside_only);
    CHECK(q[1].inside_only);
    CHECK(q[1].group_from_quadric.linear == glm::dmat3(2.0));
    CHECK(q[2].kind == Quadric::Kind::cone);
    CHECK(q[2].r1 / q[2].r0 == 0.5);
    CHECK(near(q[2].group_from_quadric.point({0, 0, 1}), {1, 1, 5}));
    CHECK(glm::length(q[2].group_from_quadric.vector({q[2].r0, 0, 0})) == doctest::Approx(2.0));
    CHECK(glm::length(q[2].group_from_quadric.vector({0, q[2].r1, 0})) == doctest::Approx(1.0));
    CHECK(q[3].inside_only);
    CHECK(q[3].r0 / q[3].r1 == 0.5);
    for (const Quadric& quadric : q) CHECK(glm::determinant(quadric.group_from_quadric.linear) > 0.0);
}

TEST_CASE("cones along every axis have circles at right angles to it")
{
    for (const char* apex : {"1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1", "1 2 -3", "1e-9 0 -1"}) {
        CAPTURE(apex);
        const glm::dmat3 m = scene_of("c 0 0 0 1 " + std::string(apex) + " 1").quadrics[0].group_from_quadric.linear;
        CHECK(std::abs(glm::dot(m[0], m[1])) < 1e-12);
        CHECK(std::abs(glm::dot(m[0], m[2])) < 1e-12);
        CHECK(std::abs(glm::dot(m[1], m[2])) < 1e-12);
        CHECK(glm::length(m[0]) == doctest::Approx(1.0));
        CHECK(glm::length(m[1]) == doctest::Approx(1.0));
    }
}

TEST_CASE("polygons become fans, with normals when they have some")
{
    const Scene scene = scene_of("p 4 0 0 0 2 0 0 2 2 0 0 2 0  pp 3 0 0 0 0 0 2  1 0 0 0 2 0  0 1 0 2 0 0");
    REQUIRE(scene.triangles.size() == 3);
    CHECK(scene.parts.size() == 2);
    CHECK(scene.parts[0].count == 2);
    CHECK(near(corner(scene, 1, 2), {0, 2, 0}));
    CHECK(scene.triangles[0].normal.x == none);
    CHECK(scene.normals[scene.triangles[2].normal.y] == glm::vec3(0, 1, 0));
}

TEST_CASE("a concave polygon does not cover its notch")
{
    const Scene scene = scene_of("p 5 0 0 0 4 0 0 4 4 0 2 1 0 0 4 0");
    CHECK(scene.triangles.size() == 3);
    double area = 0.0;
    for (PrimitiveId id = 0; id < 3; ++id)
        area += 0.5 * glm::length(glm::cross(corner(scene, id, 1) - corner(scene, id, 0),
                                             corner(scene, id, 2) - corner(scene, id, 0)));
    CHECK(area == doctest::Approx(10.0));
}

TEST_CASE("textured triangles carry their coordinates, and normals where they have some")
{
    const Scene scene = scene_of(
        "tt texture.ppm 0 0 0 .1 .2  1 0 0 .3 -.4  0 1 0 5 6\n"
        "ttp texture.ppm 0 0 0 0 0 3 1 2  1 0 0 0 0 3 3 4  0 1 0 0 0 3 5 6");
    REQUIRE(scene.triangles.size() == 2);
    CHECK(scene.textures == std::vector<std::string>{"texture.ppm"});
    CHECK(uv(scene, 0, 1) == glm::vec2(0.3f, -0.4f));
    CHECK(scene.triangles[0].normal.x == none);
    CHECK(uv(scene, 1, 2) == glm::vec2(5, 6));
    CHECK(scene.normals[scene.triangles[1].normal.x] == glm::vec3(0, 0, 1));
    CHECK(scene.part(1).texture == 0);
}

TEST_CASE("a mesh indexes vertices, normals and texture coordinates independently, in that order")
{
    const Scene scene = scene_of(
        "m vertices 4 0 0 0 1 0 0 0 1 0 9 9 9\n normals 2 0 0 1 0 2 0\n"
        "texturecoords 3 texture.ppm .1 .2 .3 .4 .5 .6\n"
        "triangles 1 2 0 1  1 0 1  2 2 0");
    REQUIRE(scene.triangles.size() == 1);
    CHECK(near(corner(scene, 0, 0), {0, 1, 0}));
    CHECK(near(corner(scene, 0, 1), {0, 0, 0}));
    const TriangleIndices& t = scene.triangles[0];
    CHECK(scene.normals[t.normal.x] == glm::vec3(0, 1, 0));
    CHECK(scene.normals[t.normal.y] == glm::vec3(0, 0, 1));
    CHECK(uv(scene, 0, 0) == glm::vec2(0.5f, 0.6f));
    CHECK(uv(scene, 0, 2) == glm::vec2(0.1f, 0.2f));
    CHECK(scene.groups[0].vertices == 3);  // the fourth is not used and does not widen the bounds
    CHECK(bounds(pose(scene, 0)).hi.z == 0.0);
}

TEST_CASE("a mesh may have texture coordinates without normals, normals alone, or neither")
{
    const std::string vertices = "m vertices 3 0 0 0 1 0 0 0 1 0 ";
    const Scene scene = scene_of(vertices + "texturecoords 1 texture.ppm 1 2 triangles 1 0 1 2 0 0 0 " + vertices +
                                 "normals 1 0 0 1 triangles 1 0 1 2 0 0 0 " + vertices + "triangles 1 0 1 2 " +
                                 vertices + "triangles 0");
    REQUIRE(scene.triangles.size() == 3);
    CHECK(scene.parts.size() == 3);  // a mesh of no triangles is no part
    CHECK(scene.triangles[0].normal.x == none);
    CHECK(uv(scene, 0, 2) == glm::vec2(1, 2));
    CHECK(scene.triangles[1].uv.x == none);
    CHECK(scene.triangles[1].normal.x != none);
    CHECK(scene.triangles[2].normal.x == none);
}

TEST_CASE("static transforms scale, then turn, then move, and nest")
{
    const Scene scene = scene_of("xs 1 1 1 0 0 0 0 100 0 0 { xs 2 3 4  0 0 5 90  10 20 30 { p 3 1 1 1 0 0 0 1 0 0 } }");
    CHECK(near(corner(scene, 0, 0), {100 + 10 - 3, 20 + 2, 30 + 4}));
    CHECK(scene.groups.size() == 1);
    CHECK(scene.nodes.size() == 3);
    CHECK(scene.part(0).node == 2);
    CHECK(scene.nodes[2].parent == 1);
    CHECK_FALSE(scene.nodes[2].dynamic);
}

TEST_CASE("every x is a dynamic node and a group of its own, static nodes fold into it")
{
    const Scene scene =
        scene_of(std::string("x a {") + triangle + "xs 1 1 1 0 0 0 0 5 0 0 {" + triangle + "s 0 0 0 1 x b {" +
                 triangle + "} } } x a {" + triangle + "} x empty { } k a" + still_at(10) + triangle);
    REQUIRE(scene.groups.size() == 4);
    CHECK(scene.groups[0].triangles == 1);
    CHECK(scene.groups[1].triangles == 2);
    CHECK(scene.groups[1].quadrics == 1);
    CHECK(scene.nodes[scene.groups[1].node].name == "a");
    CHECK(scene.nodes[scene.groups[2].node].name == "b");
    CHECK(scene.nodes[scene.groups[2].node].animation == none);
    CHECK(scene.groups[2].node > scene.groups[1].node);
    CHECK(scene.nodes[scene.groups[3].node].animation == scene.nodes[scene.groups[1].node].animation);
    CHECK(near(corner(scene, scene.groups[1].first, 0), {10, 0, 0}));
    CHECK(near(corner(scene, scene.groups[1].first + 1, 0), {15, 0, 0}));
    CHECK(near(corner(scene, scene.groups[2].first, 0), {15, 0, 0}));
    CHECK(near(corner(scene, scene.groups[3].first, 0), {10, 0, 0}));
}

TEST_CASE("primitive ids run group by group, triangles first, and parts cover them in order")
{
    const Scene scene =
        scene_of(std::string("x a { s 0 0 0 1") + triangle + "} s 0 0 0 2 p 4 0 0 0 1 0 0 1 1 0 0 1 0" +
                 " tpa 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 x a { tpa 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 }");
    PrimitiveId next = 0;
    for (const Group& group : scene.groups) {
        CHECK(group.first == next);
        next += group.primitives();
        for (PrimitiveId id = group.first; id < next; ++id)
            CHECK(scene.is_triangle(id) == (id - group.first < group.triangles));
    }
    CHECK(next == scene.primitive_count());
    next = 0;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        CHECK(scene.parts[i].first == next);
        for (std::uint32_t k = 0; k < scene.parts[i].count; ++k) CHECK(scene.part_of_primitive[next + k] == i);
        next += scene.parts[i].count;
        const Group& group = scene.groups[scene.parts[i].group];
        CHECK(scene.parts[i].first >= group.first);
        CHECK(next <= group.first + group.primitives());
    }
    CHECK(next == scene.primitive_count());
    REQUIRE(scene.groups.size() == 4);
    CHECK(scene.groups[1].deforming);
    CHECK(scene.groups[1].node == 0);
    CHECK_FALSE(scene.groups[2].deforming);
    CHECK(scene.groups[3].deforming);
    CHECK(scene.groups[3].first_deforming == 1);
}

TEST_CASE("key frames may stand before or after their transform; of two with one name the last counts")
{
    for (const std::string& text : {"k a" + still_at(3) + "x a {" + triangle + "} k a" + still_at(4),
                                    "k a" + still_at(3) + "k a" + still_at(4) + "x a {" + triangle + "}",
                                    "x a {" + std::string(triangle) + "k a" + still_at(3) + "} k a" + still_at(4)}) {
        const Scene scene = scene_of(text);
        CHECK(scene.animations.size() == 1);
        CHECK(scene.census.count("k") == 2);
        CHECK(near(corner(scene, 0, 0), {4, 0, 0}));
    }
}

TEST_CASE("a transform without key frames is the identity and visible")
{
    const Scene scene = scene_of(std::string("x nobody {") + triangle + "}");
    CHECK(near(corner(scene, 0, 1), {1, 0, 0}));
    CHECK(pose(scene, 7.0).is_visible(scene.groups[1]));
}

TEST_CASE("key frames have tracks in any order, with all their numbers")
{
    const Scene scene = scene_of(
        "k a { visibility 1 2 0 scale 4 0 1 2 3 .1 .2 .3 1 1 1 1 0 0 0 2 1 1 1 0 0 0 3 1 1 1 0 0 0\n"
        "rot 4 0 1 2 3 90 .1 .2 .3 1 1 0 0 0 0 0 0 2 1 0 0 0 0 0 0 3 1 0 0 0 0 0 0 }");
    REQUIRE(scene.animations.size() == 1);
    const Animation& a = scene.animations[0];
    CHECK(a.translation.empty());
    CHECK(a.scale.keys().size() == 4);
    const Key& key = a.rotation.keys()[0];
    CHECK(key.value == glm::dvec3(1, 2, 3));
    CHECK(key.angle == 90.0);
    CHECK(key.tension == 0.1);
    CHECK(key.continuity == 0.2);
    CHECK(key.bias == 0.3);
    REQUIRE(a.visibility.size() == 1);
    CHECK(a.visibility[0].time == 2.0);
    CHECK_FALSE(a.visibility[0].visible);
}

TEST_CASE("deforming triangles inside static transforms are carried to their owner's system, normals not normalised")
{
    const Scene scene = scene_of("xs 2 1 1 0 0 0 0 10 0 0 { tpa 1 0  1 0 0 4 0 0  2 0 0 0 4 0  1 1 0 0 0 0 }");
    REQUIRE(scene.deforming_keys.size() == 1);
    const DeformingKey& key = scene.deforming_keys[0];
    CHECK(key.position[0] == glm::dvec3(12, 0, 0));
    REQUIRE(scene.deforming_normals.size() == 1);
    const auto& normals = scene.deforming_normals[0].corner;
    CHECK(normals[1].y / normals[0].x == 2.0f);  // the inverse transpose halves x
    CHECK(scene.positions[scene.groups[1].first_vertex] == glm::dvec3(12, 0, 0));
}

TEST_CASE("comments reach to the end of the line wherever they stand")
{
    const Scene scene = scene_of("# a\n% b\nl 1# 9 9\n2 % caf\xe9 { }\n3\nxs 1 1 1 0 0 0 0 0 0 0{# }\n}b 1 1 1#");
    CHECK(scene.lights[0].position == glm::dvec3(1, 2, 3));
    CHECK(scene.background == glm::vec3(1.0f));
}

TEST_CASE("CR LF, form feeds, tabs, and a missing last newline separate as spaces do")
{
    const Scene scene = scene_of("# dos\r\nl\t1\r\n2\f3\r\na 0 1\r\n\r\n20\fb 1 .5 0");
    CHECK(scene.lights[0].position == glm::dvec3(1, 2, 3));
    CHECK(scene.lights[0].colour == glm::vec3(1.0f));
    CHECK(scene.frames == 20);
    CHECK(scene.background.y == 0.5f);
}

TEST_CASE("braces are tokens without spaces around them, and line ends mean nothing")
{
    const Scene scene = scene_of(std::string("x a{xs 1 1 1\n0 0 0 0\n5 0 0{") + triangle +
                                 "}}k a{transl 4 0 1 0 0 0 0 0" + " 1 1 0 0 0 0 0 2 1 0 0 0 0 0 3 1 0 0 0 0 0}");
    CHECK(near(corner(scene, 0, 0), {6, 0, 0}));
}

TEST_CASE("numbers are read in all forms that C writes")
{
    const Scene scene = scene_of("l 12 -0.5 -.5 3. 1.9E-6 -2.1e-07 l +1 1e3 007");
    CHECK(scene.lights[0].position == glm::dvec3(12, -0.5, -0.5));
    CHECK(scene.lights[0].colour == glm::vec3(3.0f, 1.9e-6f, -2.1e-7f));
    CHECK(scene.lights[1].position == glm::dvec3(1, 1000, 7));
}

TEST_CASE("a number may follow a statement's letters at once")
{
    const Scene scene = scene_of("l1 2 3 b.5 .5 1");
    CHECK(scene.lights[0].position == glm::dvec3(1, 2, 3));
    CHECK(scene.background.x == 0.5f);
}

TEST_CASE("includes are read where they stand, relative to the main file's folder, each file once")
{
    const TempFolder folder;
    folder.write("main/sub/outer.aff", "i 0 sub/inner.aff i 0 sub/inner.aff");
    folder.write("main/sub/inner.aff", triangle);
    const auto main = folder.write("main/main.aff", "xs 1 1 1 0 0 0 0 5 0 0 { i 0 sub/outer.aff } i 0 ./sub/inner.aff");
    const Scene scene = read_aff(main);
    CHECK(scene.triangles.size() == 3);
    CHECK(near(corner(scene, 1, 0), {5, 0, 0}));
    CHECK(near(corner(scene, 2, 0), {0, 0, 0}));
    CHECK(scene.census.count("i") == 4);
    CHECK(scene.census.files == 3);
    CHECK(scene.census.bytes ==
          std::filesystem::file_size(main) + 35 + std::filesystem::file_size(folder.path() / "main/sub/inner.aff"));
    CHECK(scene.folder == (folder.path() / "main").string());
}

TEST_CASE("an include is skipped when its level is above the detail level, and that is counted")
{
    const TempFolder folder;
    folder.write("t.aff", triangle);
    const Scene scene =
        read_aff(folder.write("main.aff", "i 1 absent.aff d 2 i 2 t.aff i 3 t.aff d 0 i 1 t.aff i -1 t.aff"));
    CHECK(scene.triangles.size() == 2);
    CHECK(scene.census.count("i") == 2);
    CHECK(scene.census.count("i (too detailed, skipped)") == 3);
    CHECK(scene.census.count("d") == 2);
}

TEST_CASE("files outside the main file's folder are read only when that is allowed")
{
    const TempFolder folder;
    folder.write("t.aff", triangle);
    const auto main = folder.write("scene/main.aff", "i 0 ../t.aff");
    CHECK_THROWS_AS(read_aff(main), SceneError);
    ReadLimits limits;
    limits.allow_outside = true;
    CHECK(read_aff(main, limits).triangles.size() == 1);
}

TEST_CASE("a link that leads outside counts as outside")
{
    const TempFolder folder;
    folder.write("secret.aff", triangle);
    const auto main = folder.write("scene/main.aff", "i 0 link.aff");
    std::filesystem::create_symlink("../secret.aff", folder.path() / "scene/link.aff");
    CHECK_THROWS_AS(read_aff(main), SceneError);
}

TEST_CASE("a name in the current folder is read without a path")
{
    const TempFolder folder;
    folder.write("main.aff", "i 0 t.aff");
    folder.write("t.aff", triangle);
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const Scene scene = read_aff("main.aff");
    std::filesystem::current_path(before);
    CHECK(scene.triangles.size() == 1);
    CHECK(scene.folder == ".");
}

TEST_CASE("a mirrored transform keeps normals on the side they point to")
{
    const Scene scene = scene_of("xs -1 1 1 0 0 0 0 0 0 0 { pp 3 0 0 0 1 0 0  0 1 0 1 0 0  0 0 1 1 0 0 }");
    CHECK(near(shading_normal(pose(scene, 0), 0, 0.3, 0.3, {0, 0, 1}), {-1, 0, 0}));
}

TEST_CASE("transforms nested a thousand deep are read")
{
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "xs 1 1 1 0 0 0 0 1 0 0 {";
    text += triangle + std::string(1000, '}');
    CHECK(near(corner(scene_of(text), 0, 0), {1000, 0, 0}));
}

}  // namespace firstray
