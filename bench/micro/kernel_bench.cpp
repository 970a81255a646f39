// What do wide instructions bring? The kernels of building and of searching, held to each instruction set that this
// machine has in turn: bounds, ranges and packs are what building does to every triangle; a list is searched with
// nothing but the tests of candidates, a grid as pictures are. Each answer is checked against one that is found another
// way.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "bench/micro/flags.h"
#include "bench/micro/made_scenes.h"
#include "engine/core/errors.h"
#include "engine/core/simd.h"
#include "engine/grid/build.h"
#include "engine/grid/entry_kernels.h"
#include "engine/scene/pose.h"

namespace firstray {
namespace {

constexpr const char* usage =
    "kernel_bench [Google Benchmark's flags]\n"
    "Names read SCENE_SIZE/kernel/INSTRUCTION_SET, e.g. terrain_100000/ranges/AVX2; sizes are in triangles.\n";

constexpr std::size_t many = 100'000, listed = 256;

/// A made scene, carried, and what building starts from.
struct Subject {
    const Scene scene;
    const Pose now;
    RootGeometry<float> geometry;
    GridEntries entries;
    std::vector<std::uint32_t> all;  ///< entries

    Subject(const MadeScene& kind, std::size_t size)
        : scene(kind.make(size, false)), now(pose(scene, 0.0)), geometry(scene)
    {
        geometry.update(now, nullptr);
        entries = make_entries(geometry, geometry.visible(), nullptr);
        for (std::uint32_t entry = 0; entry < entries.count(); ++entry) all.push_back(entry);
    }
};

/// Made when first asked for: filtered benchmarks cost nothing.
const Subject& subject_of(const MadeScene& kind)
{
    static std::map<const MadeScene*, std::unique_ptr<Subject>> made;
    std::unique_ptr<Subject>& subject = made[&kind];
    if (!subject) subject = std::make_unique<Subject>(kind, many);
    return *subject;
}

/// Holds the process to an instruction set for a while.
class Held {
public:
    explicit Held(const std::string& set) { use_instruction_set(set); }
    ~Held() { use_instruction_set(""); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
};

void require(bool is_right, const char* what)
{
    if (!is_right) throw Error(Fault::rendering, std::string(what) + " gives wrong answers");
}

/// Seconds per thing, where an iteration does so many.
void tell_time_of_one(benchmark::State& state, const char* name, std::size_t things)
{
    state.counters[name] = benchmark::Counter(
        static_cast<double>(things), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void bounds(benchmark::State& state, const Subject& subject)
{
    Aabb right;
    for (const std::uint32_t entry : subject.all) right.grow(subject.entries.box(entry));
    const Aabb found = bounds_of(subject.entries, subject.all, nullptr);
    require(found.lo == right.lo && found.hi == right.hi, "bounds_of");
    for (auto _ : state) {
        LargestTriangles largest;
        benchmark::DoNotOptimize(bounds_of(subject.entries, subject.all, &largest));
    }
    tell_time_of_one(state, "per_triangle", subject.all.size());
}

/// About a cell per triangle.
Grid grid_over(const Subject& subject)
{
    const Aabb box = bounds_of(subject.entries, subject.all, nullptr);
    Grid grid;
    grid.lo = box.lo;
    grid.dims = glm::ivec3(static_cast<int>(std::cbrt(static_cast<double>(many))));
    grid.cell = (box.hi - box.lo) / glm::vec3(grid.dims);
    return grid;
}

/// Whether a triangle's cells begin and end where its box does, give or take what rounding makes of a place between
/// two.
bool is_range_right(const Grid& grid, const Aabb& box, const RangeBlock& ranges, std::size_t lane)
{
    constexpr float slack = 1e-3f;  // of a cell
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](float place) { return (place - grid.lo[axis]) / grid.cell[axis]; };
        const auto cell = [&](float place) { return std::clamp(static_cast<int>(place), 0, grid.dims[axis] - 1); };
        const int lo = ranges.lo[axis][lane], hi = ranges.hi[axis][lane];
        const float from = at(box.lo[axis]), to = at(box.hi[axis]);
        if (lo < cell(from - slack) || lo > cell(from + slack) || hi < cell(to - slack) || hi > cell(to + slack))
            return false;
    }
    return true;
}

void ranges(benchmark::State& state, const Subject& subject)
{
    const Grid grid = grid_over(subject);
    const CellFinder finder(grid, 0.0f);
    const std::span<const std::uint32_t> all(subject.all);
    RangeBlock block;
    const auto find_all = [&](const auto& visit) {
        for (std::size_t first = 0; first + pack_size <= all.size(); first += pack_size) {
            find_ranges(subject.entries, all.subspan(first, pack_size), finder, block);
            visit(first);
        }
    };
    find_all([&](std::size_t first) {
        for (std::size_t lane = 0; lane < pack_size; ++lane)
            require(is_range_right(grid, subject.entries.box(all[first + lane]), block, lane), "find_ranges");
    });
    for (auto _ : state) find_all([&](std::size_t) { benchmark::DoNotOptimize(block); });
    tell_time_of_one(state, "per_triangle", subject.all.size() / pack_size * pack_size);
}

void packs(benchmark::State& state, const Subject& subject)
{
    const std::span<const std::uint32_t> voxel = std::span(subject.all).first(listed);
    const Aabb box = bounds_of(subject.entries, voxel, nullptr);
    GridStructure structure;
    PackCounts counts;
    const VoxelList list = reserve_list(voxel, subject.entries, counts);
    structure.packs.resize(counts.packs);
    structure.boxes.resize(counts.boxes);
    PlacedTriangles triangles;
    place(subject.entries, voxel, triangles);
    fill_packs(list, subject.entries, triangles, box, PackOrder::along_curve, structure);
    std::multiset<PrimitiveId> found, right;
    for (const std::uint32_t entry : voxel) right.insert(subject.entries.ids[entry]);
    for (const TrianglePack& pack : structure.packs)
        for (const std::uint32_t id : pack.id)
            if (id != no_primitive) found.insert(id);
    require(found == right, "fill_packs");
    for (auto _ : state) {
        place(subject.entries, voxel, triangles);
        fill_packs(list, subject.entries, triangles, box, PackOrder::along_curve, structure);
        benchmark::ClobberMemory();
    }
    tell_time_of_one(state, "per_triangle", listed);
}

/// 256 rays, as a beam or one by one.
/// options  shape the grid: the strategy's own, or one cell
void search(benchmark::State& state, const MadeScene& kind, std::size_t size, StrategyOptions options, bool is_beam)
{
    const Scene scene = kind.make(size, false);
    const Pose now = pose(scene, 0.0);
    const auto strategy = find_strategy("grid")->make(scene, options), truth = find_strategy("list")->make(scene, {});
    strategy->update(now);
    truth->update(now);
    const auto rays = small_picture(now, is_beam), right = small_picture(now, is_beam);
    strategy->closest(*rays);
    truth->closest(*right);
    check_hits(*rays, *right, "closest");
    for (auto _ : state) {
        reset(*rays);
        strategy->closest(*rays);
    }
    tell_time_of_one(state, "per_ray", static_cast<std::size_t>(rays->count));
}

template <typename Run>
void add(const MadeScene& kind, std::size_t size, const char* kernel, const Run& run)
{
    for (const std::string& set : instruction_sets()) {
        const std::string name = std::string(kind.name) + "_" + std::to_string(size) + "/" + kernel + "/" + set;
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
            const Held held(set);
            run(state);
        })->Unit(benchmark::kMicrosecond);
    }
}

void register_scene(const MadeScene& kind)
{
    using State = benchmark::State;
    StrategyOptions one_cell;
    one_cell.grid_density = 1e-6f;
    one_cell.max_list = static_cast<int>(listed);
    add(kind, many, "bounds", [&kind](State& state) { bounds(state, subject_of(kind)); });
    add(kind, many, "ranges", [&kind](State& state) { ranges(state, subject_of(kind)); });
    add(kind, listed, "packs", [&kind](State& state) { packs(state, subject_of(kind)); });
    for (const bool is_beam : {true, false}) {
        const std::string rays = is_beam ? "beam" : "rays";
        add(kind, listed, (rays + "_list").c_str(),
            [=, &kind](State& state) { search(state, kind, listed, one_cell, is_beam); });
        add(kind, many, (rays + "_grid").c_str(), [=, &kind](State& state) { search(state, kind, many, {}, is_beam); });
    }
}

}  // namespace
}  // namespace firstray

int main(int argc, char** argv)
{
    using namespace firstray;
    try {
        take_flags(argc, argv, usage, [](std::string_view, std::string_view) { return false; });
        benchmark::Initialize(&argc, argv);
        if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
        for (const MadeScene& kind : made_scenes()) register_scene(kind);
        benchmark::RunSpecifiedBenchmarks();
    } catch (const Error& error) {
        std::cerr << "kernel_bench: " << error.what() << "\n";
        return static_cast<int>(error.fault());
    }
}
