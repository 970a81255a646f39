#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

#include "engine/core/ray_tile.h"

namespace firstray::inline v0 {

/// A rendered picture and what was learnt beside it; rows from the top, width * height entries per layer.
struct Frame {
    int width = 0, height = 0;      ///< pixels
    std::vector<glm::vec3> colour;  ///< linear as shaded, clamped to [0, 1]

    // Of the primary ray through the pixel's first sample.
    std::vector<float> distance;         ///< t along the normalised ray, world units; infinity where nothing is hit
    std::vector<PrimitiveId> primitive;  ///< no_primitive where nothing is hit
    std::vector<std::uint32_t> group;    ///< 4294967295 where nothing is hit

    std::vector<std::uint32_t> age;  ///< rendered frames since the pixel was traced; 0: it is of this one

    // Of all rays of the pixel; empty unless asked for.
    std::vector<std::uint32_t> cells, tests;  ///< as RayCost
    std::vector<float> nanoseconds;           ///< as RayCost

    std::size_t pixel_count() const
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }  ///< width * height
};

/// 64-bit hash (FNV-1a) of the picture's size and colour bits: equal exactly when the pictures are.
std::uint64_t image_hash(const Frame& frame);

}  // namespace firstray::inline v0
