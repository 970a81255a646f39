#include "engine/render/frame.h"

#include <bit>

#include "engine/core/fnv.h"

namespace firstray::inline v0 {

std::uint64_t image_hash(const Frame& frame)
{
    std::uint64_t hash = fnv_mixed(fnv_offset_basis, static_cast<std::uint32_t>(frame.width));
    hash = fnv_mixed(hash, static_cast<std::uint32_t>(frame.height));
    for (const glm::vec3& colour : frame.colour)
        for (int channel = 0; channel < 3; ++channel)
            hash = fnv_mixed(hash, std::bit_cast<std::uint32_t>(colour[channel]));
    return hash;
}

}  // namespace firstray::inline v0
