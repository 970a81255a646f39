#include "bench/firstray/output_pattern.h"

#include <doctest/doctest.h>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

TEST_CASE("the run of # becomes the frame's number, padded with zeros")
{
    CHECK(frame_file("out/a.####.exr", 7) == "out/a.0007.exr");
    CHECK(frame_file("a#.png", 123) == "a123.png");
    CHECK(frame_file("##", 5) == "05");
    CHECK(frame_file("still.png", 5) == "still.png");
}

TEST_CASE("a pattern that does not fit its pictures is a usage fault")
{
    CHECK_NOTHROW(check_pattern("a.png", 1, false));
    CHECK_NOTHROW(check_pattern("a.####.exr", 9, true));
    CHECK_THROWS_WITH_AS(check_pattern("a.png", 2, false), doctest::Contains("one file for 2 frames"), UsageError);
    CHECK_THROWS_WITH_AS(check_pattern("#/a.#.png", 2, false), doctest::Contains("a single run of #"), UsageError);
    CHECK_THROWS_WITH_AS(check_pattern("a.#.png", 2, true), doctest::Contains("expected .exr"), UsageError);
    CHECK_THROWS_AS(check_pattern("a.#.jpg", 2, false), UsageError);
    CHECK_THROWS_AS(check_pattern("a.#", 2, false), UsageError);
}

TEST_CASE("layers are named in any order, each once")
{
    using image::Aov;
    CHECK(parse_aovs("") == std::vector<Aov>{});
    CHECK(parse_aovs("time,distance") == std::vector<Aov>{Aov::time, Aov::distance});
    CHECK_THROWS_WITH_AS(parse_aovs("distanse"), doctest::Contains("did you mean distance?"), UsageError);
    CHECK_THROWS_AS(parse_aovs("time,time"), UsageError);
    CHECK_THROWS_AS(parse_aovs("time,"), UsageError);
}

TEST_CASE("costs are counted only when a layer shows them")
{
    CHECK_FALSE(any_cost(parse_aovs("distance,primitive,group")));
    for (const std::string name : {"cells", "tests", "time"}) {
        CAPTURE(name);
        CHECK(any_cost(parse_aovs("distance," + name)));
    }
}

}  // namespace
}  // namespace firstray::command
