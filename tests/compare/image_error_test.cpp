#include "bench/compare/image_error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "engine/image/perceptual.h"

using namespace firstray;
using namespace firstray::compare;

namespace {

Frame picture(int width, int height, const glm::vec3& colour)
{
    Frame frame;
    frame.width = width;
    frame.height = height;
    frame.colour.assign(frame.pixel_count(), colour);
    return frame;
}

}  // namespace

TEST_CASE("equal pictures have no error at all")
{
    const Frame a = picture(4, 3, {0.25f, 0.5f, 1.0f});
    const ImageError error = image_error(a, a);
    CHECK(error.pixels == 12);
    CHECK(error.unlike == 0);
    CHECK(error.differing == 0);
    CHECK(error.perceived == 0);
    CHECK(error.largest == 0.0);
    CHECK(error.rmse() == 0.0);
    CHECK(std::isinf(error.psnr()));
}

TEST_CASE("errors of four pixels are those computed by hand")
{
    const Frame expected = picture(2, 2, glm::vec3(0.5f));
    Frame found = expected;
    found.colour[1] = {0.5f, 0.75f, 0.5f};               // off by 1/4 in one channel
    found.colour[2] = {0.25f, 0.5f, 0.0f};               // by 1/4 and 1/2
    found.colour[3] = {0.5f, 0.5f + 1.0f / 1024, 0.5f};  // by less than half of 1/255
    const ImageError error = image_error(expected, found);
    CHECK(error.pixels == 4);
    CHECK(error.unlike == 3);
    CHECK(error.differing == 2);
    CHECK(error.differing_share() == 0.5);
    CHECK(error.largest == 0.5);
    const double squares = 1.0 / 16 + 1.0 / 16 + 1.0 / 4 + 1.0 / (1024.0 * 1024.0);
    CHECK(error.rmse() == doctest::Approx(std::sqrt(squares / 12.0)));
    CHECK(error.psnr() == doctest::Approx(10.0 * std::log10(12.0 / squares)));
}

TEST_CASE("a difference of a tenth everywhere is 20 decibels, one of all 0")
{
    CHECK(image_error(picture(5, 5, glm::vec3(0.0f)), picture(5, 5, glm::vec3(0.1f))).psnr() ==
          doctest::Approx(20.0).epsilon(1e-6));
    CHECK(image_error(picture(5, 5, glm::vec3(0.0f)), picture(5, 5, glm::vec3(1.0f))).psnr() == doctest::Approx(0.0));
}

TEST_CASE("errors of several pictures are taken together, not averaged")
{
    ImageError sum = image_error(picture(1, 1, glm::vec3(0.0f)), picture(1, 1, glm::vec3(0.3f)));
    sum += image_error(picture(1, 3, glm::vec3(0.0f)), picture(1, 3, glm::vec3(0.1f)));
    CHECK(sum.pixels == 4);
    CHECK(sum.differing == 4);
    CHECK(sum.largest == doctest::Approx(0.3));
    CHECK(sum.rmse() == doctest::Approx(std::sqrt((0.09 + 3 * 0.01) / 4.0)));
}

TEST_CASE("Yee's metric sees green for red in every pixel, and a change in the seventh digit in none")
{
    const Frame red = picture(64, 64, {0.5f, 0.2f, 0.2f}), green = picture(64, 64, {0.2f, 0.5f, 0.2f});
    CHECK(image::perceived_differences(red, red) == 0);
    CHECK(image::perceived_differences(red, green) == 64 * 64);
    CHECK(image_error(red, green).perceived == 64 * 64);
    CHECK(image_error(red, picture(64, 64, {0.5000001f, 0.2f, 0.2f})).perceived == 0);
}

TEST_CASE("pictures of different sizes are refused")
{
    CHECK_THROWS_AS(image_error(picture(2, 3, {}), picture(3, 2, {})), std::invalid_argument);
    CHECK_THROWS_AS(image::perceived_differences(picture(2, 3, {}), picture(3, 2, {})), std::invalid_argument);
}
