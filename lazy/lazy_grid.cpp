#include "lazy/lazy_grid.h"

#include <algorithm>
#include <chrono>
#include <new>

namespace firstray::inline v0::lazy {
namespace {

/// What building a voxel may hold, guessed before it is built: packs, their boxes, and cells of a subgrid.
std::uint64_t guessed_bytes(std::size_t listed)
{
    return 2 * listed * (sizeof(TrianglePack) / pack_size) + 2 * sizeof(TrianglePack);
}

}  // namespace

LazyGrid::LazyGrid(GridEntries entries, const GridOptions& options, Ledger& ledger, const Executor* executor,
                   const VoxelChoice& choice)
    : options_(options),
      entries_(std::move(entries)),
      top_(build_top(entries_, options, executor)),
      voxels_(std::make_unique<MadeOnce<GridStructure>[]>(top_.structure.cells.size())),
      choice_(choice),
      ledger_(ledger)
{
    if (choice_.chooser)
        for (std::uint32_t cell = 0; cell < top_.structure.cells.size(); ++cell)
            filled_ += listed(cell).empty() ? 0.0 : 1.0;
    held_ = entries_.bytes() + top_.structure.bytes() + top_.lists.bytes() +
            top_.structure.cells.size() * sizeof(MadeOnce<GridStructure>);
}

LazyGrid::~LazyGrid()
{
    for (std::size_t cell = 0; cell < top_.structure.cells.size(); ++cell)
        if (const GridStructure* built = voxels_[cell].get()) ledger_.give_back(built->bytes() + sizeof *built);
}

bool LazyGrid::has_cells_of(const LazyGrid& other) const
{
    const GridStructure &mine = top_.structure, &others = other.top_.structure;
    const Grid &grid = mine.grids[0], &theirs = others.grids[0];
    return grid.lo == theirs.lo && grid.cell == theirs.cell && grid.dims == theirs.dims && mine.pad == others.pad &&
           mine.largest == others.largest;
}

const GridStructure* LazyGrid::enter_first(std::uint32_t cell, std::uint64_t rays) const
{
    const auto make = [&] { return voxels_[cell].get_or_make([&] { return build(cell); }); };
    if (!choice_.chooser) return make();
    const Alternatives alternatives = voxel_alternatives(choice_.chooser->rule().costs, listed(cell).size());
    const double expected = choice_.is_scenery ? choice_.chooser->expected_in_voxel(filled_) : 0.0;
    return choice_.chooser->enter(choice_.places.of(cell), rays, alternatives, expected, make);
}

std::unique_ptr<GridStructure> LazyGrid::build(std::uint32_t cell) const
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t guess = guessed_bytes(listed(cell).size());
    if (!ledger_.charge(guess)) return nullptr;
    std::unique_ptr<GridStructure> built;
    try {
        built = std::make_unique<GridStructure>(build_voxel(top_, cell, entries_, options_));
    } catch (const std::bad_alloc&) {
        ledger_.note_refused();
        ledger_.give_back(guess);  // the list is searched instead: slower, never a hole
        return nullptr;
    }
    ledger_.correct(guess, built->bytes() + sizeof *built);
    ledger_.note_built(static_cast<std::uint64_t>((Clock::now() - start).count()));
    return built;
}

VoxelCounts LazyGrid::counts() const
{
    VoxelCounts counts;
    for (std::uint32_t cell = 0; cell < top_.structure.cells.size(); ++cell) {
        counts.filled += !listed(cell).empty();
        counts.built += voxels_[cell].get() != nullptr;
    }
    return counts;
}

/// Of voxels that share a place the first stands for all.
void LazyGrid::report_choices(ChoiceReport& report) const
{
    const auto cells = static_cast<std::uint32_t>(top_.structure.cells.size());
    for (std::uint32_t cell = 0; cell < std::min(cells, choice_.places.count); ++cell) {
        if (listed(cell).empty()) continue;
        const Alternatives alternatives = voxel_alternatives(choice_.chooser->rule().costs, listed(cell).size());
        choice_.chooser->report(choice_.places.of(cell), alternatives, built(cell) != nullptr, report);
    }
}

std::uint64_t LazyGrid::keep()
{
    kept_.resize(top_.structure.cells.size());
    std::uint64_t count = 0;
    for (std::size_t cell = 0; cell < kept_.size(); ++cell) {
        voxels_[cell].forget_refusal();
        kept_[cell] = voxels_[cell].get() != nullptr;
        count += kept_[cell];
    }
    return count;
}

void LazyGrid::append_outline(StructureBox heading, std::vector<StructureBox>& out) const
{
    const Grid& grid = top_.structure.grids[0];
    const glm::dvec3 size = glm::dvec3(grid.hi()) - glm::dvec3(grid.lo);
    heading.root_from_box = {glm::dmat3(size.x, 0, 0, 0, size.y, 0, 0, 0, size.z), grid.lo};
    heading.dims = grid.dims;
    for (std::uint32_t cell = 0; cell < grid.cells(); ++cell) {
        if (listed(cell).empty()) continue;
        const bool was_built = cell < kept_.size() && kept_[cell];
        heading.filled_cells.push_back(cell);
        heading.states.push_back(was_built     ? StructureBox::Voxel::kept
                                 : built(cell) ? StructureBox::Voxel::built
                                               : StructureBox::Voxel::unbuilt);
        heading.references += listed(cell).size();
    }
    out.push_back(std::move(heading));
}

}  // namespace firstray::inline v0::lazy
