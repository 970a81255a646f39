#pragma once
#include <cstdint>

#include "engine/core/ray_tile.h"
#include "engine/grid/beam.h"

namespace firstray::inline v0 {

/// The axes of a beam: k is the one along which all its rays go forward or all go back.
struct BeamAxes {
    int u, v, k;
    float forward;  ///< 1 or -1
};

/// Those of the direction's largest component.
BeamAxes axes_of(const glm::vec3& direction);

/// Rays whose speed along the beam's axis is outside this range, in lengths per t, are left to the search of single
/// rays, which rescales them.
inline constexpr float shortest_beam_ray = 0x1p-30f, longest_beam_ray = 0x1p30f;

/// Rays that walk together: lanes[first] to lanes[first + count - 1], sixteen to a packet. ~lane stands for no ray: it
/// fills up a packet where that lane's ray is.
struct BeamPart {
    int first, count;
    BeamAxes axes;
};

/// Where a part's rays lie in their beam.
struct BeamPlaces {
    static constexpr int capacity = RayTile<float>::capacity;
    /// By ray: its place on a Morton curve of 256 x 256 squares << 16 | its index in the part.
    alignas(64) std::uint32_t key[capacity];
    alignas(64) float u[capacity], v[capacity];  ///< slopes, by index in the part
    alignas(64) float depth[capacity];           ///< where the ray ends or leaves the grid, in cells, by index
    float wide_u, wide_v;                        ///< extents of the slopes
    float most_columns;                          ///< of cells that a packet may end in
};

/// How many columns of cells rays end in that are so far apart in slope, at a depth in cells.
inline float columns_at(float depth, float wide_u, float wide_v)
{
    return (wide_u * depth + 1.0f) * (wide_v * depth + 1.0f);
}

/// Which rays of a tile make a beam.
struct BeamOrder {
    static constexpr int capacity = RayTile<float>::capacity;
    static constexpr int most_packets = capacity / fewest_rays;
    static constexpr int most_parts = 6 + most_packets;
    std::int32_t lanes[capacity + most_packets * packet_size];  ///< the tile's, part after part; then those of clusters
    std::int32_t single[capacity];                              ///< lanes of rays that are to be traced one by one
    BeamPart parts[most_parts];
    int count = 0;  ///< parts
    int singles = 0;
    bool in_order = false;  ///< one part of all rays as they are: lanes are not filled in

    /// The lanes of a part; null where they are the tile's first.
    const std::int32_t* lanes_of(const BeamPart& part) const { return in_order ? nullptr : lanes + part.first; }

    /// All rays in one beam, in the tile's order.
    void take_all(int rays, const BeamAxes& axes);
    /// Rays along most rays' axis in one beam, the others by their own axes; what cannot be in a beam, one by one.
    void split(const RayTile<float>& tile);
    /// Of a part, only the rays of some packets.
    BeamPart only(const BeamPart& part, PacketMask packets);
    /// Sorts a part's rays by their places, which are sorted too, cuts it where they leave large gaps, and puts them
    /// into packets that are narrow where they end: the new parts, in place of those of the last call, are appended.
    void cluster(const BeamPart& part, BeamPlaces& places);

private:
    void add(const BeamPart& part);
    void pack(const BeamPlaces& sorted, const std::int32_t* sorted_lanes, int begin, int end, const BeamAxes& axes);
    int packed_ = 0;  ///< lanes of clusters
};

}  // namespace firstray::inline v0
