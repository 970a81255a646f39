#include "bench/compare/sweep.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bench/compare/compare.h"
#include "bench/compare/prediction.h"
#include "tests/support/call_command.h"
#include "tests/support/scene_files.h"

using namespace firstray;
using namespace firstray::compare;

namespace {

Json run(const Scene& scene, int frames, int threads, std::vector<int> frameless)
{
    Plan plan;
    for (const char* name : {"grid", "lazy"}) plan.contestants.push_back(parse_contestant(name));
    for (int frame = 0; frame < frames; ++frame) plan.frames.push_back(frame);
    plan.render = {.width = 32, .height = 16, .depth = 1};
    plan.threads = threads;
    plan.repeat = 1;
    plan.frameless = std::move(frameless);
    return compare::compare(scene, {}, plan, {"test", "test.aff"}, {}).results;
}

}  // namespace

TEST_CASE("rays and threads are swept, and shares that are asked for beside the usual ones")
{
    const Scene scene = test::scene_of(test::moving_square);
    for (const int threads : {1, 2}) {
        CAPTURE(threads);
        const Json results = run(scene, 4, threads, {2, 16});
        REQUIRE(results["sweep"]["strategies"].size() == 2);
        CHECK(results["sweep"]["frames"] == Json::array({1, 3}));
        for (const Json& strategy : results["sweep"]["strategies"]) {
            REQUIRE(strategy["points"].size() == static_cast<std::size_t>(5 * threads));  // 1, 2, 4, 16, 64
            for (const Json& point : strategy["points"]) {
                CHECK(point["rays"].get<double>() == doctest::Approx(512.0 / point["turns"].get<int>()));
                CHECK(point["trace_ms"].get<double>() > 0.0);
            }
        }
        for (const Json& law : results["prediction"]["strategies"])
            CHECK(law["checked"].size() == static_cast<std::size_t>(5 * threads - 2));
    }
}

TEST_CASE("the report's predictions are the law's, computed again from its own numbers")
{
    const Json results = run(test::scene_of(test::moving_square), 5, 2, {});
    const Json& prediction = results["prediction"];
    std::vector<double> errors;
    for (std::size_t i = 0; i < 2; ++i) {
        const Json &law = prediction["strategies"][i], &points = results["sweep"]["strategies"][i]["points"];
        CAPTURE(law["name"]);
        Json alone, both;
        for (const Json& point : points)
            if (point["turns"] == 1) (point["threads"] == 1 ? alone : both) = point;
        const double update = law["update_serial_ms"].get<double>() + law["update_shared_ms"].get<double>();
        CHECK(update == doctest::Approx(alone["update_ms"].get<double>()));
        const double traced = law["fixed_ms"].get<double>() + 1e-6 * law["ns_per_primary_ray"].get<double>() * 512.0;
        CHECK(traced == doctest::Approx(alone["trace_ms"].get<double>()));
        for (const Json& total : law["totals"]) {
            const double n = total["processors"];
            const double expected =
                law["update_serial_ms"].get<double>() + law["update_shared_ms"].get<double>() / n + traced / n;
            CHECK(total["total_ms"].get<double>() == doctest::Approx(expected));
        }
        for (const Json& point : law["checked"]) {
            const double error = point["predicted_ms"].get<double>() / point["measured_ms"].get<double>() - 1.0;
            CHECK(point["error"].get<double>() == doctest::Approx(error));
            errors.push_back(std::abs(error));
        }
    }
    CHECK(prediction["largest_error"].get<double>() ==
          doctest::Approx(*std::max_element(errors.begin(), errors.end())));
    CHECK(prediction["checked_points"] == errors.size());
    const auto [least, largest] = std::minmax_element(errors.begin(), errors.end());
    for (const char* part : {"median_error", "median_error_one_thread", "median_error_threads"}) {
        CHECK(prediction[part].get<double>() >= *least);
        CHECK(prediction[part].get<double>() <= *largest);
    }
    CHECK(prediction["fastest_by_processors"][0]["from"] == 1.0);
    CHECK(prediction["fastest_by_processors"].back()["to"] == 128.0);
}

TEST_CASE("who is named fastest by rays and processors is so by the laws beside it, and break-even points are even")
{
    const Json results = run(test::scene_of(test::moving_square), 5, 2, {});
    const Json& prediction = results["prediction"];
    const double rays = prediction["rays"], threads = prediction["threads"];
    const auto total = [&](const std::string& name, double processors, double traced) {
        for (const Json& law : prediction["strategies"])
            if (law["name"] == name)
                return law["update_serial_ms"].get<double>() +
                       (law["update_shared_ms"].get<double>() + law["fixed_ms"].get<double>() +
                        1e-6 * law["ns_per_primary_ray"].get<double>() * traced) /
                           processors;
        FAIL("no law of " << name);
        return 0.0;
    };
    const auto is_fastest = [&](const std::string& name, double processors, double traced) {
        const double least = total(name, processors, traced) * (1.0 - 1e-9);
        return total("grid", processors, traced) >= least && total("lazy", processors, traced) >= least;
    };
    double next = 1.0;
    for (const Json& reign : prediction["fastest_by_processors"]) {
        CHECK(reign["from"] == next);
        for (; next <= reign["to"]; ++next) CHECK(is_fastest(reign["fastest"], next, rays));
    }
    CHECK(next == 129.0);
    for (const Json& reign : prediction["fastest_by_rays"])
        for (const char* end : {"from", "to"}) CHECK(is_fastest(reign["fastest"], threads, reign[end]));
    for (const Json& even : prediction["break_even"]) {
        const double at = even["rays"];
        CHECK(total(even["below"], threads, at) == doctest::Approx(total(even["above"], threads, at)));
        CHECK(total(even["below"], threads, 0.9 * at) < total(even["above"], threads, 0.9 * at));
    }
}

TEST_CASE("frameless, all pixels have no error, fewer have more while things move, and none in a still scene")
{
    const Json moving = run(test::scene_of(test::moving_square), 5, 1, {1, 2, 8})["frameless"];
    REQUIRE(moving.size() == 3);
    CHECK(moving[0]["image"]["unlike"] == 0);
    CHECK(moving[1]["image"]["unlike"].get<int>() > 0);
    CHECK(moving[2]["image"]["rmse"].get<double>() > moving[1]["image"]["rmse"].get<double>());
    CHECK(moving[2]["worst_rmse"].get<double>() >= moving[2]["image"]["rmse"].get<double>());
    CHECK(moving[0]["frames"] == Json::array({1, 2, 3, 4}));
    CHECK(moving[2]["is_refreshed"] == false);  // five frames are too few for eighths

    const Json still =
        run(test::scene_of("l 0 9 9\nfm 1 1 1 1 1 1 0 0 0 0 0 0\np 3 -1 -1 0 1 -1 0 0 1 0\n"), 1, 1, {4});
    CHECK(still["frameless"][0]["image"]["unlike"] == 0);
}
