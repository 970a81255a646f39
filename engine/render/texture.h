#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace firstray::inline v0 {

/// An RGB picture of bytes, rows from the top of the file.
struct Texture {
    int width = 0, height = 0;         ///< >= 1
    std::vector<std::uint8_t> pixels;  ///< 3 * width * height, interleaved

    /// Bilinear, repeating; texel centres at (i + 1/2) / width; v = 0 is the upper edge of the first row.
    /// returns  RGB in [0, 1]
    glm::vec3 sample(glm::vec2 uv) const;
};

}  // namespace firstray::inline v0
