#include "bench/compare/text.h"

#include <doctest/doctest.h>

#include <limits>

using namespace firstray::compare;

TEST_CASE("numbers have three digits")
{
    const std::pair<double, const char*> cases[] = {{0.0, "0"},
                                                    {0.00004, "4.0e-05"},
                                                    {0.01234, "0.0123"},
                                                    {0.1, "0.100"},
                                                    {1.0, "1.00"},
                                                    {9.996, "10.0"},
                                                    {12.34, "12.3"},
                                                    {99.96, "100"},
                                                    {1234.5, "1234"},
                                                    {-2.5, "-2.50"},
                                                    {std::numeric_limits<double>::infinity(), "inf"}};
    for (const auto& [value, text] : cases) CHECK(short_number(value) == text);
    CHECK(milliseconds(12.34) == "12.3 ms");
    CHECK(megabytes(1.5e6) == "1.50 MB");
    CHECK(percent(0.125) == "12.5 %");
}

TEST_CASE("long counts are grouped by thousands")
{
    CHECK(grouped(0) == "0");
    CHECK(grouped(999) == "999");
    CHECK(grouped(1000) == "1,000");
    CHECK(grouped(1234567) == "1,234,567");
}

TEST_CASE("lists end in and")
{
    CHECK(listed({}) == "none");
    CHECK(listed({"a"}) == "a");
    CHECK(listed({"a", "b"}) == "a and b");
    CHECK(listed({"a", "b", "c"}) == "a, b and c");
}
