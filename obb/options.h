#pragma once
#include <cstdint>

namespace firstray::inline v0::obb {

/// What gets a box of its own.
enum class Groups : std::uint8_t {
    dynamic,  ///< what lies directly under a dynamic transform (the paper's figure 6)
    all       ///< and what lies under each static transform below one (figure 5)
};

/// Where boxes stand.
enum class Top : std::uint8_t {
    grid,  ///< in the cells of the grid over the static scenery: a ray meets those near its path
    list   ///< in one list that every ray goes through, as in the paper
};

/// Where hits in boxes are decided.
enum class Hits : std::uint8_t {
    root,  ///< in the root system, as for every other strategy: the same bits
    local  ///< in the box's own system, as in the paper: rounds differently
};

/// What is in a box.
enum class Inside : std::uint8_t {
    automatic,  ///< a list for a handful of primitives, else a grid
    grid,
    list,  ///< of packs with boxes, without a grid
    lazy   ///< as automatic, but made when the first ray enters the box
};

/// What the user chooses about the hierarchy of boxes.
struct Options {
    Groups groups = Groups::dynamic;    ///< what gets a box
    Top top = Top::grid;                ///< where boxes stand
    Hits hits = Hits::root;             ///< where hits are decided
    Inside inside = Inside::automatic;  ///< what is in a box
};

}  // namespace firstray::inline v0::obb
