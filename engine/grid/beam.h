#pragma once
#include <array>
#include <cstdint>

#include "engine/core/ray_tile.h"
#include "engine/primitive/triangle_pack.h"

namespace firstray::inline v0 {

/// A beam is up to 1,024 rays with a common apex, sixteen to a packet. Beams walk through grids as one; which rays need
/// what is found there is decided packet by packet, the packets side by side in lanes.
inline constexpr int packet_size = 16, max_packets = 64;

/// A set of a beam's packets.
using PacketMask = std::uint64_t;

/// The set of the first `count` packets.
inline PacketMask first_packets(int count)
{
    return count >= max_packets ? ~PacketMask{0} : (PacketMask{1} << count) - 1;
}

/// The rays of a beam, structure of arrays, and the best hit of each. Root system.
struct BeamRays {
    static constexpr int capacity = packet_size * max_packets;
    using Lane = std::array<float, capacity>;

    glm::vec3 apex{0.0f};
    int packets = 0;
    alignas(64) Lane direction[3];
    alignas(64) Lane length;          ///< largest component of the direction in magnitude
    alignas(64) Lane inverse_length;  ///< 1 / length
    alignas(64) Lane t_min;
    alignas(64) Lane t;  ///< where the ray ends: at its best hit, if it has one; minus infinity: nothing is looked for
    alignas(64) Lane u;
    alignas(64) Lane v;
    alignas(64) std::array<PrimitiveId, capacity> id;
    PacketMask may_pass = 0;  ///< packets with rays that may meet what the mask excludes; for Query::any

    glm::vec3 direction_of(std::size_t ray) const { return {direction[0][ray], direction[1][ray], direction[2][ray]}; }
};

/// A beam as grids see it, in the system of one structure. Axis k is the major one; depth is counted along it from the
/// apex. A ray's slopes are its u and v per depth; a packet's rays are somewhere in a rectangle of slopes.
struct Beam {
    int u = 0, v = 1, k = 2;
    float forward = 1.0f;          ///< 1 or -1: the direction along k
    float apex[3] = {};            ///< along u, v, k
    float farthest = 0.0f;         ///< largest coordinate of the apex
    float steepest = 1.0f;         ///< the largest slope in magnitude, at least 1
    PacketMask packets = 0;        ///< those that are here
    int count = 0;                 ///< packets are below it
    float lo[2] = {}, hi[2] = {};  ///< slopes of all
    alignas(64) float lo_u[max_packets], hi_u[max_packets], lo_v[max_packets], hi_v[max_packets];
    alignas(64) float reach[max_packets];  ///< depth beyond which a packet needs nothing; negative: it is done
    alignas(64) float scale[max_packets];  ///< depth here per depth in the root system, at most
};

/// Slopes are widened by this much of themselves, and of one: 32 half ulps, where making and transforming them errs by
/// 12 at most.
inline constexpr float slope_pad = 0x1p-19f;

/// Steeper rays of a tile make beams of their own.
inline constexpr float most_slope = 2.5f;

/// Fewer rays than this are quicker one by one.
inline constexpr int fewest_rays = 5;

/// A packet whose rays end in more columns of cells than this is no packet: others are made of its rays, and what is
/// left is quicker one by one. (Measured between 1.1 and 200 on whole pictures: at 8, what mirrors show takes a sixth
/// longer; at 1.1, everything does.)
inline constexpr float most_columns = 2.0f;

/// The same for rays that have no end yet, where the scene ends: most of them will end long before. (Of 1,024 rays over
/// ten million triangles each packet covers thousands of columns, and a beam takes a thousand times as long as its
/// rays.)
inline constexpr float most_columns_without_end = 64.0f;

/// The same in a box of its own, which rays mostly pass, wherever they end. (Robots at 80x59 take half the time that
/// they take as beams alone; between 8 and 128 the differences are noise, at 2.5 whole pictures take half as long
/// again.)
inline constexpr float most_columns_in_box = 64.0f;

/// Which of a beam's packets were tested against the triangles met of late: a triangle that stands in many cells is
/// tested once. Direct-mapped, so that it forgets: that costs a test, not a hit. One for each thread.
class Mailbox {
public:
    void begin_beam() { ++beam_; }

    /// Those packets of `asked` that have not been tested against a triangle; they count as tested from now on.
    PacketMask untested(PrimitiveId id, PacketMask asked)
    {
        Slot& slot = slots_[id % slots];
        const PacketMask tested = slot.id == id && slot.beam == beam_ ? slot.tested : 0;
        slot = {tested | asked, beam_, id};
        return asked & ~tested;
    }

    static Mailbox& of_this_thread();

private:
    static constexpr std::size_t slots = 1024;
    struct Slot {
        PacketMask tested = 0;
        std::uint64_t beam = 0;
        PrimitiveId id = no_primitive;
    };
    std::array<Slot, slots> slots_;
    std::uint64_t beam_ = 0;
};

/// The triangles that have last kept rays of a light from where they ran: the next beam tries them first. What is found
/// does not depend on it, only how soon. One for each thread.
class Occluders {
public:
    /// apex     of the rays to come
    /// version  RootGeometry::version(): triangles of another one are forgotten
    void begin_tile(const glm::vec3& apex, std::uint64_t version);
    /// id_and_bit  with transmitting_bit
    void remember(const RootTriangle<float>& triangle, std::uint32_t id_and_bit);
    /// The pack of those remembered; the other lanes are clear.
    const TrianglePack& pack() const { return lights_[light_].pack; }
    bool has_any() const { return lights_[light_].count > 0; }

    static Occluders& of_this_thread();

private:
    static constexpr std::size_t lights = 16;  // direct-mapped
    static constexpr int most = 4;
    struct Light {
        glm::vec3 apex{0.0f};
        std::uint64_t version = 0;
        int count = 0, next = 0;
        TrianglePack pack;
    };
    std::array<Light, lights> lights_;
    std::size_t light_ = 0;
};

/// Room for the rays of a beam. One for each thread.
BeamRays& beam_rays_of_this_thread();

}  // namespace firstray::inline v0
