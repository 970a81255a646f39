#include "bench/measure/spread.h"

#include <doctest/doctest.h>

using namespace firstray;

TEST_CASE("the median is the middle value, or the mean of both in the middle")
{
    CHECK(median({3.0}) == 3.0);
    CHECK(median({9.0, 1.0, 5.0}) == 5.0);
    CHECK(median({4.0, 1.0, 2.0, 9.0}) == 3.0);
    const Spread spread = spread_of({7.0, 2.0, 4.0});
    CHECK(spread.median == 4.0);
    CHECK(spread.least == 2.0);
    CHECK(spread.most == 7.0);
}

TEST_CASE("a quantile is a value that the share of all does not exceed")
{
    const std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0};
    CHECK(quantile(values, 0.0) == 1.0);
    CHECK(quantile(values, 0.5) == 3.0);
    CHECK(quantile(values, 0.6) == 4.0);
    CHECK(quantile(values, 1.0) == 5.0);
    CHECK(quantile({}, 0.5) == 0.0);
}
