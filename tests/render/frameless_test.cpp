#include "engine/render/frameless.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "engine/render/render.h"
#include "tests/support/reference_strategy.h"
#include "tests/support/small_scene.h"

using namespace firstray;

namespace {

/// By pixel, row by row: how often a picture's turns trace it.
std::vector<int> visits(const FramelessTurns& turns, int width, int height)
{
    std::vector<int> visited(static_cast<std::size_t>(width * height), 0);
    for (std::size_t turn = 0; turn < turns.count(); ++turn)
        for (const glm::ivec2 pixel : turns.pixels(turn))
            ++visited.at(static_cast<std::size_t>(pixel.y * width + pixel.x));
    return visited;
}

/// A lit ball in front of a wall, a mirror and a sheet of glass.
Scene still_scene()
{
    test::SmallScene small;
    small.scene.background = {0.2f, 0.3f, 0.5f};
    small.light({3, 5, 1});
    small.quad({}, {0, -1, -6}, {4, 0, 0}, {0, 1, 0});
    small.sphere({.specular = glm::vec3(0.5f), .shine = 9.0f}, {0.3, 0, -4}, 0.9);
    small.quad({.transmittance = 0.5f}, {-1, 0, -3}, {1, 0, 0}, {0, 1, 0});
    return small.build();
}

}  // namespace

TEST_CASE("a Hilbert curve visits every pixel of a square once and steps to neighbours only")
{
    for (const int side : {1, 2, 4, 32}) {
        CAPTURE(side);
        const std::vector<glm::ivec2> order = hilbert_order(side, side);
        REQUIRE(order.size() == static_cast<std::size_t>(side * side));
        std::set<std::pair<int, int>> seen;
        for (const glm::ivec2 place : order) seen.emplace(place.x, place.y);
        CHECK(seen.size() == order.size());
        int leaps = 0;
        for (std::size_t i = 1; i < order.size(); ++i) {
            const glm::ivec2 step = glm::abs(order[i] - order[i - 1]);
            leaps += step.x + step.y != 1;
        }
        CHECK(leaps == 0);
    }
}

TEST_CASE("every pixel is traced once in as many frames as there are turns, and turns are of one size")
{
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(7, 3), glm::ivec2(100, 75), glm::ivec2(1, 40)})
        for (const int count : {1, 2, 5, 16, 64}) {
            CAPTURE(size.x);
            CAPTURE(count);
            const FramelessTurns turns(size.x, size.y, count, 3);
            REQUIRE(turns.count() == static_cast<std::size_t>(count));
            const std::vector<int> visited = visits(turns, size.x, size.y);
            CHECK(std::count(visited.begin(), visited.end(), 1) == size.x * size.y);
            std::size_t least = visited.size(), most = 0;
            for (std::size_t turn = 0; turn < turns.count(); ++turn) {
                least = std::min(least, turns.pixels(turn).size());
                most = std::max(most, turns.pixels(turn).size());
            }
            CHECK(most - least <= 1);
        }
}

TEST_CASE("a turn's pixels are spread evenly: of 16 turns each has one in every block of 4 x 4")
{
    const FramelessTurns turns(64, 32, 16, 11);
    for (std::size_t turn = 0; turn < 16; ++turn) {
        std::set<std::pair<int, int>> blocks;
        for (const glm::ivec2 pixel : turns.pixels(turn)) blocks.emplace(pixel.x / 4, pixel.y / 4);
        CHECK(blocks.size() == 16 * 8);
    }
}

TEST_CASE("a turn's pixels follow from the seed, and turns come again")
{
    const FramelessTurns a(50, 40, 8, 1), b(50, 40, 8, 1), c(50, 40, 8, 2);
    const auto pixels = [](const FramelessTurns& turns, std::size_t turn) {
        const auto span = turns.pixels(turn);
        return std::vector<glm::ivec2>(span.begin(), span.end());
    };
    for (std::size_t turn = 0; turn < 8; ++turn) {
        CHECK(pixels(a, turn) == pixels(b, turn));
        CHECK(pixels(a, turn) != pixels(c, turn));
        CHECK(pixels(a, turn) == pixels(a, turn + 8));
    }
    CHECK(pixels(a, 0) != pixels(a, 1));
}

