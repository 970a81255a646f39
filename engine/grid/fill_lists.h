#pragma once
#include <span>

#include "engine/core/executor.h"
#include "engine/grid/pack_lists.h"

namespace firstray::inline v0 {

/// fill_list with all lists of a structure, in their order.
/// executor  null: on this thread
void fill_lists(std::span<const ListToFill> to_fill, const GridEntries& entries, PackOrder order,
                const Executor* executor, GridStructure& structure);

}  // namespace firstray::inline v0
