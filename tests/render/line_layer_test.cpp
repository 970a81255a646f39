#include "engine/render/line_layer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/small_scene.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// A black picture in which nothing is hit.
Frame empty_frame(int width, int height)
{
    Frame frame;
    frame.width = width;
    frame.height = height;
    frame.colour.assign(frame.pixel_count(), glm::vec3(0.0f));
    frame.distance.assign(frame.pixel_count(), std::numeric_limits<float>::infinity());
    return frame;
}

/// Looks from the origin along -z: (x, y, -1) is at the pixels' place (1 + x, 1 - y) * height / 2 of a square picture.
CameraRays camera_of(const Frame& frame)
{
    const Scene scene = SmallScene().build();
    return camera_rays(pose(scene, 0.0), frame.width, frame.height);
}

/// What white lines on black leave: the share of each pixel that they cover.
class Drawing {
public:
    explicit Drawing(const Frame& frame) : frame_(frame), camera_(camera_of(frame)), layer_(frame_, camera_) {}

    void line(const glm::dvec3& a, const glm::dvec3& b, const Pen& pen = {}) { layer_.draw(a, b, pen); }
    std::vector<float> covered() const
    {
        std::vector<glm::vec3> colour(frame_.pixel_count(), glm::vec3(0.0f));
        layer_.cover(colour);
        std::vector<float> shares;
        for (const glm::vec3& c : colour) shares.push_back(c.x);
        return shares;
    }
    float covered(int x, int y) const { return covered()[static_cast<std::size_t>(y * frame_.width + x)]; }

private:
    const Frame& frame_;
    CameraRays camera_;
    LineLayer layer_;
};

/// How far along the line from a to b the place nearest to p is.
double along(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b)
{
    return glm::dot(p - a, glm::normalize(b - a));
}

}  // namespace

TEST_CASE("lines cover the pixels near their projection and no others")
{
    const Frame frame = empty_frame(40, 40);
    Random random(41);
    int touched = 0;
    for (int round = 0; round < 100; ++round) {
        CAPTURE(round);
        const glm::dvec3 a = random.in_cube(2.0) - glm::dvec3(0, 0, 4), b = random.in_cube(2.0) - glm::dvec3(0, 0, 4);
        Drawing drawing(frame);
        drawing.line(a, b);
        const auto place = [](const glm::dvec3& p) { return glm::dvec2(1.0 - p.x / p.z, 1.0 + p.y / p.z) * 20.0; };
        const std::vector<float> covered = drawing.covered();
        for (int i = 0; i < 1600; ++i) {
            CAPTURE(i);
            const glm::dvec2 p(i % 40 + 0.5, i / 40 + 0.5);
            const double from_start = along(p, place(a), place(b)), from_end = along(p, place(b), place(a));
            const double length = glm::distance(place(a), place(b));
            const double off =
                glm::distance(p, glm::mix(place(a), place(b), std::clamp(from_start / length, 0.0, 1.0)));
            const float share = covered[static_cast<std::size_t>(i)];
            if (off < 1.0 && from_start > 1.0 && from_end > 1.0) CHECK(share == doctest::Approx(1.0 - off));
            if (off > 1.5) CHECK(share == 0.0f);
            touched += share > 0.0f;
        }
    }
    CHECK(touched > 1000);
}

TEST_CASE("a line is dim where a surface is nearer, and full on the surface itself")
{
    Frame frame = empty_frame(40, 40);
    for (std::size_t i = 0; i < frame.distance.size(); ++i)
        frame.distance[i] = i % 40 < 10 ? 3.0f : i % 40 < 20 ? 30.0f : std::numeric_limits<float>::infinity();
    Drawing behind(frame), before(frame), on(frame);
    behind.line({-10, -0.125, -5}, {10, -0.125, -5});  // through the centres of row 20, as the others
    before.line({-10, -0.05, -2}, {10, -0.05, -2});
    CHECK(behind.covered(5, 20) == doctest::Approx(hidden_share));
    CHECK(behind.covered(15, 20) == doctest::Approx(1.0));
    CHECK(behind.covered(25, 20) == doctest::Approx(1.0));
    CHECK(before.covered(5, 20) == doctest::Approx(1.0));
    const CameraRays camera = camera_of(frame);
    const glm::dvec3 a = 3.0 * direction(camera, {5.5, 20.5}), b = 3.0 * direction(camera, {5.6, 20.5});
    on.line(a, b);
    CHECK(on.covered(5, 20) == doctest::Approx(1.0));
}

TEST_CASE("many faint lines in one place are as faint as one")
{
    const Frame frame = empty_frame(40, 40);
    Drawing drawing(frame);
    for (int i = 0; i < 50; ++i) drawing.line({-5, -0.25, -10}, {5, -0.25, -10}, {.strength = 0.125f});
    CHECK(drawing.covered(20, 20) == doctest::Approx(0.125));
}

TEST_CASE("lines fade where others like them are few pixels away")
{
    const Frame frame = empty_frame(40, 40);
    const auto covered = [&](double spacing) {
        Drawing drawing(frame);
        drawing.line({-5, -0.25, -10}, {5, -0.25, -10}, {.spacing = spacing});  // a pixel is 1/2 there
        return drawing.covered(20, 20);
    };
    CHECK(covered(0.49 * faded_spacing) == 0.0f);
    CHECK(covered(0.25 * (faded_spacing + full_spacing)) == doctest::Approx(0.5));
    CHECK(covered(0.5 * full_spacing) == doctest::Approx(1.0));
}

TEST_CASE("what is behind the camera, beyond the picture or not finite is not drawn")
{
    const Frame frame = empty_frame(40, 30);
    const double huge = 1e300, infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");
    Drawing drawing(frame);
    drawing.line({-1, 0, 5}, {1, 0, 5});
    drawing.line({-1, 0, 0}, {1, 0, 0});
    drawing.line({0, 0, 0}, {0, 0, 0});
    drawing.line({-1, 3, -2}, {1, 3, -2});
    drawing.line({-1, -3, -2}, {1, -3, -2});
    drawing.line({-3, 1, -2}, {-3, -1, -2});
    drawing.line({0, 2 * huge, -huge}, {huge, 2 * huge, -huge});
    for (const double bad : {infinite, -infinite, nan})
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 end(0.0, 0.0, -2.0);
            end[axis] = bad;
            drawing.line({0, 0, -2}, end);
            drawing.line(end, end);
        }
    for (const float share : drawing.covered()) CHECK(share == 0.0f);
}

TEST_CASE("what runs through the camera is cut at the near plane, however long it is")
{
    const Frame frame = empty_frame(40, 30);
    for (const double length : {10.0, 1e3, 1e9, 1e18, 1e100}) {
        CAPTURE(length);
        Drawing drawing(frame);
        drawing.line({0.5, -0.25, length}, {0.5, -0.25, -length});  // vanishes in the middle
        drawing.line({-length, 0.0, -1.0}, {length, 0.0, -1.0});
        for (const float share : drawing.covered()) CHECK((share >= 0.0f && share <= 1.0f));
        if (length < 1e12) CHECK(drawing.covered(30, 15) == doctest::Approx(0.5));  // farther ends are rounded too much
    }
}
