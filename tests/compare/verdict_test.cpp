#include "bench/compare/verdict.h"

#include <doctest/doctest.h>

using namespace firstray;
using namespace firstray::compare;

namespace {

/// A row that took `totals` ms a frame, by round.
Json timed(const std::string& name, const std::vector<double>& totals, const std::string& status = "exact",
           bool peer = false)
{
    Json frame = {{"frame", 0}, {"update_ms", Json::array()}, {"trace_ms", Json::array()}};
    for (const double total : totals) {
        frame["update_ms"].push_back(0.25 * total);
        frame["trace_ms"].push_back(0.75 * total);
    }
    return {{"name", name},
            {"status", status},
            {"peer", peer},
            {"accuracy",
             {{"rays", 1000}, {"missed_per_million", 2.0}, {"false_per_million", 1.0}, {"image", {{"rmse", 1e-4}}}}},
            {"times", {{"total_ms", to_json(spread_of(totals))}}},
            {"frames", {frame}}};
}

Json results(const std::vector<Json>& rows)
{
    Json document = {{"strategies", Json::array()}};
    for (const Json& row : rows) document["strategies"].push_back(row);
    return document;
}

}  // namespace

TEST_CASE("a duel compares round with round, and is clear only where every round says so")
{
    const Json a = timed("a", {10.0, 20.0, 40.0});  // a machine that slows down
    CHECK(duel(a, timed("b", {11.0, 22.0, 44.0})).is_clear);
    CHECK(duel(a, timed("b", {11.0, 22.0, 44.0})).ratio.median == doctest::Approx(1.1));
    CHECK_FALSE(duel(a, timed("b", {11.0, 22.0, 39.0})).is_clear);
    CHECK_FALSE(duel(a, timed("b", {10.05, 20.1, 40.2})).is_clear);  // half a per cent
    CHECK_FALSE(duel(timed("a", {10.0, 20.0}), timed("b", {20.0, 40.0})).is_clear);
}

TEST_CASE("the winner is named with who cannot be told from it and who is next")
{
    const Json verdict = verdict_of(
        results({timed("slow", {30.0, 30.0, 30.0}), timed("near", {10.2, 9.9, 10.3}), timed("fast", {10.0, 10.0, 10.0}),
                 timed("wrong", {1.0, 1.0, 1.0}, "differs"), timed("peer", {8.0, 8.0, 8.0}, "close", true)}));
    CHECK(verdict["all"]["fastest"] == "peer");
    CHECK(verdict["all"]["second"] == "fast");
    CHECK(verdict["all"]["ratio"]["median"].get<double>() == doctest::Approx(1.25));
    CHECK(verdict["own"]["fastest"] == "fast");
    CHECK(verdict["own"]["level"] == Json::array({"near"}));
    CHECK(verdict["own"]["second"] == "slow");
    CHECK(verdict["faster_but_marked"] == Json::array({"wrong"}));
    const std::string sentence = verdict["own"]["sentence"];
    CHECK(sentence ==
          "fast takes 10.0 ms a frame, the least in the median; its hits and pictures are the reference's to the last "
          "bit (0 of 1,000 rays differ). near (10.2 ms) cannot be told from it in 3 rounds. slow takes 3.00 times as "
          "long (3.00 to 3.00 in the rounds).");
    CHECK(verdict["all"]["sentence"].get<std::string>().find("misses 2.00 and hits falsely 1.00 per million") !=
          std::string::npos);
}

TEST_CASE("where nothing counts there is no winner, and one alone has no second")
{
    CHECK(verdict_of(results({}))["all"].is_null());
    CHECK(verdict_of(results({timed("wrong", {1.0}, "differs")}))["own"].is_null());
    const Json verdict = verdict_of(results({timed("only", {1.0})}));
    CHECK(verdict["own"]["fastest"] == "only");
    CHECK(verdict["own"]["second"].is_null());
}
