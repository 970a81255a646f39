#pragma once
#include <glm/glm.hpp>

#include <span>
#include <string>
#include <vector>

namespace firstray::compare {

/// Colours from dark to bright in which equal steps look equal, and which keep their order in grey and for the
/// colour-blind: lightness rises evenly in OKLab while the hue turns from violet over red to yellow.
/// value    in [0, 1]; others are taken to the nearer end
/// returns  sRGB, as a PNG holds it
/// source   B. Ottosson, "A perceptual color space for image processing", 2020
glm::vec3 heat_colour(double value);

/// A logarithmic scale between two positive values.
struct HeatScale {
    double low = 1.0, high = 10.0;
    double position(double value) const;  ///< in [0, 1]
};

/// From what nearly all values exceed to what nearly none does; at least a factor of two wide.
HeatScale heat_scale(std::vector<double> values);

/// The same colours as a CSS gradient from left to right.
std::string heat_gradient();

}  // namespace firstray::compare
