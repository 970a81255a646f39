#include "engine/render/texture.h"

#include <cmath>

namespace firstray {
namespace {

/// The two texels beside a coordinate and the second one's weight.
struct Span {
    int first, second;
    float weight;
};

Span span_at(float coordinate, int size)
{
    float fraction = coordinate - std::floor(coordinate);
    if (!(fraction >= 0.0f)) fraction = 0.0f;                        // an infinite coordinate has no fraction
    const float texel = fraction * static_cast<float>(size) - 0.5f;  // [-1/2, size - 1/2]: texel centres are integers
    const float below = std::floor(texel);
    const int first = static_cast<int>(below);
    return {first < 0 ? size - 1 : first, first + 1 < size ? first + 1 : 0, texel - below};
}

}  // namespace

glm::vec3 Texture::sample(glm::vec2 uv) const
{
    const Span x = span_at(uv.x, width), y = span_at(uv.y, height);
    const auto texel = [&](int column, int row) {
        const std::uint8_t* rgb = &pixels[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                               static_cast<std::size_t>(column))];
        return glm::vec3(rgb[0], rgb[1], rgb[2]);
    };
    const glm::vec3 upper = glm::mix(texel(x.first, y.first), texel(x.second, y.first), x.weight);
    const glm::vec3 lower = glm::mix(texel(x.first, y.second), texel(x.second, y.second), x.weight);
    return glm::mix(upper, lower, y.weight) / 255.0f;
}

}  // namespace firstray
