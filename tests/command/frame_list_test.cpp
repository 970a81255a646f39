#include "bench/firstray/frame_list.h"

#include <doctest/doctest.h>

#include <string>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

TEST_CASE("frames are listed as numbers, ranges and ranges with a step")
{
    CHECK(frames_of(parse_frame_list("12"), 800) == std::vector<int>{12});
    CHECK(frames_of(parse_frame_list("0,5,10-13"), 800) == std::vector<int>{0, 5, 10, 11, 12, 13});
    CHECK(frames_of(parse_frame_list("0-25:10"), 800) == std::vector<int>{0, 10, 20});
    CHECK(frames_of(parse_frame_list("0-799:10"), 800).size() == 80);
    CHECK(frames_of(parse_frame_list("7-7:3"), 8) == std::vector<int>{7});
}

TEST_CASE("a frame that is listed twice is rendered once, in ascending order")
{
    CHECK(frames_of(parse_frame_list("5,3-6,0"), 10) == std::vector<int>{0, 3, 4, 5, 6});
}

TEST_CASE("a frame list that cannot be read is a usage fault")
{
    for (const std::string text : {"", ",", "1,", "a", "-1", "1-", "5-4", "1:2", "1-9:0", "1-9:2:3", "1-2-3", "1 - 2",
                                   "99999999999", "1.5", "0-9:-1"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_frame_list(text), UsageError);
    }
}

TEST_CASE("a frame beyond the animation is a usage fault, found without listing what leads there")
{
    CHECK_THROWS_WITH_AS(frames_of(parse_frame_list("0-1000000000"), 800),
                         "frame 1000000000 is not in the scene, expected one from 0 to 799", UsageError);
    CHECK_THROWS_AS(frames_of(parse_frame_list("800"), 800), UsageError);
}

}  // namespace
}  // namespace firstray::command
