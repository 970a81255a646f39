#include "engine/grid/outline.h"

#include <algorithm>
#include <utility>

namespace firstray::inline v0 {
namespace {

/// Lists the grids of a structure, from the top down; each one's contents are counted on the way back up.
class OutlineMaker {
public:
    OutlineMaker(const GridStructure& structure, std::span<const CellWord> cells, const Transform& root_from_structure,
                 std::vector<StructureBox>& out)
        : structure_(structure), cells_(cells), root_from_structure_(root_from_structure), out_(out)
    {
    }

    void append_top(StructureBox box)
    {
        place(structure_.grids[0], box);
        append_subgrids(0, std::move(box));
        out_[first_].references = structure_.references;
    }

private:
    void place(const Grid& grid, StructureBox& box) const
    {
        const glm::dvec3 size = glm::dvec3(grid.cell) * glm::dvec3(grid.dims);
        box.root_from_box =
            root_from_structure_ * Transform{glm::dmat3(size.x, 0, 0, 0, size.y, 0, 0, 0, size.z), grid.lo};
        box.dims = grid.dims;
    }

    /// Appends the box of a grid and, behind it, those of the grids in its voxels.
    void append_subgrids(std::uint32_t index, StructureBox box)
    {
        const Grid& grid = structure_.grids[index];
        const std::size_t position = out_.size();
        const int level = box.level;
        out_.push_back(std::move(box));
        for (std::uint32_t cell = 0; cell < grid.cells(); ++cell) {
            const CellWord word = cells_[grid.first_cell + cell];
            if (word.is_empty()) continue;
            out_[position].filled_cells.push_back(cell);
            if (word.is_subgrid())
                append_subgrid(word.index(), level + 1);
            else if (position != first_)  // the top grid's contents are known
                list_primitives(structure_.lists[word.index()]);
        }
    }

    void append_subgrid(std::uint32_t index, int level)
    {
        const std::size_t position = out_.size(), first = listed_.size(), references = references_;
        StructureBox box{.kind = StructureBox::Kind::subgrid, .level = level};
        place(structure_.grids[index], box);
        append_subgrids(index, std::move(box));
        const auto begin = listed_.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, listed_.end());
        listed_.erase(std::unique(begin, listed_.end()), listed_.end());
        out_[position].primitives = listed_.size() - first;
        out_[position].references = references_ - references;
        if (level == out_[first_].level + 1) listed_.clear();
    }

    void list_primitives(const VoxelList& list)
    {
        const std::size_t before = listed_.size();
        for (std::uint32_t pack = list.first_pack; pack < list.first_pack + list.packs; ++pack)
            for (const std::uint32_t id : structure_.packs[pack].id)
                if (id != no_primitive) listed_.push_back(id & ~transmitting_bit);
        for (std::uint32_t i = list.first_quadric; i < list.first_quadric + list.quadrics; ++i)
            listed_.push_back(structure_.quadrics[i]);
        references_ += listed_.size() - before;
    }

    const GridStructure& structure_;
    std::span<const CellWord> cells_;
    const Transform& root_from_structure_;
    std::vector<StructureBox>& out_;
    std::size_t first_ = out_.size();  ///< of `out_`: the top grid
    std::vector<PrimitiveId> listed_;  ///< primitives met in the subgrids that are open; of those done, each once
    std::size_t references_ = 0;       ///< met in subgrids so far
};

}  // namespace

void append_outline(const GridStructure& structure, std::span<const CellWord> cells,
                    const Transform& root_from_structure, StructureBox heading, std::vector<StructureBox>& out)
{
    if (structure.grids.empty()) return;
    OutlineMaker(structure, cells, root_from_structure, out).append_top(std::move(heading));
}

}  // namespace firstray::inline v0
