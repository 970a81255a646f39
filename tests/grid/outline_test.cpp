#include "engine/grid/outline.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "bench/strategies.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

std::uint32_t add_list(GridStructure& structure, const std::vector<std::uint32_t>& ids,
                       const std::vector<std::uint32_t>& quadrics = {})
{
    VoxelList list{.first_pack = static_cast<std::uint32_t>(structure.packs.size()),
                   .packs = 1,
                   .first_boxes = 0,
                   .first_quadric = static_cast<std::uint32_t>(structure.quadrics.size()),
                   .quadrics = static_cast<std::uint32_t>(quadrics.size())};
    TrianglePack pack;
    for (int lane = 0; lane < pack_size; ++lane) pack.clear(lane);
    for (std::size_t i = 0; i < ids.size(); ++i) pack.set(static_cast<int>(i), {}, ids[i]);
    structure.packs.resize(structure.packs.size() + 1);
    structure.packs.back() = pack;
    structure.quadrics.insert(structure.quadrics.end(), quadrics.begin(), quadrics.end());
    structure.lists.push_back(list);
    structure.references += ids.size() + quadrics.size();
    return static_cast<std::uint32_t>(structure.lists.size() - 1);
}

/// Appends a grid whose cells are to be filled.
void add_grid(GridStructure& structure, const glm::vec3& lo, const glm::vec3& cell, const glm::ivec3& dims)
{
    Grid grid;
    grid.lo = lo;
    grid.cell = cell;
    grid.dims = dims;
    grid.first_cell = static_cast<std::uint32_t>(structure.cells.size());
    structure.grids.push_back(grid);
    structure.cells.resize(structure.cells.size() + grid.cells());
}

/// Grid 0 holds grid 1 in its cell 1 and grid 3 in its last one; grid 1 holds grid 2 in its cell 0.
GridStructure three_levels()
{
    GridStructure structure;
    add_grid(structure, {0, 0, 0}, {4, 2, 1}, {2, 1, 3});
    add_grid(structure, {4, 0, 0}, {2, 2, 1}, {2, 1, 1});
    add_grid(structure, {4, 0, 0}, {1, 1, 1}, {1, 2, 1});
    add_grid(structure, {4, 0, 2}, {4, 2, 1}, {1, 1, 1});
    structure.cells[0] = CellWord::list(add_list(structure, {1, 2, 3}));
    structure.cells[1] = CellWord::subgrid(1);
    structure.cells[5] = CellWord::subgrid(3);
    structure.cells[6] = CellWord::subgrid(2);
    structure.cells[7] = CellWord::list(add_list(structure, {1, 5 | transmitting_bit, 7}, {101, 102}));
    structure.cells[8] = CellWord::list(add_list(structure, {5 | transmitting_bit, 6}));
    structure.cells[9] = CellWord::list(add_list(structure, {5 | transmitting_bit, 7}, {102}));
    structure.cells[10] = CellWord::list(add_list(structure, {7}));
    return structure;
}

/// Largest difference of two points' coordinates.
double apart(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

}  // namespace

TEST_CASE("an outline lists grids depth first, with what is in each counted once")
{
    std::vector<StructureBox> boxes(1);  // there already: somebody else's
    const GridStructure structure = three_levels();
    append_outline(structure, structure.cells, Transform{}, {.name = "arm", .level = 3, .primitives = 99}, boxes);
    REQUIRE(boxes.size() == 5);
    using Counts = std::array<std::uint64_t, 3>;  // level, primitives, references
    const Counts expected[] = {{3, 99, 14}, {4, 6, 10}, {5, 4, 5}, {4, 1, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(i);
        const StructureBox& box = boxes[i + 1];
        CHECK(Counts{static_cast<std::uint64_t>(box.level), box.primitives, box.references} == expected[i]);
        CHECK(box.kind == (i == 0 ? StructureBox::Kind::grid : StructureBox::Kind::subgrid));
    }
    CHECK(boxes[1].name == "arm");
    CHECK(boxes[1].filled_cells == std::vector<std::uint32_t>{0, 1, 5});
    CHECK(boxes[2].filled_cells == std::vector<std::uint32_t>{0, 1});
    CHECK(boxes[1].dims == glm::ivec3(2, 1, 3));
}

TEST_CASE("an outline stands where the structure's system is in the root")
{
    const Transform root_from_structure{rotation_about({0, 0, 1}, std::numbers::pi / 2), {10, 20, 30}};
    std::vector<StructureBox> boxes;
    const GridStructure structure = three_levels();
    append_outline(structure, structure.cells, root_from_structure, {}, boxes);
    REQUIRE(boxes.size() == 4);
    CHECK(apart(boxes[0].root_from_box.point({0, 0, 0}), {10, 20, 30}) < 1e-12);
    CHECK(apart(boxes[0].root_from_box.point({1, 0, 0}), {10, 28, 30}) < 1e-12);
    CHECK(apart(boxes[3].root_from_box.point({1, 1, 1}), {8, 28, 33}) < 1e-12);
    CHECK(apart(boxes[0].size(), {8, 2, 3}) < 1e-12);
}

TEST_CASE("nothing is appended where there is no grid")
{
    std::vector<StructureBox> boxes;
    append_outline(GridStructure{}, {}, Transform{}, {}, boxes);
    CHECK(boxes.empty());
}

TEST_CASE("the grid strategy's outline counts what its report counts, and subgrids lie in filled cells")
{
    const Scene scene = random_scene(31, 20000);
    const Pose now = pose(scene, 0.0);
    const auto grid = find_strategy("grid")->make(scene, {.grid_density = 0.002f, .max_list = 16});
    CHECK(grid->outline().empty());
    grid->update(now);
    const StructureReport report = grid->report();
    const std::vector<StructureBox> boxes = grid->outline();
    REQUIRE(boxes.size() == report.grids + report.subgrids);
    REQUIRE(report.depth == 3);
    CHECK(boxes[0].name == "grid");
    CHECK(boxes[0].primitives == report.primitives);
    CHECK(boxes[0].references == report.references);

    std::size_t filled = 0;
    std::vector<const StructureBox*> last(3);  // by level
    for (const StructureBox& box : boxes) {
        REQUIRE((box.level >= 0 && box.level < 3));
        last[static_cast<std::size_t>(box.level)] = &box;
        filled += box.filled_cells.size();
        if (box.level == 0) continue;
        const StructureBox& parent = *last[static_cast<std::size_t>(box.level) - 1];
        const glm::dvec3 lo = parent.root_from_box.point({0, 0, 0}), middle = box.root_from_box.point(glm::dvec3(0.5));
        const glm::ivec3 cell = glm::floor((middle - lo) / parent.size() * glm::dvec3(parent.dims));
        const auto index = static_cast<std::uint32_t>(cell.x + parent.dims.x * (cell.y + parent.dims.y * cell.z));
        CHECK(std::binary_search(parent.filled_cells.begin(), parent.filled_cells.end(), index));
        CHECK(box.primitives > 0);
        CHECK(box.references >= box.primitives);
    }
    CHECK(filled == report.filled_voxels);
}
