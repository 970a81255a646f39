#include "bench/firstray/words.h"

#include <doctest/doctest.h>

namespace firstray::command {
namespace {

constexpr std::string_view strategies[] = {"list", "grid", "obb", "lazy", "adaptive"};

TEST_CASE("a misspelt word is answered with the word that was meant")
{
    CHECK(suggestion("gird", strategies) == "; did you mean grid?");
    CHECK(suggestion("adaptve", strategies) == "; did you mean adaptive?");
    CHECK(suggestion("bvh-wide-8", strategies) == "");
    CHECK_THROWS_WITH_AS(find_word("--strategy", "gird", strategies),
                         "--strategy: 'gird', expected list, grid, obb, lazy or adaptive; did you mean grid?",
                         UsageError);
    CHECK(find_word("--strategy", "obb", strategies) == 2);
}

TEST_CASE("a whole number is taken only when nothing but the number is there")
{
    CHECK(parse_int("n", "12", 0, 20) == 12);
    for (const std::string text : {"", "1x", " 1", "21", "-1", "1.0", "99999999999"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_int("n", text, 0, 20), UsageError);
    }
}

TEST_CASE("splitting keeps empty parts")
{
    CHECK(split("a,,b", ',') == std::vector<std::string_view>{"a", "", "b"});
    CHECK(split("", ',') == std::vector<std::string_view>{""});
    CHECK(split("a,", ',') == std::vector<std::string_view>{"a", ""});
}

TEST_CASE("a share of the pixels is 1 or 1/X")
{
    CHECK(parse_share("--frameless", "1") == 1);
    CHECK(parse_share("--frameless", "1/1") == 1);
    CHECK(parse_share("--frameless", "1/64") == 64);
    for (const std::string text : {"", "2", "1/", "1/0", "1/-3", "1/4097", "2/3", "0.5", "1/5x"}) {
        CAPTURE(text);
        CHECK_THROWS_WITH_AS(parse_share("--frameless", text), doctest::Contains("--frameless"), UsageError);
    }
}

}  // namespace
}  // namespace firstray::command
