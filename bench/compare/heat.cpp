#include "bench/compare/heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measure/spread.h"

namespace firstray::compare {
namespace {

constexpr double least_share = 0.02, most_share = 0.995;  // of the pixels, beyond which colours no longer change

/// OKLab to linear RGB, Ottosson's constants.
glm::dvec3 linear_rgb(double lightness, double a, double b)
{
    const glm::dvec3 root(lightness + 0.3963377774 * a + 0.2158037573 * b,
                          lightness - 0.1055613458 * a - 0.0638541728 * b,
                          lightness - 0.0894841775 * a - 1.2914855480 * b);
    const glm::dvec3 lms = root * root * root;
    return {4.0767416621 * lms.x - 3.3077115913 * lms.y + 0.2309699292 * lms.z,
            -1.2684380046 * lms.x + 2.6097574011 * lms.y - 0.3413193965 * lms.z,
            -0.0041960863 * lms.x - 0.7034186147 * lms.y + 1.7076147010 * lms.z};
}

double srgb(double linear)
{
    const double value = std::clamp(linear, 0.0, 1.0);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

}  // namespace

glm::vec3 heat_colour(double value)
{
    const double t = std::clamp(value, 0.0, 1.0);
    const double lightness = 0.18 + 0.78 * t;
    const double hue = glm::radians(-70.0 + 175.0 * t);                   // violet, red, orange, yellow
    const double chroma = 0.04 + 0.56 * t * (1.0 - t) * (0.6 + 0.5 * t);  // ends pale, where the gamut is narrow
    const glm::dvec3 rgb = linear_rgb(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    return {srgb(rgb.r), srgb(rgb.g), srgb(rgb.b)};
}

double HeatScale::position(double value) const
{
    if (!(value > low)) return 0.0;
    return std::min(1.0, std::log(value / low) / std::log(high / low));
}

HeatScale heat_scale(std::vector<double> values)
{
    std::erase_if(values, [](double value) { return !(value > 0.0); });
    if (values.empty()) return {};
    const double low = quantile(values, least_share), high = quantile(values, most_share);
    return {low, std::max(high, 2.0 * low)};
}

std::string heat_gradient()
{
    constexpr int stops = 16;
    std::string css = "linear-gradient(to right";
    for (int i = 0; i <= stops; ++i) {
        const glm::vec3 colour = 255.0f * heat_colour(static_cast<double>(i) / stops) + 0.5f;
        css += fmt::format(",rgb({},{},{})", static_cast<int>(colour.r), static_cast<int>(colour.g),
                           static_cast<int>(colour.b));
    }
    return css + ")";
}

}  // namespace firstray::compare
