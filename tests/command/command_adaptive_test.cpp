#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lazy/rule.h"
#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

namespace firstray::command {
namespace {

using test::call;
using test::moving_square;
using test::Outcome;
using test::read_json;

TEST_CASE("info tells what adaptive counts with, of no scene or beside one, and takes costs of yours")
{
    const Outcome table = call({"info", "--costs"});
    CHECK(table.code == 0);
    for (const lazy::CostName& name : lazy::cost_names())
        CHECK(table.out.find(" " + std::string(name.name) + " ") != std::string::npos);

    const Outcome told = call({"info", "--json", "--costs=test=7,making=1234.5"});
    REQUIRE(told.code == 0);
    const auto costs = nlohmann::json::parse(told.out)["costs"];
    CHECK(costs.size() == lazy::cost_names().size());
    CHECK(costs["test"] == 7.0);
    CHECK(costs["making"] == 1234.5);
    CHECK(costs["pack"].get<double>() > 0.0);

    const Outcome wrong = call({"info", "--costs=tests=7"});
    CHECK(wrong.code == 2);
    CHECK(wrong.err.find("expected NAME=NS") != std::string::npos);
    CHECK(call({"info"}).code == 2);
}

TEST_CASE("adaptive renders grid's pictures however it chooses, and tells what it chose")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto render = [&](std::vector<std::string> options) {
        const std::string stats = (folder.path() / "stats.json").string();
        std::vector<std::string> line = {"render",  scene, "--frames", "0-4",
                                         "--stats", stats, "--output", (folder.path() / "x.####.png").string()};
        line.insert(line.end(), options.begin(), options.end());
        REQUIRE(call(line).code == 0);
        return read_json(stats);
    };
    const auto expected = render({"--strategy", "grid"});
    CHECK(!expected["frames"][0].contains("adaptive"));
    for (const char* choice : {"learned", "evidence", "always-grid", "always-list", "threshold=1"})
        for (const char* threads : {"1", "2"}) {
            CAPTURE(choice);
            const auto found = render({"--strategy", "adaptive", "--list-or-grid", choice, "--threads", threads});
            CHECK(found["settings"]["own"]["list-or-grid"] == choice);
            for (std::size_t i = 0; i < 5; ++i) {
                CHECK(found["frames"][i]["image_hash"] == expected["frames"][i]["image_hash"]);
                const auto& adaptive = found["frames"][i]["adaptive"];
                CHECK(adaptive["spent_ms"].get<double>() > 0.0);
                CHECK(adaptive["ratio"].get<double>() >= 1.0);
                if (choice == std::string("always-list")) CHECK(adaptive["grids"] == 0);
            }
        }
    const Outcome wrong = call({"render", scene, "--strategy", "adaptive", "--list-or-grid", "threshold"});
    CHECK(wrong.code == 2);
    CHECK(wrong.err.find("--list-or-grid: 'threshold', expected learned") != std::string::npos);
    CHECK(call({"render", scene, "--strategy", "lazy", "--list-or-grid", "learned"}).code == 2);
    CHECK(call({"render", scene, "--strategy", "adaptive", "--costs", "test=0"}).code == 2);
}

}  // namespace
}  // namespace firstray::command
