// How long does each strategy take to build? A made terrain of growing size, built for the first time (`first`) and,
// when every triangle of it deforms, for one frame after the other (`update`). Rays check every strategy before it is
// timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <iostream>
#include <map>

#include "bench/micro/flags.h"
#include "bench/micro/terrain.h"
#include "engine/core/errors.h"
#include "engine/render/camera_rays.h"
#include "engine/scene/pose.h"
#include "obb/smallest_obb.h"

namespace firstray {
namespace {

constexpr const char* usage =
    "build_bench [--sizes=1000,10000,...] [--strategies=a,b] [--threads=1] [--isa=NAME] [Google Benchmark's flags]\n"
    "Sizes are in triangles; scenes that deform have at most a million. Names read terrain_SIZE/phase/strategy.\n";

/// Deforming triangles take 300 bytes each.
constexpr int most_deforming = 1'000'000;

struct Settings {
    std::vector<int> sizes;
    std::vector<Contestant> contestants;
    int threads = 1;
};

bool apply(std::string_view flag, std::string_view value, Settings& settings)
{
    if (flag == "--sizes")
        for (const std::string_view size : split(value, ',')) settings.sizes.push_back(whole_number(flag, size));
    else if (flag == "--strategies")
        for (const std::string_view name : split(value, ',')) settings.contestants.push_back(contestant_of(name));
    else if (flag == "--threads")
        settings.threads = whole_number(flag, value);
    else if (flag == "--isa")
        hold_to(value);
    else
        return false;
    return true;
}

Settings read_flags(int& argc, char** argv)
{
    Settings settings;
    take_flags(argc, argv, usage,
               [&](std::string_view flag, std::string_view value) { return apply(flag, value, settings); });
    if (settings.sizes.empty()) settings.sizes = {1'000, 10'000, 100'000, 1'000'000};
    if (settings.contestants.empty())
        for (const char* name : {"grid", "obb", "lazy", "embree-low", "embree"})
            if (const StrategyEntry* entry = find_strategy(name)) settings.contestants.push_back({name, entry, {}});
    return settings;
}

/// Scenes are made when first asked for, and the last one is kept: benchmarks of one scene follow each other.
const Scene& terrain(int size, bool deforms)
{
    static std::pair<int, bool> made;
    static std::unique_ptr<Scene> scene;
    if (!scene || made != std::pair(size, deforms)) {
        scene.reset();
        scene = std::make_unique<Scene>(make_terrain(static_cast<std::size_t>(size), deforms));
        made = {size, deforms};
    }
    return *scene;
}

std::unique_ptr<RayTile<float>> answers(const Strategy<float>& strategy, const Pose& now)
{
    constexpr int side = 16;
    auto tile = std::make_unique<RayTile<float>>();
    std::vector<glm::ivec2> pixels;
    for (int i = 0; i < side * side; ++i) pixels.emplace_back(i % side, i / side);
    aim(camera_rays(now, side, side), pixels, glm::dvec2(0.5), *tile);
    strategy.closest(*tile);
    return tile;
}

/// Throws unless a strategy's rays hit what the truth's hit, as far away, give or take the peers' rounding.
void check(const Strategy<float>& strategy, const Strategy<float>& truth, const Pose& now, const std::string& name)
{
    const auto mine = answers(strategy, now), right = answers(truth, now);
    for (int lane = 0; lane < mine->count; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        const bool same = mine->primitive[i] == right->primitive[i] ||
                          std::abs(mine->t_max[i] - right->t_max[i]) < 1e-4f * right->t_max[i];
        if (!same) throw Error(Fault::rendering, name + " gives wrong answers");
    }
}

struct Subject {
    int size;
    bool deforms;
    Contestant contestant;
    const Executor* executor;

    std::unique_ptr<Strategy<float>> make() const
    {
        StrategyOptions options{.executor = executor};
        options.own = contestant.own;
        return contestant.entry->make(terrain(size, deforms), options);
    }
    void check_first() const
    {
        const Pose now = pose(terrain(size, deforms), 0.5);
        const auto strategy = make(), truth = find_strategy("grid")->make(terrain(size, deforms), {});
        strategy->update(now);
        truth->update(now);
        check(*strategy, *truth, now, contestant.name);
    }
    void report(benchmark::State& state, const Strategy<float>& strategy) const
    {
        const auto triangles = static_cast<double>(terrain(size, deforms).triangles.size());
        state.counters["Mtri_per_s"] =
            benchmark::Counter(triangles * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
        state.counters["bytes_per_tri"] = static_cast<double>(strategy.report().bytes) / triangles;
    }
};

void build_first(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const Pose now = pose(terrain(subject.size, false), 0.0);
    std::unique_ptr<Strategy<float>> strategy;
    for (auto _ : state) {
        state.PauseTiming();
        strategy.reset();
        state.ResumeTiming();
        strategy = subject.make();
        strategy->update(now);
    }
    subject.report(state, *strategy);
}

void update(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const auto strategy = subject.make();
    double time = 0.0;
    for (auto _ : state) {
        state.PauseTiming();
        const Pose now = pose(terrain(subject.size, true), time = time > 0.9 ? 0.0 : time + 0.05);
        state.ResumeTiming();
        strategy->update(now);
    }
    subject.report(state, *strategy);
}

/// A picture of 256 rays in one beam.
void first_rays(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const Pose now = pose(terrain(subject.size, false), 0.0);
    std::unique_ptr<Strategy<float>> strategy;
    for (auto _ : state) {
        state.PauseTiming();
        strategy = subject.make();
        strategy->update(now);
        state.ResumeTiming();
        answers(*strategy, now);
    }
}

void rays_again(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const Pose now = pose(terrain(subject.size, false), 0.0);
    const auto strategy = subject.make();
    strategy->update(now);
    answers(*strategy, now);
    for (auto _ : state) answers(*strategy, now);
}

/// Throws unless the box holds the points.
void check(const obb::Obb& box, std::span<const glm::dvec3> points)
{
    for (const glm::dvec3& point : points)
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(glm::dot(point - box.centre, box.axes[axis])) > box.half[axis] * (1.0 + 1e-12))
                throw Error(Fault::rendering, "smallest_obb leaves a point out");
}

/// Points of a terrain: flat, with hills.
void fit_box(benchmark::State& state, int size)
{
    const std::vector<glm::dvec3>& points = terrain(size, false).positions;
    check(obb::smallest_obb(points), points);
    for (auto _ : state) benchmark::DoNotOptimize(obb::smallest_obb(points));
}

template <typename Run>
void add(const std::string& name, Run run)
{
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void register_all(const Settings& settings, const Executor* executor)
{
    using State = benchmark::State;
    for (const int size : settings.sizes) {
        const std::string scene = "terrain_" + std::to_string(size);
        for (const Contestant& contestant : settings.contestants) {
            const Subject subject{size, false, contestant, executor};
            add(scene + "/first/" + contestant.name, [=](State& state) { build_first(state, subject); });
            add(scene + "/first_rays/" + contestant.name, [=](State& state) { first_rays(state, subject); });
            add(scene + "/rays/" + contestant.name, [=](State& state) { rays_again(state, subject); });
        }
        add(scene + "/smallest_obb/obb", [=](State& state) { fit_box(state, size); });
        for (const Contestant& contestant : settings.contestants)
            if (size <= most_deforming)
                add(scene + "/update/" + contestant.name,
                    [=, subject = Subject{size, true, contestant, executor}](State& state) { update(state, subject); });
    }
}

}  // namespace
}  // namespace firstray

int main(int argc, char** argv)
{
    using namespace firstray;
    try {
        const Settings settings = read_flags(argc, argv);
        const Executor executor(settings.threads);
        benchmark::Initialize(&argc, argv);
        if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
        register_all(settings, settings.threads > 1 ? &executor : nullptr);
        benchmark::RunSpecifiedBenchmarks();
    } catch (const Error& error) {
        std::cerr << "build_bench: " << error.what() << "\n";
        if (error.fault() == Fault::usage) std::cerr << usage;
        return static_cast<int>(error.fault());
    }
}
