#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/core/aligned.h"
#include "engine/core/search_ray.h"
#include "engine/core/transform.h"
#include "engine/grid/grid.h"

namespace firstray::inline v0 {

/// Maps an oriented box of the root system, widened, to the cube [-1, 1]^3.
struct CubeMap {
    glm::vec3 row[3];
    glm::vec3 offset;
};

/// Something that stands in cells, by number: an oriented box, or a supergrid of them.
struct Item {
    std::uint32_t number = 0;
    Aabb bounds;  ///< root system
    CubeMap cube_from_root;
};

/// Up to sixteen oriented boxes, structure of arrays, for one ray to be tested against all of them.
struct alignas(64) BoxPack {
    float row[3][3][pack_size];  ///< row, column, lane
    float offset[3][pack_size];
    std::uint32_t item[pack_size];

    void set(int lane, const Item& what);
    void clear(int lane);  ///< no ray meets it
};

/// What is in a voxel where boxes stand.
struct BoxedVoxel {
    CellWord own;  ///< the cell's word without the boxes
    std::uint32_t first_pack = 0, packs = 0;
};

/// A grid in the root system whose voxels hold boxes beside primitives. Boxes are put in and taken out in the time that
/// they take up; the rest is not touched.
struct BoxedGrid {
    GridStructure structure;  ///< word special(i) means voxels[i]
    std::vector<BoxedVoxel> voxels;
    RawVector<BoxPack> packs;
    std::vector<std::uint32_t> occupied;  ///< cells where boxes stand, ascending

    /// Whether an item is inside the top grid, and in few enough of its cells: others should be looked for by every
    /// ray.
    bool has_room_for(const Item& item) const;
    void remove_items();
    /// Puts items into all cells of the top grid that their bounds reach. Only while there are none in it.
    void insert(std::span<const Item> items);
    /// The structure's cells as they are without the items.
    std::vector<CellWord> cells_without_items() const;
    std::uint64_t bytes() const;
};

/// A grid around items alone; one cell where they fit into a pack or `as_list` asks for it.
BoxedGrid grid_of_items(std::span<const Item> items, bool as_list);

/// Takes out what stands in a grid and puts those of the items into it that it has room for; returns a grid of the rest.
/// around  null: there is no such grid
BoxedGrid place_items(BoxedGrid* around, std::span<const Item> items, bool as_list);

/// Error bounds of rays against oriented boxes scale with the largest coordinate: half ulps 128, where directions,
/// places and t err by at most 50 together.
inline constexpr float box_pad_factor = 0x1p-17f;

/// By how much boxes are widened, root lengths.
/// largest  coordinate of all that is there
inline double box_pad(double largest)
{
    return std::max(std::min(farthest_place, largest) * static_cast<double>(box_pad_factor), 1e-30);
}

/// An oriented box given in a system of its own. One that reaches out of range stands everywhere in range instead:
/// nothing is there beyond, and float cannot hold a box that reaches much farther.
/// local_from_root, root_from_local  inverses of each other
/// bounds  local
/// wide    see box_pad
Item make_item(std::uint32_t number, const Transform& local_from_root, const Transform& root_from_local,
               const DAabb& bounds, double wide);

}  // namespace firstray::inline v0
