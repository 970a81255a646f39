#pragma once
#include <cstdint>

#include "engine/core/aabb.h"
#include "engine/core/ray_tile.h"
#include "engine/primitive/triangle.h"

namespace firstray::inline v0 {

inline constexpr int pack_size = 16;

/// Marks, in a pack's id, a primitive that transmits light; ids are below it.
inline constexpr std::uint32_t transmitting_bit = 0x80000000u;

/// Sixteen triangles, structure of arrays, for one ray to be tested against all of them. Unused lanes hold NaN
/// vertices, which no comparison accepts, and the id no_primitive.
struct alignas(64) TrianglePack {
    float v[3][3][pack_size];  ///< corner, axis, lane
    float edge[pack_size];     ///< longest_edge
    std::uint32_t id[pack_size];

    RootTriangle<float> triangle(int lane) const
    {
        RootTriangle<float> t;
        for (int corner = 0; corner < 3; ++corner)
            t.v[corner] = {v[corner][0][lane], v[corner][1][lane], v[corner][2][lane]};
        t.edge = edge[lane];
        return t;
    }
    Aabb box(int lane) const
    {
        Aabb around;
        for (int corner = 0; corner < 3; ++corner)
            around.grow({v[corner][0][lane], v[corner][1][lane], v[corner][2][lane]});
        return around;
    }
    void set_corners(int lane, const glm::vec3 (&corners)[3])
    {
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) v[corner][axis][lane] = corners[corner][axis];
    }
    void set(int lane, const RootTriangle<float>& t, std::uint32_t id_and_bit)
    {
        set_corners(lane, t.v);
        edge[lane] = t.edge;
        id[lane] = id_and_bit;
    }
    void clear(int lane)
    {
        const glm::vec3 nowhere(std::numeric_limits<float>::quiet_NaN());
        set(lane, {{nowhere, nowhere, nowhere}, nowhere.x}, no_primitive);
    }
};

/// Boxes of up to sixteen packs, widened by the structure's pad; unused ones are empty.
struct alignas(64) PackBoxes {
    float side[2][3][pack_size];  ///< low and high, axis, lane

    void set(std::size_t lane, const Aabb& box)
    {
        for (int axis = 0; axis < 3; ++axis) {
            side[0][axis][lane] = box.lo[axis];
            side[1][axis][lane] = box.hi[axis];
        }
    }
    Aabb box(std::size_t lane) const
    {
        return {{side[0][0][lane], side[0][1][lane], side[0][2][lane]},
                {side[1][0][lane], side[1][1][lane], side[1][2][lane]}};
    }
};

}  // namespace firstray::inline v0
