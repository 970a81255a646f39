#include <doctest/doctest.h>

#include <algorithm>

#include "bench/firstray/command.h"
#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

namespace firstray::command {
namespace {

using test::call;
using test::moving_square;
using test::Outcome;
using test::read_json;

/// A still triangle, a cart with two wheels below one transform, a ball below another.
constexpr std::string_view cart = R"(
v from 0 0 10 at 0 0 0 up 0 1 0 angle 60 hither 0.1 resolution 16 12
l 0 10 10
a 0 1 2
p 3  -5 -5 -1  5 -5 -1  0 5 -1
x cart {
p 4  -0.5 -0.5 0  0.5 -0.5 0  0.5 0.5 0  -0.5 0.5 0
x left_wheel { c -0.5 -0.5 0 0.2  -0.5 -0.5 0.1 0.2 }
x right_wheel { c 0.5 -0.5 0 0.2  0.5 -0.5 0.1 0.2 }
}
x ball { xs 1 1 1 0 0 1 0 0 2 0 { s 0 0 0 0.3 } }
)";

TEST_CASE("all choices for obb are taken, give the same picture, and stand in the statistics")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto stats = folder.path() / "stats.json";
    const auto render = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            "render",  scene,          "--frames", "0-4",
            "--stats", stats.string(), "--output", (folder.path() / "a.#.png").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = call(arguments);
        CAPTURE(outcome.err);
        REQUIRE(outcome.code == 0);
        return read_json(stats);
    };
    const auto expected = render({"--strategy", "grid"});
    CHECK(expected["settings"]["own"] == nlohmann::json::object());
    CHECK(render({"--strategy", "obb"})["settings"]["own"] ==
          nlohmann::json{{"obb-groups", "dynamic"}, {"obb-top", "grid"}, {"obb-hits", "root"}, {"obb-inside", "auto"}});
    for (const std::string groups : {"dynamic", "all"})
        for (const std::string top : {"grid", "list"})
            for (const std::string inside : {"auto", "grid", "list"}) {
                CAPTURE(groups);
                CAPTURE(top);
                CAPTURE(inside);
                const auto found =
                    render({"--strategy", "obb", "--obb-groups", groups, "--obb-top", top, "--obb-inside", inside});
                CHECK(found["settings"]["own"] ==
                      nlohmann::json{
                          {"obb-groups", groups}, {"obb-top", top}, {"obb-hits", "root"}, {"obb-inside", inside}});
                for (std::size_t i = 0; i < 5; ++i)
                    CHECK(found["frames"][i]["image_hash"] == expected["frames"][i]["image_hash"]);
            }
    CHECK(render({"--strategy", "obb", "--obb-hits", "local"})["settings"]["own"]["obb-hits"] == "local");
}

TEST_CASE("info lists the scenery, supergrids and boxes of obb by the names of their transforms")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("cart.aff", cart).string();
    const auto rows = [&](const std::string& groups) {
        const Outcome outcome =
            call({"info", scene, "--json", "--structure", "--strategy", "obb", "--obb-groups", groups});
        REQUIRE(outcome.code == 0);
        const auto info = nlohmann::json::parse(outcome.out);
        std::vector<std::string> lines;
        for (const auto& box : info["structure"])
            lines.push_back(box["kind"].get<std::string>() + ' ' + box["level"].dump() + ' ' +
                            box["name"].get<std::string>() + ' ' + box["primitives"].dump());
        return lines;
    };
    CHECK(rows("dynamic") == std::vector<std::string>{"grid 0 scenery 1", "supergrid 0 cart 4", "box 1 cart 2",
                                                      "box 1 left_wheel 1", "box 1 right_wheel 1", "box 0 ball 1"});
    CHECK(rows("all").back().starts_with("box 0 ball/static "));
    const std::string table = call({"info", scene, "--structure", "--strategy", "obb"}).out;
    CHECK(table.find("structure    strategy obb, frame 0\n") != std::string::npos);
    CHECK(table.find("\n  left_wheel ") != std::string::npos);
}

}  // namespace
}  // namespace firstray::command
