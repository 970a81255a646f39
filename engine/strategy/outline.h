#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/transform.h"

namespace firstray::inline v0 {

/// A grid or a box of a structure as it stands now, for people to look at: printed by `info`, drawn by `render`.
struct StructureBox {
    /// What it is.
    enum class Kind : std::uint8_t {
        grid,       ///< holds primitives, in the root system
        box,        ///< an oriented box that holds the primitives of a transform
        supergrid,  ///< holds boxes
        subgrid     ///< inside a voxel of the box before it that is one level up
    };
    /// What has become of a voxel that is built when a ray enters it.
    enum class Voxel : std::uint8_t {
        built,   ///< since the last update
        kept,    ///< built before
        unbuilt  ///< no ray has entered it
    };
    Kind kind = Kind::grid;                     ///< what it is
    std::string name{};                         ///< the transform's, or what the box is, e.g. "scenery"
    int level = 0;                              ///< 0: outermost; what is inside stands behind it, one level deeper
    Transform root_from_box{};                  ///< maps the unit cube [0, 1]^3 onto the box
    glm::ivec3 dims{0};                         ///< cells per axis of the grid that fills the box; 0: no grid, a list
    std::uint64_t primitives = 0;               ///< in it, each once
    std::uint64_t references = 0;               ///< listings of them in its voxels, subgrids included
    std::vector<std::uint32_t> filled_cells{};  ///< voxels that are not empty: x + dims.x * (y + dims.y * z), ascending
    std::vector<Voxel> states{};                ///< of filled_cells; empty where everything is built by the update

    /// Lengths of the box's edges, root units.
    glm::dvec3 size() const
    {
        return {glm::length(root_from_box.linear[0]), glm::length(root_from_box.linear[1]),
                glm::length(root_from_box.linear[2])};
    }
};

}  // namespace firstray::inline v0
