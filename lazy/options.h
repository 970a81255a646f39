#pragma once
#include <cstdint>

namespace firstray::lazy {

/// What the top grid lists of what moves.
enum class LazyTop : std::uint8_t {
    groups,     ///< boxes of groups: nothing of a group is touched before a ray enters its box
    primitives  ///< every primitive, as in the paper: all are carried at every update
};

/// What the user chooses about lazy building.
struct Options {
    LazyTop top = LazyTop::groups;
    std::uint64_t budget = 0;  ///< bytes that may be built while rays fly, and held; 0: no limit
};

}  // namespace firstray::lazy
