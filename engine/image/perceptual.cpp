#include "engine/image/perceptual.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <stdexcept>
#include <vector>

namespace firstray::inline v0::image {
namespace {

OIIO::ImageBuf buffer_of(const Frame& frame)
{
    OIIO::ImageBuf buffer(OIIO::ImageSpec(frame.width, frame.height, 3, OIIO::TypeFloat));
    buffer.set_pixels(OIIO::ROI(), OIIO::TypeFloat, frame.colour.data());
    return buffer;
}

}  // namespace

std::uint64_t perceived_differences(const Frame& a, const Frame& b)
{
    if (a.width != b.width || a.height != b.height) throw std::invalid_argument("pictures of different sizes");
    if (a.pixel_count() == 0) return 0;
    OIIO::ImageBufAlgo::CompareResults results;
    constexpr float luminance = 100.0f, field_of_view = 45.0f;  // OpenImageIO's own
    const int failed = OIIO::ImageBufAlgo::compare_Yee(buffer_of(a), buffer_of(b), results, luminance, field_of_view);
    return static_cast<std::uint64_t>(failed);
}

}  // namespace firstray::inline v0::image
