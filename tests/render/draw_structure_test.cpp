#include "engine/render/draw_structure.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/small_scene.h"

using namespace firstray;

namespace {

Frame white_frame(int side)
{
    Frame frame;
    frame.width = frame.height = side;
    frame.colour.assign(frame.pixel_count(), glm::vec3(1.0f));
    frame.distance.assign(frame.pixel_count(), std::numeric_limits<float>::infinity());
    return frame;
}

/// Looks from the origin along -z, 90 degrees high.
Frame draw(const Frame& frame, const std::vector<StructureBox>& outline)
{
    const Scene scene = test::SmallScene().build();
    return draw_structure(frame, camera_rays(pose(scene, 0.0), frame.width, frame.height), outline);
}

StructureBox cube(const glm::dvec3& lo, double edge, const glm::ivec3& dims = glm::ivec3(0),
                  std::vector<std::uint32_t> filled = {})
{
    return {.root_from_box = {glm::dmat3(edge), lo}, .dims = dims, .filled_cells = std::move(filled)};
}

glm::vec3 pixel(const Frame& frame, int x, int y)
{
    return frame.colour[static_cast<std::size_t>(y * frame.width + x)];
}

/// How far a pixel is from what the picture is without lines.
float inked(const Frame& drawn, int x, int y)
{
    static const glm::vec3 ground = draw(white_frame(1), {}).colour[0];
    return glm::distance(pixel(drawn, x, y), ground);
}

}  // namespace

TEST_CASE("a box appears where the camera sees it, in its level's colour, and the rest of the picture is darker")
{
    // From depth 2 to 4: its front spans 50 to 150 of 200 pixels, its back 75 to 125.
    StructureBox box = cube({-1, -1, -4}, 2.0);
    box.level = 1;
    const Frame drawn = draw(white_frame(200), {box});
    for (const glm::ivec2 p :
         {glm::ivec2(50, 100), {49, 70}, {100, 149}, {149, 149}, {75, 100}, {100, 124}, {62, 62}}) {
        CAPTURE(p.x);
        CAPTURE(p.y);
        CHECK(glm::distance(pixel(drawn, p.x, p.y), level_colour(1)) < 0.2f);
    }
    int touched = 0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) touched += inked(drawn, x, y) > 0.0f;
    CHECK(touched > 800);  // 4 * 100 + 4 * 50 + 4 * 25 pixels of length, two to three wide
    CHECK(touched < 2200);
    CHECK(inked(drawn, 10, 10) == 0.0f);
    CHECK(inked(drawn, 100, 100) == 0.0f);
    CHECK(pixel(drawn, 10, 10).x < 0.6f);
    CHECK(pixel(drawn, 10, 10).x > 0.1f);
}

TEST_CASE("edges of filled cells are drawn, weaker than the box, and those of empty cells are not")
{
    // The front is at depth 2 and spans 40 to 360 of 400 pixels; there, cells (1, 1, 3) and (3, 1, 3) are from 120 to
    // 200 and from 280 to 360, in rows 200 to 280.
    const std::vector<std::uint32_t> filled = {4 * 4 * 3 + 4 + 1, 4 * 4 * 3 + 4 + 3};
    const Frame drawn = draw(white_frame(400), {cube({-1.6, -1.6, -5.2}, 3.2, {4, 4, 4}, filled)});
    const float box = inked(drawn, 40, 210), cell = inked(drawn, 120, 250);
    CHECK(box > 0.2f);
    CHECK(cell > 0.1f);
    CHECK(cell < 0.8f * box);
    for (const int x : {130, 190, 290, 350}) CHECK(inked(drawn, x, 280) > 0.1f);
    for (const int x : {90, 210, 240, 270}) CHECK(inked(drawn, x, 280) == 0.0f);
    CHECK(inked(drawn, 240, 250) == 0.0f);
    CHECK(inked(drawn, 120, 100) == 0.0f);
}

TEST_CASE("cells of a few pixels are not drawn")
{
    std::vector<std::uint32_t> all(64 * 64);
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    const Frame with = draw(white_frame(200), {cube({-1, -1, -4}, 2.0, {64, 64, 1}, all)});
    const Frame without = draw(white_frame(200), {cube({-1, -1, -4}, 2.0)});
    CHECK(with.colour == without.colour);
}

TEST_CASE("hidden edges are dimmer than visible ones")
{
    Frame frame = white_frame(200);
    const std::vector<StructureBox> outline = {cube({-1, -1, -4}, 2.0)};
    const Frame visible = draw(frame, outline);
    frame.distance.assign(frame.pixel_count(), 3.0f);  // between front and back
    const Frame half = draw(frame, outline);
    CHECK(inked(half, 50, 100) == inked(visible, 50, 100));
    CHECK(inked(half, 75, 100) > 0.0f);
    CHECK(inked(half, 75, 100) < 0.4f * inked(visible, 75, 100));
}

TEST_CASE("boxes behind the camera leave no line, those around it or without a finite place do no harm")
{
    const double nan = std::nan("");
    const std::vector<std::uint32_t> some = {0, 7, 13, 26};
    const Frame frame = white_frame(50);
    const Frame plain = draw(frame, {});
    CHECK(draw(frame, {cube({-1, -1, 2}, 2.0, {3, 3, 3}, some)}).colour == plain.colour);
    CHECK(draw(frame, {cube({nan, 0, -4}, 2.0, {3, 3, 3}, some)}).colour == plain.colour);
    CHECK(draw(frame, {cube({0, 0, -4}, nan, {3, 3, 3}, some)}).colour == plain.colour);
    for (const double edge : {0.0, 1e-30, 0.02, 2.0, 1e6, 1e18, 1e200}) {
        CAPTURE(edge);
        const Frame drawn = draw(frame, {cube(glm::dvec3(-edge / 2), edge, {3, 3, 3}, some)});
        for (const glm::vec3& c : drawn.colour)
            for (int channel = 0; channel < 3; ++channel) CHECK((c[channel] >= 0.0f && c[channel] <= 1.0f));
    }
}

TEST_CASE("drawing leaves the frame and its layers as they are")
{
    Frame frame = white_frame(50);
    frame.primitive.assign(frame.pixel_count(), 7);
    const std::uint64_t before = image_hash(frame);
    const Frame drawn = draw(frame, {cube({-1, -1, -4}, 2.0)});
    CHECK(image_hash(frame) == before);
    CHECK(image_hash(drawn) != before);
    CHECK(drawn.distance == frame.distance);
    CHECK(drawn.primitive == frame.primitive);
}

TEST_CASE("levels next to each other have different colours")
{
    for (int level = 0; level < 20; ++level) {
        CAPTURE(level);
        CHECK(glm::distance(level_colour(level), level_colour(level + 1)) > 0.2f);
    }
}