TEST_CASE("pictures without pixels and no turns at all are refused")
{
    CHECK_THROWS_AS(FramelessTurns(0, 5, 2, 0), std::invalid_argument);
    CHECK_THROWS_AS(FramelessTurns(5, -1, 2, 0), std::invalid_argument);
    CHECK_THROWS_AS(FramelessTurns(5, 5, 0, 0), std::invalid_argument);
}

TEST_CASE_TEMPLATE("pixels traced turn by turn are those of the whole frame, others stay and grow older", Real, float,
                   double)
{
    const Scene scene = still_scene();
    const Pose at_start = pose(scene, scene.start);
    test::ReferenceStrategy<Real> strategy;
    strategy.update(at_start);
    const RenderOptions options{.width = 45, .height = 37, .depth = 2, .samples = 2, .costs = true};
    const Executor executor(2);
    Frame whole;
    const RayCounts counts = render<Real>(strategy, at_start, {}, options, executor, whole);
    CHECK(whole.age == std::vector<std::uint32_t>(whole.pixel_count(), 0));

    Frame frame = whole;
    const glm::vec3 unlike(-1.0f);
    std::fill(frame.colour.begin(), frame.colour.end(), unlike);
    std::fill(frame.distance.begin(), frame.distance.end(), 0.0f);
    std::fill(frame.primitive.begin(), frame.primitive.end(), 12345u);
    std::fill(frame.group.begin(), frame.group.end(), 12345u);
    std::fill(frame.tests.begin(), frame.tests.end(), 12345u);
    const FramelessTurns turns(45, 37, 7, 5);
    RayCounts sum;
    for (std::size_t turn = 0; turn < 7; ++turn) {
        CAPTURE(turn);
        sum += render_pixels<Real>(strategy, at_start, {}, options, executor, turns.pixels(turn), frame);
        const auto stale = std::count(frame.colour.begin(), frame.colour.end(), unlike);
        std::size_t still_to_come = 0;
        for (std::size_t later = turn + 1; later < 7; ++later) still_to_come += turns.pixels(later).size();
        CHECK(static_cast<std::size_t>(stale) == still_to_come);
        for (std::size_t former = 0; former < 7; ++former) {
            const glm::ivec2 pixel = turns.pixels(former)[0];
            const std::uint32_t age = frame.age[static_cast<std::size_t>(pixel.y * 45 + pixel.x)];
            CHECK(age == (former <= turn ? turn - former : turn + 1));
        }
    }
    CHECK(image_hash(frame) == image_hash(whole));
    CHECK(frame.distance == whole.distance);
    CHECK(frame.primitive == whole.primitive);
    CHECK(frame.group == whole.group);
    CHECK(frame.tests == whole.tests);
    CHECK(sum.total() == counts.total());
}

TEST_CASE("a former frame of other options and pixels outside the picture are refused")
{
    const Scene scene = still_scene();
    const Pose at_start = pose(scene, scene.start);
    test::ReferenceStrategy<float> strategy;
    strategy.update(at_start);
    const RenderOptions options{.width = 8, .height = 6};
    const auto trace = [&](Frame frame, RenderOptions other, glm::ivec2 pixel) {
        render_pixels<float>(strategy, at_start, {}, other, Executor(1), std::vector{pixel}, frame);
    };
    Frame frame;
    CHECK_THROWS_AS(trace(frame, options, {0, 0}), std::invalid_argument);
    render<float>(strategy, at_start, {}, options, Executor(1), frame);
    CHECK_NOTHROW(trace(frame, options, {7, 5}));
    CHECK_THROWS_AS(trace(frame, {.width = 6, .height = 8}, {0, 0}), std::invalid_argument);
    CHECK_THROWS_AS(trace(frame, {.width = 8, .height = 6, .costs = true}, {0, 0}), std::invalid_argument);
    for (const glm::ivec2 outside : {glm::ivec2(8, 0), glm::ivec2(0, 6), glm::ivec2(-1, 0), glm::ivec2(0, -1)})
        CHECK_THROWS_AS(trace(frame, options, outside), std::invalid_argument);
}
