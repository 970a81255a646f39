#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "bench/peers/embree_body.h"
#include "engine/core/ray_tile.h"

// What single rays and packets have in common: how a tile's rays are put to Embree.
namespace firstray::peers {

/// The mask under which Embree tests what a RayMask admits.
inline unsigned mask_bits(RayMask mask)
{
    if (mask == RayMask::all) return all_bits;
    return mask == RayMask::opaque ? opaque_bit : transmitting_bit;
}

/// Whether a place or a direction has neither a NaN nor an infinity: Embree's answer is undefined for them.
inline bool is_finite(const glm::vec3& v)
{
    const glm::vec3 zero = v - v;  // infinity - infinity is NaN
    return (zero.x + zero.y + zero.z) == 0.0f;
}

/// Whether a ray that starts at a finite place can meet anything.
inline bool is_searchable(const glm::vec3& direction, float t_min, float t_max)
{
    const bool goes = (direction.x != 0.0f) | (direction.y != 0.0f) | (direction.z != 0.0f);
    return is_finite(direction) & goes & (t_min < t_max) & (t_max > 0.0f);  // & not &&: a packet's lanes side by side
}

/// The closed interval of floats inside the open (t_min, t_max), t_max > 0; Embree wants it to begin at 0 or later.
/// A renderer that goes on behind a hit counts on it: a hit at t_min, found again, would be found for ever.
struct ClosedInterval {
    float begin, end;
};
inline ClosedInterval inside(float t_min, float t_max)
{
    const auto neighbour = [](float t, std::uint32_t step) {  // of a positive float, in order of size
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(t) + step);
    };
    return {t_min > 0.0f ? neighbour(t_min, 1u) : std::numeric_limits<float>::min(), neighbour(t_max, -1u)};
}

/// The context of every occluded query. Where there is `may_pass`, by the rays' ids, what transmits does not stop them
/// but is noted there.
struct ShadowContext : RTCIntersectContext {
    std::uint8_t* may_pass;
};

/// Notes that ray i of n meets what transmits; false where that stops it.
inline bool note_passing(const RTCIntersectContext* context, RTCRayN* rays, unsigned n, unsigned i)
{
    std::uint8_t* const may_pass = static_cast<const ShadowContext*>(context)->may_pass;
    if (may_pass) may_pass[RTCRayN_id(rays, n, i)] = 1;
    return may_pass != nullptr;
}

inline RTCIntersectContext context_with(RTCIntersectContextFlags flags)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

/// Whether a tile's occluded query is to note which rays pass what transmits.
inline bool notes_passing(const RayTile<float>& tile)
{
    return tile.may_pass && tile.mask == RayMask::opaque;
}

inline ShadowContext shadow_context(RayTile<float>& tile, RTCIntersectContextFlags flags)
{
    ShadowContext context{context_with(flags), notes_passing(tile) ? tile.may_pass : nullptr};
    if (context.may_pass) std::fill_n(context.may_pass, tile.count, std::uint8_t{0});
    return context;
}

/// The mask of a tile's occluded query.
inline unsigned shadow_mask_bits(const RayTile<float>& tile)
{
    return mask_bits(notes_passing(tile) ? RayMask::all : tile.mask);
}

}  // namespace firstray::peers
