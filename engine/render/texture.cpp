#include "engine/render/texture.h"

#include <cmath>

namespace firstray::inline v0 {
namespace {

/// The fraction of a coordinate, in [0, 1]: a tiny negative one rounds to 1, an infinite one has none and gives 0.
float fraction(float coordinate)
{
    const float f = coordinate - std::floor(coordinate);
    return f >= 0.0f ? f : 0.0f;
}

glm::vec3 rgb(const std::uint8_t* texel)
{
    return {texel[0], texel[1], texel[2]};
}

}  // namespace

glm::vec3 TexturePlace::colour() const
{
    if (!upper) return glm::vec3(1.0f);
    return glm::mix(glm::mix(rgb(upper + left), rgb(upper + right), right_share),
                    glm::mix(rgb(lower + left), rgb(lower + right), right_share), lower_share) *
           (1.0f / 255.0f);
}

TexturePlace Texture::at(glm::vec2 uv) const
{
    // In texels, whose centres are integers: [-1/2, size - 1/2].
    const float x = fraction(uv.x) * static_cast<float>(width) - 0.5f;
    const float y = fraction(uv.y) * static_cast<float>(height) - 0.5f;
    const int column = static_cast<int>(x + 1.0f) - 1, row = static_cast<int>(y + 1.0f) - 1;  // rounded down
    const std::size_t pitch = 3 * static_cast<std::size_t>(width);
    const TexturePlace place = {
        .upper = &pixels[pitch * static_cast<std::size_t>(row < 0 ? height - 1 : row)],
        .lower = &pixels[pitch * static_cast<std::size_t>(row + 1 < height ? row + 1 : 0)],
        .left = 3 * static_cast<std::size_t>(column < 0 ? width - 1 : column),
        .right = 3 * static_cast<std::size_t>(column + 1 < width ? column + 1 : 0),
        .right_share = x - static_cast<float>(column),
        .lower_share = y - static_cast<float>(row),
    };
    __builtin_prefetch(place.upper + place.left);
    __builtin_prefetch(place.lower + place.left);
    return place;
}

}  // namespace firstray::inline v0
