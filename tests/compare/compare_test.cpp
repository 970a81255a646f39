#include "bench/compare/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bench/compare/report.h"
#include "bench/compare/table.h"
#include "bench/compare/verdict.h"
#include "tests/compare/broken_strategies.h"
#include "tests/support/call_command.h"
#include "tests/support/scene_files.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::compare;

namespace {

Scene moving_square()
{
    return test::scene_of(std::string(test::moving_square));
}

Plan small_plan(const std::vector<std::string>& names, int frames = 3)
{
    Plan plan;
    for (const std::string& name : names) plan.contestants.push_back(parse_contestant(name));
    for (int frame = 0; frame < frames; ++frame) plan.frames.push_back(frame);
    plan.render = {.width = 24, .height = 18, .depth = 1};
    plan.threads = 1;
    plan.repeat = 2;
    return plan;
}

Json run(const Scene& scene, const Plan& plan, const Watch& watch = {})
{
    return compare::compare(scene, {}, plan, {"firstray compare test", "test.aff"}, watch).results;
}

Json row(const Json& results, const std::string& name)
{
    const Json* found = find_row(results, name);
    REQUIRE(found);
    return *found;
}

}  // namespace

TEST_CASE("every strategy of ours is timed in every round and frame, and agrees to the last bit")
{
    const Scene scene = moving_square();
    const Json results = run(scene, small_plan({"list", "grid", "obb", "obb+obb-top=list", "lazy"}));
    CHECK(results["interrupted"] == false);
    REQUIRE(results["frames"].size() == 3);
    CHECK(results["frames"][0]["rays"]["primary"] == 24 * 18);
    CHECK(results["frames"][0]["asked"]["shadow"] == results["frames"][0]["rays"]["shadow"]);
    REQUIRE(results["strategies"].size() == 5);
    for (const Json& strategy : results["strategies"]) {
        CAPTURE(strategy["name"]);
        CHECK(strategy["status"] == "exact");
        CHECK(strategy["accuracy"]["rays"].get<int>() > 3 * 24 * 18);
        CHECK(strategy["accuracy"]["unlike"] == 0);
        CHECK(strategy["accuracy"]["image"]["pixels"] == 3 * 24 * 18);
        CHECK(strategy["accuracy"]["image"]["psnr"].is_null());
        REQUIRE(strategy["frames"].size() == 3);
        for (const Json& frame : strategy["frames"]) {
            CHECK(frame["update_ms"].size() == 2);
            CHECK(frame["trace_ms"][1].get<double>() > 0.0);
            CHECK(frame["ns_per_ray"]["shadow"][1].get<double>() > 0.0);
            CHECK(frame["structure_ms"][0].get<double>() > 0.0);
        }
    }
    CHECK(row(results, "obb+obb-top=list")["own"]["obb-top"] == "list");
}

TEST_CASE("medians and spread are those of the rounds' means over the frames, when computed again")
{
    const Scene scene = moving_square();
    Plan plan = small_plan({"grid", "lazy"});
    plan.repeat = 5;
    const Json results = run(scene, plan);
    for (const Json& strategy : results["strategies"]) {
        std::vector<double> means;
        for (std::size_t round = 0; round < 5; ++round) {
            double sum = 0.0;
            for (std::size_t f = 0; f < 3; ++f)
                sum += strategy["frames"][f]["update_ms"][round].get<double>() +
                       strategy["frames"][f]["trace_ms"][round].get<double>();
            means.push_back(sum / 3.0);
        }
        std::sort(means.begin(), means.end());
        const Json& total = strategy["times"]["total_ms"];
        CHECK(total["median"].get<double>() == doctest::Approx(means[2]));
        CHECK(total["least"].get<double>() == doctest::Approx(means[0]));
        CHECK(total["most"].get<double>() == doctest::Approx(means[4]));
    }
}

TEST_CASE("a strategy that fails is a row with its reason, and the others go on")
{
    const Scene scene = moving_square();
    Plan plan = small_plan({"grid"});
    for (const StrategyEntry* entry : {&test::unmakable, &test::tiring, &test::blind})
        plan.contestants.push_back({std::string(entry->name), entry, {}});
    plan.contestants.push_back(parse_contestant("lazy"));
    const Json results = run(scene, plan);
    CHECK(row(results, "grid")["status"] == "exact");
    CHECK(row(results, "lazy")["status"] == "exact");
    const std::pair<const char*, const char*> faults[] = {
        {"unmakable", "cannot be made"}, {"tiring", "the second update is too much"}, {"blind", "cannot search"}};
    const std::string table = summary_table(results);
    for (const auto& [name, reason] : faults) {
        const auto name_now = name;  // clang 14 captures no structured bindings
        CAPTURE(name_now);
        CHECK(row(results, name)["status"] == "failed");
        CHECK(row(results, name)["reason"] == reason);
        CHECK(row(results, name)["times"].is_null());
        CHECK(table.find(std::string("failed: ") + reason) != std::string::npos);
    }
    CHECK_NOTHROW(to_csv(results));
}

TEST_CASE("a strategy that misses is marked, never dropped, and never named fastest")
{
    const Scene scene = moving_square();
    Plan plan = small_plan({"grid"});
    plan.contestants.push_back({"leaky", &test::leaky, {}});
    plan.repeat = 3;
    const Json results = run(scene, plan);
    const Json leaky = row(results, "leaky");
    CHECK(leaky["status"] == "differs");
    CHECK(leaky["times"]["total_ms"]["median"].get<double>() > 0.0);
    CHECK(leaky["accuracy"]["missed"].get<int>() > 10);
    CHECK(leaky["accuracy"]["false"] == 0);
    CHECK(leaky["accuracy"]["image"]["rmse"].get<double>() > 0.0);
    CHECK(summary_table(results).find("!! disagrees") != std::string::npos);
    CHECK(results["verdict"]["all"]["fastest"] == "grid");
}

