#pragma once
#include <cstdint>
#include <optional>

#include "lazy/rule.h"

namespace firstray::inline v0::lazy {

/// What becomes of what moves.
enum class LazyTop : std::uint8_t {
    groups,     ///< boxes of groups are listed: nothing of a group is touched before a ray enters its box
    primitives  ///< every primitive is listed, as in the paper: all are carried when something has moved
};

/// What the user chooses about lazy building.
struct Options {
    LazyTop top = LazyTop::groups;  ///< what is listed
    /// Chooses between lists and grids; only with LazyTop::groups. None: the first ray has built what it enters.
    std::optional<Rule> rule{};
};

}  // namespace firstray::inline v0::lazy
