#include "bench/firstray/structure_table.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace firstray::command {
namespace {

using Kind = StructureBox::Kind;

StructureBox box(Kind kind, int level, std::string name = {}, const glm::ivec3& dims = glm::ivec3(0))
{
    return {.kind = kind, .name = std::move(name), .level = level, .dims = dims, .primitives = 5};
}

/// A supergrid of two boxes, the first with grids in its voxels, and scenery.
std::vector<StructureBox> hierarchy()
{
    return {box(Kind::supergrid, 0, "all", {3, 1, 2}),
            box(Kind::subgrid, 1, "", {2, 2, 2}),
            box(Kind::box, 1, "robot", {4, 4, 4}),
            box(Kind::subgrid, 2, "", {2, 2, 2}),
            box(Kind::subgrid, 3, "", {2, 2, 2}),
            box(Kind::subgrid, 2, "", {2, 2, 2}),
            box(Kind::box, 2, "arm"),
            box(Kind::grid, 0, "scenery", {1, 1, 1}),
            box(Kind::subgrid, 1, "", {2, 2, 2})};
}

TEST_CASE("subgrids are counted where they are, the other boxes are told one by one")
{
    const Json told = describe_structure(hierarchy(), glm::dvec3(0.0));
    REQUIRE(told.size() == 4);
    const std::pair<const char*, Json> expected[] = {{"all", {{"count", 1}, {"deepest_level", 1}}},
                                                     {"robot", {{"count", 3}, {"deepest_level", 3}}},
                                                     {"arm", {{"count", 0}, {"deepest_level", nullptr}}},
                                                     {"scenery", {{"count", 1}, {"deepest_level", 1}}}};
    std::size_t i = 0;
    for (const auto& [name, subgrids] : expected) {
        const auto name_now = name;  // clang 14 captures no structured bindings
        CAPTURE(name_now);
        CHECK(told[i]["name"] == name);
        CHECK(told[i++]["subgrids"] == subgrids);
    }
    CHECK(told[0]["kind"] == "supergrid");
    CHECK(told[0]["resolution"] == Json{3, 1, 2});
    CHECK(told[2]["resolution"].is_null());
    CHECK(told[2]["level"] == 2);
}

TEST_CASE("places are told in world coordinates")
{
    StructureBox turned = box(Kind::box, 0, "turned");
    turned.root_from_box = {glm::dmat3(glm::dvec3(0, 2, 0), glm::dvec3(-3, 0, 0), glm::dvec3(0, 0, 4)), {1, 1, 1}};
    const Json told = describe_structure(std::vector{turned}, {100, 0, 0});
    CHECK(told[0]["size"] == Json{2.0, 3.0, 4.0});
    CHECK(told[0]["corner"] == Json{101.0, 1.0, 1.0});
    CHECK(told[0]["edges"][1] == Json{-3.0, 0.0, 0.0});
}

TEST_CASE("the table has a line per box under a heading, names indented by level, columns aligned")
{
    const std::string table = structure_table(describe_structure(hierarchy(), glm::dvec3(0.0)));
    CAPTURE(table);
    CHECK(std::count(table.begin(), table.end(), '\n') == 5);
    CHECK(table.starts_with("name "));
    CHECK(table.find("\n  robot ") != std::string::npos);
    CHECK(table.find("\n    arm ") != std::string::npos);
    CHECK(table.find("3x1x2") != std::string::npos);
    CHECK(table.find(" list ") != std::string::npos);
    CHECK(table.find("3, down to level 3\n") != std::string::npos);
    const std::size_t kinds = table.find("kind");
    std::size_t line = 0;
    for (const char* kind : {"kind", "supergrid", "box", "box", "grid"}) {
        CHECK(table.compare(line + kinds, std::string(kind).size(), kind) == 0);
        line = table.find('\n', line) + 1;
    }
}

}  // namespace
}  // namespace firstray::command
