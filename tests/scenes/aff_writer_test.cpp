#include "scenes/generator/aff_writer.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <locale>

#include "engine/aff/reader.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::scenes;
using test::Random;
using test::TempFolder;

namespace {

/// As in many countries: 1.234,5.
struct CommaPoint : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

struct OtherLocale {
    OtherLocale() : old(std::locale::global(std::locale(std::locale::classic(), new CommaPoint))) {}
    ~OtherLocale() { std::locale::global(old); }
    std::locale old;
};

float random_float(Random& random)
{
    for (;;) {
        const float value = std::bit_cast<float>(random.below(0xffffffffu));
        if (std::isfinite(value) && std::abs(value) < 1e30f) return value;
    }
}

}  // namespace

TEST_CASE("the writer's numbers read back as the same floats, whatever the locale")
{
    const OtherLocale comma;
    Random random(1);
    const TempFolder folder;
    Mesh mesh;
    for (int i = 0; i < 3000; ++i) {
        const float x = random_float(random), y = random_float(random), z = random_float(random);
        mesh.positions.emplace_back(x, y, z);
    }
    for (const float x : {1234567.0f, 0.1f, 1e-38f}) mesh.positions.emplace_back(x, -0.0, 1.0f / 3.0f);
    for (std::uint32_t i = 0; i + 2 < mesh.positions.size(); i += 3)
        mesh.triangles.push_back({{i, i + 1, i + 2}, {}, {}});
    AffWriter out(folder.path() / "main.aff");
    out.mesh(mesh);
    out.finish();
    const Scene scene = read_aff(folder.path() / "main.aff");
    REQUIRE(scene.positions.size() == mesh.positions.size());
    int different = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        different += glm::vec3(scene.positions[i]) != glm::vec3(mesh.positions[i]);
    CHECK(different == 0);
    CHECK(out.triangles() == mesh.triangles.size());
}

TEST_CASE("every statement of the writer reads back as what it says")
{
    const TempFolder folder;
    folder.write("t.ppm", "P6 1 1 255\nabc");
    folder.write("part.aff", "s 0 0 0 1\n");
    AffWriter out(folder.path() / "main.aff");
    out.comment("all of it");
    out.view({.from = {1, 2, 3}, .at = {4, 5, 6}, .angle = 40, .hither = 0.5, .width = 30, .height = 20});
    out.frames(1.0, 3.0, 5);
    out.background({0.1f, 0.2f, 0.3f});
    out.ambient({0.4f, 0.5f, 0.6f});
    out.light({7, 8, 9}, {1.0f, 0.5f, 0.25f});
    out.light({1, 1, 1}, {0.5f, 0.5f, 0.5f}, "lamp");
    Animation lamp;
    lamp.name = "lamp";
    lamp.visibility = {{2.0, false}};
    lamp.translation =
        VectorTrack({{.time = 0, .value = {1, 0, 0}}, {.time = 1}, {.time = 2}, {.time = 3, .tension = 0.5}});
    lamp.rotation = RotationTrack({{.time = 0, .value = {0, 1, 0}, .angle = 10},
                                   {.time = 1, .value = {0, 1, 0}, .angle = 20},
                                   {.time = 2, .value = {0, 1, 0}, .angle = 30},
                                   {.time = 3, .value = {0, 1, 0}, .angle = 40}});
    lamp.scale = VectorTrack({{.value = {1, 2, 3}},
                              {.time = 1, .value = {1, 2, 3}},
                              {.time = 2, .value = {1, 2, 3}},
                              {.time = 3, .value = {1, 2, 3}}});
    out.keys(lamp);
    const Material material{.ambient = {0.1f, 0.1f, 0.1f},
                            .diffuse = {0.2f, 0.3f, 0.4f},
                            .specular = {0.5f, 0.6f, 0.7f},
                            .shine = 9,
                            .transmittance = 0.25f,
                            .ior = 1.5f};
    out.material(material);
    out.open({.scale = {2, 2, 2}, .axis = {0, 0, 1}, .degrees = 90, .offset = {1, 0, 0}});
    out.open("lamp");
    Mesh mesh;
    add_quad(mesh, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2});
    out.mesh(mesh, "t.ppm");
    out.close();
    out.close();
    out.sphere({1, 2, 3}, 0.5);
    out.cone({0, 0, 0}, 1.0, {0, 2, 0}, 0.5);
    const DeformingKey key{};
    const DeformingNormals normals{};
    out.deforming_triangle(std::span(&key, 1), std::span(&normals, 1));
    out.include("part.aff", 0);
    out.finish();

    const Scene scene = read_aff(folder.path() / "main.aff");
    CHECK(scene.view.angle == 40);
    CHECK(scene.view.at == glm::dvec3(4, 5, 6));
    CHECK(scene.time_of(4) == 3.0);
    CHECK(scene.background == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(scene.ambient == glm::vec3(0.4f, 0.5f, 0.6f));
    REQUIRE(scene.lights.size() == 2);
    CHECK(scene.lights[0].colour == glm::vec3(1.0f, 0.5f, 0.25f));
    CHECK(scene.lights[1].animation != none);
    REQUIRE(scene.animations.size() == 1);
    CHECK(scene.animations[0].at(1.0).linear == lamp.at(1.0).linear);
    CHECK(scene.animations[0].translation.keys()[3].tension == 0.5);
    CHECK(!scene.animations[0].visible_at(2.5));
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0] == material);
    CHECK(scene.textures == std::vector<std::string>{"t.ppm"});
    CHECK(scene.quadrics.size() == 3);
    CHECK(scene.deforming.size() == 1);
    CHECK(out.triangles() == 3);
}

TEST_CASE("a material is written once as long as it stays, and again after it was forgotten")
{
    const TempFolder folder;
    AffWriter out(folder.path() / "main.aff");
    for (int i = 0; i < 3; ++i) out.material({.shine = 5}), out.sphere({0, 0, 0}, 1);
    out.forget_material();
    out.material({.shine = 5});
    out.material({.shine = 6});
    out.finish();
    CHECK(read_aff(folder.path() / "main.aff").census.count("fm") == 3);
}

TEST_CASE("a file of the writer appears when it is finished, not before, and not at all where it is given up")
{
    const TempFolder folder;
    {
        AffWriter given_up(folder.path() / "a.aff");
        given_up.sphere({0, 0, 0}, 1);
    }
    AffWriter out(folder.path() / "b.aff");
    out.sphere({0, 0, 0}, 1);
    CHECK(!std::filesystem::exists(folder.path() / "b.aff"));
    out.finish();
    CHECK(std::filesystem::exists(folder.path() / "b.aff"));
    CHECK(!std::filesystem::exists(folder.path() / "a.aff"));
    CHECK(out.bytes() == std::filesystem::file_size(folder.path() / "b.aff"));
}
