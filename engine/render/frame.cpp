#include "engine/render/frame.h"

#include <bit>

namespace firstray::inline v0 {
namespace {

// FNV-1a with its 64-bit constants, fed a 32-bit word a step: a byte a step would take as long as tracing some frames.
// Source: G. Fowler, L. C. Noll, K.-P. Vo, "The FNV Non-Cryptographic Hash Algorithm".
constexpr std::uint64_t fnv_offset_basis = 14695981039346656037u;
constexpr std::uint64_t fnv_prime = 1099511628211u;

std::uint64_t mixed(std::uint64_t hash, std::uint32_t word)
{
    return (hash ^ word) * fnv_prime;
}

}  // namespace

std::uint64_t image_hash(const Frame& frame)
{
    std::uint64_t hash = mixed(fnv_offset_basis, static_cast<std::uint32_t>(frame.width));
    hash = mixed(hash, static_cast<std::uint32_t>(frame.height));
    for (const glm::vec3& colour : frame.colour)
        for (int channel = 0; channel < 3; ++channel) hash = mixed(hash, std::bit_cast<std::uint32_t>(colour[channel]));
    return hash;
}

}  // namespace firstray::inline v0
