#pragma once
#include <vector>

#include "engine/core/aabb.h"
#include "engine/core/executor.h"
#include "engine/grid/entries.h"

namespace firstray::inline v0 {

/// What there is to know before the first cell.
struct Beginning {
    Aabb bounds;
    /// Triangles that are kept out of the cells, ascending, at most a pack of them: they would be listed in very many,
    /// and rays meet them often. All others are chosen.
    std::vector<std::uint32_t> large;
};

/// Looks at all entries once.
/// executor  null: on this thread
Beginning survey(const GridEntries& entries, const Executor* executor);

}  // namespace firstray::inline v0
