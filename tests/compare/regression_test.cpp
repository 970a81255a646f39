#include "bench/compare/regression.h"

#include <doctest/doctest.h>

#include "bench/compare/compare.h"
#include "engine/core/errors.h"
#include "tests/support/call_command.h"
#include "tests/support/scene_files.h"

using namespace firstray;
using namespace firstray::compare;

namespace {

Json spread(double least, double median, double most)
{
    return {{"median", median}, {"least", least}, {"most", most}};
}

/// A real run's document with times made up.
Json made_up_run()
{
    Plan plan;
    for (const char* name : {"grid", "lazy"}) plan.contestants.push_back(parse_contestant(name));
    plan.frames = {0, 2};
    plan.render = {.width = 8, .height = 6};
    plan.threads = 1;
    plan.repeat = 1;
    const Scene scene = test::scene_of(test::moving_square);
    Json results = compare::compare(scene, {}, plan, {"test", "test.aff"}, {}).results;
    results["load_before"] = 0.0;
    for (Json& strategy : results["strategies"])
        for (const char* key : {"update_ms", "trace_ms", "structure_ms", "total_ms"})
            strategy["times"][key] = spread(9.0, 10.0, 11.0);
    return results;
}

}  // namespace

TEST_CASE("a run is no regression of itself")
{
    const Json run = made_up_run();
    const Json changes = compare_runs(run, run);
    CHECK(changes["changes"].empty());
    CHECK(changes["regressions"] == 0);
    CHECK(change_table(changes).find("nothing changed") == 0);
}

TEST_CASE("a time is a change where the rounds of both runs do not overlap and five per cent lie between")
{
    const Json before = made_up_run();
    struct Case {
        Json after;
        int changes, regressions;
    };
    const Case cases[] = {
        {spread(11.5, 12.0, 12.5), 1, 1},  // slower
        {spread(10.9, 12.0, 12.5), 0, 0},  // one round as fast as the slowest before
        {spread(11.1, 11.2, 11.3), 1, 1},  // by twelve per cent
        {spread(7.0, 8.0, 8.9), 1, 0},     // faster
        {spread(7.0, 8.0, 9.1), 0, 0},
    };
    for (const Case& c : cases) {
        CAPTURE(c.after);
        Json after = before;
        after["strategies"][1]["times"]["update_ms"] = c.after;
        const Json changes = compare_runs(before, after);
        CHECK(changes["changes"].size() == static_cast<std::size_t>(c.changes));
        CHECK(changes["regressions"] == c.regressions);
    }
    Json small = before, smaller = before;
    small["strategies"][0]["times"]["update_ms"] = spread(0.010, 0.011, 0.012);
    smaller["strategies"][0]["times"]["update_ms"] = spread(0.020, 0.021, 0.022);
    CHECK(compare_runs(small, smaller)["changes"].empty());  // twice as long, but nothing in milliseconds
}

TEST_CASE("where the machine was busy, or peers changed too, that is said")
{
    const auto notes = [](const Json& before, const Json& after) {
        return compare_runs(before, after)["notes"].dump();
    };
    const Json before = made_up_run();
    CHECK(notes(before, before) == "[]");
    Json busy = before;
    busy["load_before"] = 1.5;
    CHECK(notes(before, busy).find("the second run: other programs were at work") != std::string::npos);
    CHECK(notes(busy, before).find("the first run: other programs were at work") != std::string::npos);
    Json peer = before;
    peer["strategies"][0]["peer"] = true;
    Json slower = peer;
    slower["strategies"][0]["times"]["total_ms"] = spread(18.0, 20.0, 22.0);
    CHECK(notes(peer, peer) == "[]");
    CHECK(notes(peer, slower).find("grid, which is not ours, changed too") != std::string::npos);
    CHECK(notes(slower, peer).find("grid, which is not ours, changed too") != std::string::npos);
}

TEST_CASE("more memory, less accuracy and a strategy that now fails are regressions")
{
    const Json before = made_up_run();
    Json memory = before, accuracy = before, failed = before, gone = before;
    for (Json& frame : memory["strategies"][0]["frames"])
        frame["structure"]["bytes"] = 2 * frame["structure"]["bytes"].get<int>() + 100;
    CHECK(compare_runs(before, memory)["regressions"] == 1);
    CHECK(compare_runs(memory, before)["regressions"] == 0);
    CHECK(compare_runs(memory, before)["changes"].size() == 1);
    accuracy["strategies"][0]["accuracy"]["missed_per_million"] = 0.5;
    accuracy["strategies"][0]["accuracy"]["image"]["rmse"] = 1e-6;
    CHECK(compare_runs(before, accuracy)["regressions"] == 2);
    failed["strategies"][1]["status"] = "failed";
    failed["strategies"][1]["times"] = nullptr;
    CHECK(compare_runs(before, failed)["regressions"] == 1);
    CHECK(change_table(compare_runs(before, failed)).find("worse  lazy status: exact -> failed") != std::string::npos);
    gone["strategies"].erase(1);
    CHECK(compare_runs(before, gone)["notes"][0] == "lazy is not in the second run");
}

TEST_CASE("runs of other settings or scenes are refused")
{
    const Json before = made_up_run();
    Json other = before;
    other["settings"]["threads"] = 2;
    CHECK_THROWS_WITH_AS(compare_runs(before, other), doctest::Contains("threads is 1 in one and 2"), Error);
    other = before;
    other["scene"]["name"] = "another";
    CHECK_THROWS_AS(compare_runs(before, other), Error);
    other = before;
    other["frames"].erase(1);
    CHECK_THROWS_WITH_AS(compare_runs(before, other), doctest::Contains("frames is [0,2]"), Error);
}

TEST_CASE("the command exits with 1 on a regression and 0 without")
{
    const test::TempFolder folder;
    const Json before = made_up_run();
    Json slower = before;
    slower["strategies"][0]["times"]["total_ms"] = spread(20.0, 21.0, 22.0);
    const std::string a = folder.write("a/results.json", before.dump()).string(),
                      b = folder.write("b/results.json", slower.dump()).string();
    CHECK(test::call({"compare", a, a}).code == 0);
    const test::Outcome outcome = test::call({"compare", a, (folder.path() / "b").string()});
    CHECK(outcome.code == 1);
    CHECK(outcome.out.find("worse  grid total_ms: 10.0 -> 21.0 (+110 %)\n1 regression\n") != std::string::npos);
    CHECK(test::call({"compare", b, a}).code == 0);
    CHECK(test::call({"compare", a, a + "x"}).code == 4);
}
