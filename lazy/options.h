#pragma once
#include <cstdint>

namespace firstray::lazy {

/// What becomes of what moves.
enum class LazyTop : std::uint8_t {
    groups,     ///< boxes of groups are listed: nothing of a group is touched before a ray enters its box
    primitives  ///< every primitive is listed, as in the paper: all are carried when something has moved
};

/// What the user chooses about lazy building.
struct Options {
    LazyTop top = LazyTop::groups;
};

}  // namespace firstray::lazy
