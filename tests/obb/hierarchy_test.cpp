#include "obb/hierarchy.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/moving_scenes.h"
#include "tests/support/scene_files.h"

namespace firstray::obb {
namespace {

using test::moving_scene;
using test::scene_of;

const std::string triangle = " p 3 0 0 0 1 0 0 0 1 0 ", shift = " xs 1 1 1 0 0 1 0 3 0 0 ";

/// Names of boxes, with how many primitives each holds.
std::vector<std::pair<std::string, std::uint32_t>> boxes_of(const Hierarchy& hierarchy)
{
    std::vector<std::pair<std::string, std::uint32_t>> boxes;
    for (const BoxPlan& plan : hierarchy.boxes) {
        boxes.emplace_back(plan.name, 0);
        for (const PrimitiveRange& range : plan.primitives) boxes.back().second += range.count;
    }
    return boxes;
}

using Boxes = std::vector<std::pair<std::string, std::uint32_t>>;

TEST_CASE("static transforms fold into the dynamic one above them, or get boxes of their own")
{
    // static 1 in a in static 3 in b in static 5; the scenery has a static transform too
    const Scene scene = scene_of(shift + "{" + triangle + " x a {" + triangle + shift + "{" + triangle + triangle +
                                 " x b {" + shift + "{" + triangle + "} s 0 0 0 1 } } } }");
    const Hierarchy dynamic = plan_hierarchy(scene, Groups::dynamic);
    CHECK(boxes_of(dynamic) == Boxes{{"a", 3}, {"b", 2}});
    const Hierarchy all = plan_hierarchy(scene, Groups::all);
    CHECK(boxes_of(all) == Boxes{{"a", 1}, {"a/static 3", 2}, {"b", 1}, {"b/static 5", 1}});
    for (const Hierarchy& hierarchy : {dynamic, all}) {
        REQUIRE(hierarchy.clusters.size() == 1);
        CHECK(hierarchy.clusters[0].name == "a");
        CHECK(hierarchy.clusters[0].node == 2);
        CHECK(hierarchy.clusters[0].first_box == 0);
        CHECK(hierarchy.clusters[0].boxes == hierarchy.boxes.size());
    }
}

TEST_CASE("each topmost dynamic transform makes one cluster, whether it has primitives of its own or not")
{
    const Scene scene = scene_of("x a { x b {" + triangle + "} x c {" + triangle + " x d {" + triangle + "} } }" +
                                 shift + "{ x e {" + triangle + "} x f { } }" + triangle);
    const Hierarchy hierarchy = plan_hierarchy(scene, Groups::dynamic);
    CHECK(boxes_of(hierarchy) == Boxes{{"b", 1}, {"c", 1}, {"d", 1}, {"e", 1}});
    REQUIRE(hierarchy.clusters.size() == 2);
    CHECK(hierarchy.clusters[0].name == "a");
    CHECK(hierarchy.clusters[0].boxes == 3);
    CHECK(hierarchy.clusters[1].name == "e");
    CHECK(hierarchy.clusters[1].first_box == 3);
    CHECK(hierarchy.clusters[1].boxes == 1);
}

TEST_CASE("what deforms stands in a box of its own, under no transform in a cluster of its own")
{
    const std::string deforming =
        " tpa 2 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1  1 0 0 9 0 0 1 1 0 9 0 0 1 0 1 9 0 0 1 ";
    const Scene scene =
        scene_of(deforming + triangle + "x a {" + triangle + deforming + deforming + shift + "{" + deforming + "} }");
    for (const Groups groups : {Groups::dynamic, Groups::all}) {
        const Hierarchy hierarchy = plan_hierarchy(scene, groups);
        CHECK(boxes_of(hierarchy) == Boxes{{"deforming", 1}, {"a", 1}, {"a (deforming)", 3}});
        REQUIRE(hierarchy.clusters.size() == 2);
        CHECK(hierarchy.clusters[0].name == "deforming");
        CHECK(hierarchy.clusters[0].node == 0);
        CHECK(hierarchy.clusters[1].name == "a");
        CHECK(hierarchy.clusters[1].boxes == 2);
    }
}

TEST_CASE("a scene where nothing moves has no boxes")
{
    const Hierarchy hierarchy = plan_hierarchy(scene_of(triangle + shift + "{" + triangle + "}"), Groups::all);
    CHECK(hierarchy.boxes.empty());
    CHECK(hierarchy.clusters.empty());
    CHECK(plan_hierarchy(scene_of(""), Groups::all).boxes.empty());
}

TEST_CASE("every primitive but the scenery's stands in exactly one box, and every box in one cluster")
{
    std::size_t primitives = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        const Scene scene = moving_scene(seed);
        for (const Groups groups : {Groups::dynamic, Groups::all}) {
            const Hierarchy hierarchy = plan_hierarchy(scene, groups);
            std::vector<int> boxes_with(scene.primitive_count(), 0);
            for (const BoxPlan& plan : hierarchy.boxes) {
                CHECK(!plan.primitives.empty());
                PrimitiveId last_end = 0;
                for (const PrimitiveRange& range : plan.primitives) {
                    CHECK(range.first >= last_end);
                    last_end = range.first + range.count;
                    for (PrimitiveId id = range.first; id < last_end; ++id) {
                        ++boxes_with[id];
                        CHECK(scene.part(id).group == plan.group);
                    }
                }
            }
            for (PrimitiveId id = 0; id < scene.primitive_count(); ++id)
                CHECK(boxes_with[id] == (scene.part(id).group == 0 ? 0 : 1));
            std::uint32_t next = 0;
            for (const Cluster& cluster : hierarchy.clusters) {
                CHECK(cluster.first_box == next);
                next += cluster.boxes;
            }
            CHECK(next == hierarchy.boxes.size());
            primitives += scene.primitive_count();
        }
    }
    CHECK(primitives > 10000);
}

}  // namespace
}  // namespace firstray::obb
