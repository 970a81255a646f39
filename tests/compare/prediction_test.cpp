#include "bench/compare/prediction.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace firstray::compare;

namespace {

/// Update 1000 ms, trace 14,000 ms for 480,000 rays: the paper's Robots with a grid that is rebuilt.
const Point paper{.threads = 1, .rays = 480000.0, .update_ms = 1000.0, .trace_ms = 14000.0, .build_ms = 0.0};

}  // namespace

TEST_CASE("the paper's argument: 14 s of tracing and 1 s of serial update are balanced at about 16 processors")
{
    const Cost cost = fit_cost(paper, {});
    CHECK(cost.update_serial_ms == 1000.0);
    CHECK(cost.update_shared_ms == 0.0);
    CHECK(balanced_processors(cost, paper.rays) == doctest::Approx(14.0));
    CHECK(predicted_total_ms(cost, 1, paper.rays) == doctest::Approx(15000.0));
    CHECK(predicted_total_ms(cost, 16, paper.rays) == doctest::Approx(1875.0));
    CHECK(predicted_total_ms(cost, 32, paper.rays) == doctest::Approx(1437.5));  // 30 % faster for twice the machine
    CHECK(predicted_total_ms(cost, 16, paper.rays / 5) == doctest::Approx(1175.0));
    CHECK(std::isinf(balanced_processors({.ns_per_ray = 5.0}, 100.0)));
}

TEST_CASE("what two threads save of an update is shared by Amdahl's law")
{
    Point alone{.threads = 1, .rays = 1000.0, .update_ms = 10.0, .trace_ms = 50.0, .build_ms = 20.0};
    const auto with = [&](int threads, double update) {
        return fit_cost(alone, Point{.threads = threads, .rays = 1000.0, .update_ms = update});
    };
    CHECK(with(2, 10.0).update_serial_ms == doctest::Approx(10.0));
    CHECK(with(2, 5.0).update_serial_ms == doctest::Approx(0.0));
    CHECK(with(2, 7.0).update_serial_ms == doctest::Approx(4.0));
    CHECK(with(4, 4.0).update_serial_ms == doctest::Approx(2.0));
    CHECK(with(2, 14.0).update_serial_ms == 10.0);  // noise: slower than alone
    CHECK(with(2, 3.0).update_serial_ms == 0.0);    // noise: faster than twice
    const Cost cost = with(2, 7.0);
    CHECK(cost.ns_per_ray == doctest::Approx(30000.0));
    CHECK(predicted_update_ms(cost, 3) == doctest::Approx(6.0));
    CHECK(predicted_trace_ms(cost, 2, 500.0) == doctest::Approx(17.5));  // building does not shrink with the rays
}

TEST_CASE("what tracing takes is parted into what any ray costs and what more rays cost")
{
    const Point many{.threads = 1, .rays = 1000.0, .update_ms = 1.0, .trace_ms = 50.0, .build_ms = 20.0};
    const auto with = [&](double rays, double trace) {
        return fit_cost(many, {}, Point{.threads = 1, .rays = rays, .trace_ms = trace});
    };
    CHECK(with(200.0, 18.0).fixed_ms == doctest::Approx(10.0));
    CHECK(with(200.0, 18.0).ns_per_ray == doctest::Approx(40000.0));
    CHECK(with(200.0, 50.0).fixed_ms == doctest::Approx(50.0));
    CHECK(with(200.0, 50.0).ns_per_ray == 0.0);
    CHECK(with(200.0, 5.0).fixed_ms == 0.0);  // less than in proportion: noise
    CHECK(with(200.0, 5.0).ns_per_ray == doctest::Approx(50000.0));
    CHECK(with(200.0, 60.0).fixed_ms == 50.0);   // more for fewer rays: likewise
    CHECK(with(1000.0, 50.0).fixed_ms == 20.0);  // one point: what was built
    CHECK(predicted_trace_ms(with(200.0, 18.0), 1.0, 1000.0) == doctest::Approx(50.0));
    CHECK(predicted_trace_ms(with(200.0, 18.0), 1.0, 200.0) == doctest::Approx(18.0));
}

TEST_CASE("two strategies break even where dear updates are paid back by cheap rays")
{
    const Cost grid{.update_serial_ms = 20.0, .ns_per_ray = 900.0}, obb{.update_serial_ms = 1.0, .ns_per_ray = 1000.0};
    const auto rays = break_even_rays(grid, obb, 1);
    REQUIRE(rays);
    CHECK(*rays == doctest::Approx(190000.0));
    CHECK(*break_even_rays(obb, grid, 1) == doctest::Approx(190000.0));
    CHECK(predicted_total_ms(grid, 1, *rays) == doctest::Approx(predicted_total_ms(obb, 1, *rays)));
    CHECK(*break_even_rays(grid, obb, 2) == doctest::Approx(380000.0));
    const Cost better{.update_serial_ms = 0.5, .ns_per_ray = 800.0};
    CHECK_FALSE(break_even_rays(better, grid, 1));
    CHECK_FALSE(break_even_rays(grid, grid, 1));
}

TEST_CASE("who is fastest changes at the break-even points and nowhere else")
{
    const std::vector<Cost> costs = {{.update_serial_ms = 20.0, .ns_per_ray = 900.0},
                                     {.update_serial_ms = 1.0, .ns_per_ray = 1000.0},
                                     {.update_serial_ms = 30.0, .ns_per_ray = 1000.0}};
    const std::vector<Reign> by_rays = fastest_by_rays(costs, 1, 1.0, 1e6);
    REQUIRE(by_rays.size() == 2);
    CHECK(by_rays[0].fastest == 1);
    CHECK(by_rays[0].from == 1.0);
    CHECK(by_rays[0].to == doctest::Approx(190000.0));
    CHECK(by_rays[1].fastest == 0);
    CHECK(by_rays[1].to == 1e6);

    // 570,000 rays: tracing differs by 57 ms on one processor, updates by 19.
    const std::vector<Reign> by_processors = fastest_by_processors(costs, 570001.0, 128);
    REQUIRE(by_processors.size() == 2);
    CHECK(by_processors[0].fastest == 0);
    CHECK(by_processors[0].to == 3.0);
    CHECK(by_processors[1].fastest == 1);
    CHECK(by_processors[1].from == 4.0);
    CHECK(by_processors[1].to == 128.0);
    CHECK(fastest_by_rays({}, 1, 1.0, 2.0).empty());
    CHECK(fastest_by_processors({}, 1.0, 4).empty());
}
