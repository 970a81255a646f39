#pragma once
#include <span>
#include <vector>

#include "engine/grid/grid.h"
#include "engine/strategy/outline.h"

namespace firstray::inline v0 {

/// Appends a recursive grid, to be looked at: its top grid, then its subgrids, depth first. Nothing where there is no
/// grid.
/// root_from_structure  maps the structure's coordinates to the root
/// heading              what the top grid is: its kind, name, level and primitives are kept, the rest is filled in
/// cells                the structure's, none of them special
void append_outline(const GridStructure& structure, std::span<const CellWord> cells,
                    const Transform& root_from_structure, StructureBox heading, std::vector<StructureBox>& out);

}  // namespace firstray::inline v0
