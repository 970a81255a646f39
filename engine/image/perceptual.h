#pragma once
#include <cstdint>

#include "engine/render/frame.h"

namespace firstray::inline v0::image {

/// Pixels in which a person would see a difference, by Hector Yee's metric as OpenImageIO has it (an office's light,
/// the picture 45 degrees wide). As version 2.4.7 computes it, it sees another hue but not another brightness: black
/// for white is no difference. So it belongs beside other measures.
/// a, b    of one size
/// throws  std::invalid_argument for pictures of different sizes
/// source  H. Yee, S. Pattanaik, D. Greenberg, "Spatiotemporal Sensitivity and Visual Attention for Efficient
///         Rendering of Dynamic Environments", ACM Transactions on Graphics 20(1), 2001
std::uint64_t perceived_differences(const Frame& a, const Frame& b);

}  // namespace firstray::inline v0::image
