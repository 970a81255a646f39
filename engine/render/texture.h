#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace firstray::inline v0 {

/// A place in a texture, between four texels.
struct TexturePlace {
    const std::uint8_t *upper = nullptr, *lower = nullptr;  ///< the rows; null where there is no texture
    std::size_t left = 0, right = 0;                        ///< the columns' offsets in them
    float right_share = 0.0f, lower_share = 0.0f;

    /// returns  RGB in [0, 1]; white where there is no texture
    glm::vec3 colour() const;
};

/// An RGB picture of bytes, rows from the top of the file.
struct Texture {
    int width = 0, height = 0;         ///< >= 1
    std::vector<std::uint8_t> pixels;  ///< 3 * width * height, interleaved

    /// Bilinear, repeating; texel centres at (i + 1/2) / width; v = 0 is the upper edge of the first row.
    /// Has the texels fetched: who asks for the colour some time later need not wait for memory.
    /// returns  valid while the texture's pixels are
    TexturePlace at(glm::vec2 uv) const;
};

}  // namespace firstray::inline v0
