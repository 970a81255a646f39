#include "lazy/calibrate.h"

#include <doctest/doctest.h>

#include <chrono>

using namespace firstray::lazy;

TEST_CASE("calibration: costs are positive and of a size that a processor can have")
{
    const auto start = std::chrono::steady_clock::now();
    const Costs costs = calibrate();
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    for (const CostName& name : cost_names()) {
        CAPTURE(name.name);
        CHECK(costs.*name.cost > 0.0);
        CHECK(costs.*name.cost < 1e6);
    }
    MESSAGE("calibrated in " << spent.count() << " ms");
    CHECK(&calibrated_costs() == &calibrated_costs());
}
