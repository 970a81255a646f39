#include "bench/compare/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/image/perceptual.h"

namespace firstray::compare {
namespace {

constexpr double half_a_step = 0.5 / 255.0;

void add_pixel(const glm::vec3& expected, const glm::vec3& found, ImageError& error)
{
    const glm::dvec3 off = glm::abs(glm::dvec3(expected) - glm::dvec3(found));
    const double most = std::max({off.r, off.g, off.b});
    error.squares += glm::dot(off, off);
    error.largest = std::max(error.largest, most);
    error.unlike += expected != found;
    error.differing += most > half_a_step;
}

}  // namespace

double ImageError::rmse() const
{
    return pixels == 0 ? 0.0 : std::sqrt(squares / (3.0 * static_cast<double>(pixels)));
}

double ImageError::psnr() const
{
    return squares == 0.0 ? std::numeric_limits<double>::infinity() : -20.0 * std::log10(rmse());
}

double ImageError::differing_share() const
{
    return pixels == 0 ? 0.0 : static_cast<double>(differing) / static_cast<double>(pixels);
}

ImageError& ImageError::operator+=(const ImageError& other)
{
    pixels += other.pixels;
    unlike += other.unlike;
    differing += other.differing;
    perceived += other.perceived;
    squares += other.squares;
    largest = std::max(largest, other.largest);
    return *this;
}

ImageError image_error(const Frame& expected, const Frame& found)
{
    if (expected.width != found.width || expected.height != found.height)
        throw std::invalid_argument("pictures of different sizes");
    ImageError error{.pixels = expected.pixel_count()};
    for (std::size_t i = 0; i < expected.colour.size(); ++i) add_pixel(expected.colour[i], found.colour[i], error);
    if (error.unlike > 0) error.perceived = image::perceived_differences(expected, found);
    return error;
}

}  // namespace firstray::compare