TEST_CASE("an interruption leaves what was finished, whole rounds alone")
{
    const Scene scene = moving_square();
    Plan plan = small_plan({"grid", "lazy"}, 2);
    plan.repeat = 3;
    // 2 frames: 6 steps to check, then 4 a round.
    for (const int steps : {0, 3, 6, 9, 10, 13, 14}) {
        CAPTURE(steps);
        int taken = 0;
        const Json results =
            run(scene, plan, {{}, [&](const std::string&, double) { ++taken; }, [&] { return taken >= steps; }});
        CHECK(results["interrupted"] == true);
        const int rounds = std::max(0, (steps - 6) / 4);
        CHECK(results["settings"]["rounds"] == rounds);
        for (const Json& strategy : results["strategies"]) {
            CHECK(strategy["status"] == (rounds > 0 ? "exact" : "unmeasured"));
            CHECK(strategy["times"].is_null() == (rounds == 0));
        }
        CHECK(summary_table(results).find("(interrupted)") != std::string::npos);
        CHECK_NOTHROW(to_csv(results));
    }
}

TEST_CASE("an interruption leaves whole rounds of what comes after the strategies, too")
{
    const Scene scene = moving_square();
    Plan plan = small_plan({"grid", "lazy"});
    plan.repeat = 3;
    plan.frameless = {1, 3};
    plan.trade = true;
    const auto run_until = [&](const std::string& begin) {
        bool stop = false;
        const Json results =
            run(scene, plan,
                {{}, [&](const std::string& what, double) { stop |= what.starts_with(begin); }, [&] { return stop; }});
        CHECK(results["interrupted"] == true);
        CHECK_NOTHROW(report_html(results, {}));
        return results;
    };
    CHECK(!run_until("rays and threads, round 1").contains("sweep"));
    const Json swept = run_until("rays and threads, round 2");
    CHECK(swept["sweep"]["strategies"].size() == 2);
    CHECK(swept.contains("prediction"));
    CHECK(!swept.contains("frameless"));
    CHECK(run_until("frameless 1/3")["frameless"].size() == 1);
    CHECK(!run_until("trade, frame").contains("trade"));
    CHECK(!run_until("trade, round 1").contains("trade"));
    const Json traded = run_until("trade, round 3")["trade"];
    for (const Json& setting : traded["settings"]) CHECK(setting["totals"].size() == 2);
}

TEST_CASE("the work that is told before the first step is what all steps come to")
{
    const Scene scene = moving_square();
    for (const int threads : {1, 2}) {
        CAPTURE(threads);
        Plan plan = small_plan({"grid", "lazy"});
        plan.threads = threads;
        plan.pictured = {0, 2};
        plan.frameless = {1, 3};
        plan.trade = true;
        std::vector<double> told;
        double begun = 0.0;
        run(scene, plan,
            {[&](double work) { told.push_back(work); }, [&](const std::string&, double work) { begun += work; }, {}});
        REQUIRE(told.size() == 1);
        CHECK(begun == doctest::Approx(told[0]));
    }
}

TEST_CASE("a scene of one frame and a scene without anything are compared like others")
{
    for (const std::string text : {"v from 0 0 9 at 0 0 0 up 0 1 0 angle 60 hither 0.1 resolution 8 6\n",
                                   "v from 0 0 9 at 0 0 0 up 0 1 0 angle 60 hither 0.1 resolution 8 6\nl 0 9 9\n"
                                   "fm 1 1 1 1 1 1 0 0 0 0 0 0\np 3 -1 -1 0 1 -1 0 0 1 0\n"}) {
        CAPTURE(text);
        const Scene scene = test::scene_of(text);
        REQUIRE(scene.frames == 1);
        Plan plan = small_plan({"list", "grid", "obb", "lazy"}, 1);
        plan.repeat = 3;
        const Json results = run(scene, plan);
        for (const Json& strategy : results["strategies"]) CHECK(strategy["status"] == "exact");
        CHECK_FALSE(results["verdict"]["own"].is_null());
    }
}

TEST_CASE("a report's folder holds results that read back, and other files are refused")
{
    const test::TempFolder folder;
    const Scene scene = moving_square();
    const Json results = run(scene, small_plan({"grid", "lazy"}));
    write_report(folder.path() / "a" / "b", {results, {}});
    CHECK(read_results(folder.path() / "a" / "b") == results);
    CHECK(read_results(folder.path() / "a" / "b" / "results.json") == results);
    CHECK_THROWS_AS(read_results(folder.path()), FileError);
    CHECK_THROWS_WITH_AS(read_results(folder.write("other.json", "{}")), doctest::Contains("does not hold"), FileError);
    CHECK_THROWS_WITH_AS(read_results(folder.write("bad.json", "{")), doctest::Contains("does not hold"), FileError);
    Json newer = results;
    newer["version"] = 99;
    CHECK_THROWS_WITH_AS(read_results(folder.write("new.json", newer.dump())), doctest::Contains("version 99"),
                         FileError);
    const std::string csv = to_csv(results);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 2 * 3 * 2);
}
