#include "bench/measure/contestant.h"

#include <doctest/doctest.h>

#include "engine/core/errors.h"

using namespace firstray;

TEST_CASE("a contestant is a strategy, perhaps with choices of its own")
{
    const Contestant plain = parse_contestant("grid");
    CHECK(plain.name == "grid");
    CHECK(plain.entry->name == "grid");
    CHECK(plain.own.empty());
    const Contestant chosen = parse_contestant("obb+obb-top=list+obb-groups=all");
    CHECK(chosen.name == "obb+obb-top=list+obb-groups=all");
    CHECK(chosen.entry->name == "obb");
    REQUIRE(chosen.own.size() == 2);
    CHECK(chosen.own[1] == std::pair<std::string, std::string>("obb-groups", "all"));
}

TEST_CASE("a contestant that there is not is refused with what there is")
{
    const std::pair<const char*, const char*> cases[] = {{"gird", "expected one of list, grid"},
                                                         {"", "expected one of list, grid"},
                                                         {"obb+obb-top", "expected one of grid, list"},
                                                         {"obb+obb-top=gird", "obb-top 'gird'"},
                                                         {"lazy+obb-top=list", "strategy lazy has no choice 'obb-top'"},
                                                         {"obb+", "strategy obb has no choice ''"}};
    for (const auto& [text, message] : cases) {
        const auto text_now = text;  // clang 14 captures no structured bindings
        CAPTURE(text_now);
        CHECK_THROWS_WITH_AS(parse_contestant(text), doctest::Contains(message), Error);
    }
}
