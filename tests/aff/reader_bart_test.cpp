#include <doctest/doctest.h>

#include <set>

#include "engine/aff/reader.h"
#include "tests/support/bart.h"

namespace firstray {
namespace {

std::size_t count_triangles(const Scene& scene, bool (*holds)(const Scene&, PrimitiveId))
{
    std::size_t count = 0;
    for (PrimitiveId id = 0; id < scene.primitive_count(); ++id)
        if (scene.is_triangle(id) && holds(scene, id)) ++count;
    return count;
}

bool moves(const Scene& scene, PrimitiveId id)
{
    return scene.group(id).node != 0 || scene.group(id).deforming;
}

bool is_textured(const Scene& scene, PrimitiveId id)
{
    return scene.part(id).texture != none;
}

bool is_specular(const Scene& scene, PrimitiveId id)
{
    return scene.material(id).specular != glm::vec3(0.0f);
}

bool transmits(const Scene& scene, PrimitiveId id)
{
    return scene.material(id).transmits();
}

struct Tracks {
    std::size_t rotation = 0, translation = 0, scale = 0, visibility = 0, keys = 0;
};

Tracks count_tracks(const Scene& scene)
{
    Tracks tracks;
    for (const Animation& a : scene.animations) {
        tracks.rotation += !a.rotation.empty();
        tracks.translation += !a.translation.empty();
        tracks.scale += !a.scale.empty();
        tracks.visibility += !a.visibility.empty();
        tracks.keys += a.rotation.keys().size() + a.translation.keys().size() + a.scale.keys().size();
    }
    return tracks;
}

void check_statements(const Scene& scene, const std::vector<std::pair<std::string, std::uint64_t>>& expected)
{
    CHECK(scene.census.statements.size() == expected.size());
    for (const auto& row : expected) {
        CAPTURE(row.first);
        CHECK(scene.census.count(row.first) == row.second);
    }
}

/// Largest number of transforms around anything, of all kinds or of dynamic ones.
int deepest(const Scene& scene, bool only_dynamic)
{
    std::vector<int> depth(scene.nodes.size(), 0);
    int largest = 0;
    for (std::size_t i = 1; i < scene.nodes.size(); ++i) {
        depth[i] = depth[scene.nodes[i].parent] + (scene.nodes[i].dynamic || !only_dynamic);
        largest = std::max(largest, depth[i]);
    }
    return largest;
}

}  // namespace

TEST_CASE("the census of Robots comes out")
{
    const auto file = test::bart_file("robots/Robot.aff");
    if (!file) return;
    const Scene scene = read_aff(*file);
    check_statements(scene, {{"v", 1},
                             {"am", 1},
                             {"a", 1},
                             {"l", 1},
                             {"i", 835},
                             {"fm", 1849},
                             {"m", 1849},
                             {"xs", 521},
                             {"x", 190},
                             {"k", 187}});
    CHECK(scene.name == "Robot");
    CHECK(scene.census.files == 51);
    CHECK(scene.census.bytes == 2'419'666);
    CHECK(scene.triangles.size() == 71'708);
    CHECK(scene.primitive_count() == 71'708);
    CHECK(scene.positions.size() == 134'127);
    CHECK(scene.parts.size() == 1'849);
    CHECK(count_triangles(scene, moves) == 62'490);
    CHECK(count_triangles(scene, is_textured) == 65'786);
    CHECK(count_triangles(scene, is_specular) == 71'612);
    CHECK(count_triangles(scene, transmits) == 1'516);
    CHECK(scene.materials.size() == 62);
    CHECK(scene.textures.size() == 44);
    CHECK(scene.groups.size() == 161);
    CHECK(scene.groups[0].triangles == 9'218);
    CHECK(deepest(scene, false) == 15);
    CHECK(deepest(scene, true) == 8);
    const Tracks tracks = count_tracks(scene);
    CHECK(tracks.rotation == 167);
    CHECK(tracks.translation == 22);
    CHECK(tracks.scale == 0);
    CHECK(tracks.keys == 14'017);
    CHECK(scene.frames == 800);
    CHECK(scene.end == 50.0);
    CHECK(scene.lights.size() == 1);
    CHECK(scene.lights[0].colour == glm::vec3(1.0f));
    CHECK(scene.ambient == glm::vec3(1.0f));
    CHECK(scene.background == glm::vec3(0.0f));
    CHECK(scene.view.width == 800);
    CHECK(scene.view.height == 600);
    CHECK(scene.view.angle == doctest::Approx(36.87).epsilon(1e-4));
    CHECK(scene.view.hither == 1.0);
}

TEST_CASE("every robot has sixteen groups of the published sizes, and five transforms have no key frames")
{
    const auto file = test::bart_file("robots/Robot.aff");
    if (!file) return;
    const Scene scene = read_aff(*file);
    std::multiset<std::uint32_t> sizes;
    for (const Group& group : scene.groups)
        if (group.node != 0) sizes.insert(group.triangles);
    for (const std::uint32_t size : {2278u, 414u, 128u, 264u, 250u, 218u, 1637u, 724u}) {
        CAPTURE(size);
        CHECK(sizes.count(size) == 10);
    }
    for (const std::uint32_t size : {48u, 64u, 28u, 36u}) {
        CAPTURE(size);
        CHECK(sizes.count(size) >= 10);
    }
    std::set<std::string> still;
    for (const Node& node : scene.nodes)
        if (node.dynamic && node.animation == none) still.insert(node.name);
    CHECK(still == std::set<std::string>{"grip_lift1", "grip_rot1", "gun_lift2", "gun_rot2", "head_rot2"});
}

TEST_CASE("the census of Kitchen comes out")
{
    const auto file = test::bart_file("kitchen/kitchen.aff");
    if (!file) return;
    const Scene scene = read_aff(*file);
    check_statements(scene, {{"v", 1},
                             {"b", 1},
                             {"am", 1},
                             {"a", 1},
                             {"l", 6},
                             {"i", 186},
                             {"fm", 233},
                             {"m", 393},
                             {"xs", 416},
                             {"x", 7},
                             {"k", 8}});
    CHECK(scene.census.files == 51);
    CHECK(scene.census.bytes == 2'510'765);
    CHECK(scene.triangles.size() == 110'561);
    CHECK(scene.positions.size() == 63'706);
    CHECK(scene.groups.size() == 6);
    CHECK(scene.groups[0].triangles == 103'343);
    CHECK(count_triangles(scene, moves) == 7'218);
    CHECK(count_triangles(scene, is_textured) == 5'328);
    CHECK(count_triangles(scene, is_specular) == 99'357);
    CHECK(count_triangles(scene, transmits) == 19'128);
    CHECK(scene.textures.size() == 8);
    CHECK(scene.materials.size() == 25);  // a 26th is set but nothing is made of it
    CHECK(scene.animations.size() == 6);
    CHECK(count_tracks(scene).keys == 528);
    CHECK(count_tracks(scene).rotation == 6);
    CHECK(deepest(scene, false) == 6);
    CHECK(deepest(scene, true) == 3);
    CHECK(scene.lights.size() == 6);
    CHECK(scene.background == glm::vec3(0.5f, 0.5f, 1.0f));
    CHECK(scene.ambient == glm::vec3(2.5f));
    CHECK(scene.frames == 800);
    CHECK(scene.end == 20.0);
    CHECK(scene.view.angle == 40.0);
    CHECK(scene.view.hither == 0.01);
}

TEST_CASE("the census of Museum comes out at its three sizes")
{
    struct Row {
        const char* file;
        std::uint64_t deforming, specular;
        std::size_t triangles;
    };
    for (const Row& row : {Row{"museum/museum3.aff", 64, 10'242, 10'348},
                           {"museum/museum4.aff", 256, 10'434, 10'540},
                           {"museum/museum5.aff", 1024, 11'202, 11'308}}) {
        const auto file = test::bart_file(row.file);
        if (!file) return;
        CAPTURE(row.file);
        const Scene scene = read_aff(*file);
        check_statements(scene, {{"v", 1},
                                 {"b", 1},
                                 {"a", 1},
                                 {"l", 2},
                                 {"i", 6},
                                 {"fm", 58},
                                 {"m", 1},
                                 {"p", 133},
                                 {"tt", 10},
                                 {"c", 8},
                                 {"tpa", row.deforming},
                                 {"k", 1}});
        CHECK(scene.census.files == 7);
        CHECK(scene.triangles.size() == row.triangles);
        CHECK(scene.quadrics.size() == 8);
        CHECK(scene.deforming.size() == row.deforming);
        CHECK(scene.deforming_keys.size() == 5 * row.deforming);
        REQUIRE(scene.groups.size() == 2);
        CHECK(scene.groups[0].triangles == 10'284);
        CHECK(scene.groups[1].deforming);
        CHECK(count_triangles(scene, moves) == row.deforming);
        CHECK(count_triangles(scene, is_textured) == 10);
        CHECK(count_triangles(scene, is_specular) == row.specular);
        CHECK(count_triangles(scene, transmits) == 0);
        CHECK(scene.materials.size() == 11);
        CHECK(scene.textures.size() == 5);
        CHECK(scene.start == -1.0);
        CHECK(scene.end == 5.0);
        CHECK(scene.frames == 300);
        CHECK(scene.ambient == glm::vec3(1.0f));
    }
}

}  // namespace firstray
