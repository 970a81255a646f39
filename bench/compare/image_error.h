#pragma once
#include <cstdint>

#include "engine/render/frame.h"

namespace firstray::compare {

/// How far pictures are from what they should be; colours are in [0, 1].
struct ImageError {
    std::uint64_t pixels = 0;
    std::uint64_t unlike = 0;     ///< not the same bits
    std::uint64_t differing = 0;  ///< by more than half a step of 8 bits in some channel: another byte, or nearly
    std::uint64_t perceived = 0;  ///< Yee's metric, see engine/image/perceptual.h
    double squares = 0.0;         ///< of the differences, summed over pixels and channels
    double largest = 0.0;         ///< difference in a channel

    /// Root of the mean square over pixels and channels.
    double rmse() const;
    /// Peak signal to noise, decibels; infinity where nothing differs.
    double psnr() const;
    double differing_share() const;
    /// Of several pictures together.
    ImageError& operator+=(const ImageError& other);
};

/// throws  std::invalid_argument for pictures of different sizes
ImageError image_error(const Frame& expected, const Frame& found);

}  // namespace firstray::compare
