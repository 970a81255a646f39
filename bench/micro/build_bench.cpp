// How long does each strategy take to build? Made scenes of growing size, built for the first time (`first`) and, when
// every triangle of them deforms, for one frame after the other (`update`); `first_rays` are those that a lazy
// structure builds for, `rays` find all built. Rays check every strategy before it is timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <iostream>
#include <tuple>

#include "bench/micro/flags.h"
#include "bench/micro/made_scenes.h"
#include "engine/core/errors.h"
#include "engine/render/camera_rays.h"
#include "engine/scene/pose.h"
#include "obb/smallest_obb.h"

namespace firstray {
namespace {

constexpr const char* usage =
    "build_bench [--sizes=1000,10000,...] [--strategies=a,b] [--threads=1] [--isa=NAME] [Google Benchmark's flags]\n"
    "Sizes are in triangles, by default from a thousand to ten million, which takes minutes and gigabytes; scenes "
    "that\n"
    "deform have at most a million. Names read SCENE_SIZE/phase/strategy, e.g. terrain_10000/update/lazy; the scenes "
    "are\n"
    "terrain, a surface, and cloud, triangles that fill a cube.\n";

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
    if (settings.sizes.empty()) settings.sizes = {1'000, 10'000, 100'000, 1'000'000, 10'000'000};
    if (settings.contestants.empty())
        for (const char* name : {"grid", "obb", "lazy", "embree-low", "embree"})
            if (const StrategyEntry* entry = find_strategy(name)) settings.contestants.push_back({name, entry, {}});
    return settings;
}

/// Scenes are made when first asked for, and the last one is kept: benchmarks of one scene follow each other.
const Scene& scene_of(const MadeScene& kind, int size, bool deforms)
{
    static std::tuple<const MadeScene*, int, bool> made;
    static std::unique_ptr<Scene> scene;
    if (const std::tuple wanted(&kind, size, deforms); !scene || made != wanted) {
        scene.reset();
        scene = std::make_unique<Scene>(kind.make(static_cast<std::size_t>(size), deforms));
        made = wanted;
    }
    return *scene;
}

struct Subject {
    const MadeScene* kind;
    int size;
    bool deforms;
    Contestant contestant;
    const Executor* executor;

    const Scene& scene() const { return scene_of(*kind, size, deforms); }

    std::unique_ptr<Strategy<float>> make() const
    {
        StrategyOptions options{.executor = executor};
        options.own = contestant.own;
        return contestant.entry->make(scene(), options);
    }
    void check_first() const
    {
        const Pose now = pose(scene(), 0.5);
        const auto strategy = make(), truth = find_strategy("grid")->make(scene(), {});
        strategy->update(now);
        truth->update(now);
        const auto found = small_picture(now), right = small_picture(now);
        strategy->closest(*found);
        truth->closest(*right);
        check_hits(*found, *right, contestant.name);
    }
    void report(benchmark::State& state, const Strategy<float>& strategy) const
    {
        const auto triangles = static_cast<double>(scene().triangles.size());
        state.counters["Mtri_per_s"] =
            benchmark::Counter(triangles * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
        state.counters["bytes_per_tri"] = static_cast<double>(strategy.report().bytes) / triangles;
    }
};

void build_first(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const Pose now = pose(subject.scene(), 0.0);
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
        const Pose now = pose(subject.scene(), time = time > 0.9 ? 0.0 : time + 0.05);
        state.ResumeTiming();
        strategy->update(now);
    }
    subject.report(state, *strategy);
}

void first_rays(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const Pose now = pose(subject.scene(), 0.0);
    const auto rays = small_picture(now);
    std::unique_ptr<Strategy<float>> strategy;
    for (auto _ : state) {
        state.PauseTiming();
        strategy = subject.make();
        strategy->update(now);
        reset(*rays);
        state.ResumeTiming();
        strategy->closest(*rays);
    }
}

void rays_again(benchmark::State& state, const Subject& subject)
{
    subject.check_first();
    const Pose now = pose(subject.scene(), 0.0);
    const auto strategy = subject.make();
    strategy->update(now);
    const auto rays = small_picture(now);
    strategy->closest(*rays);
    for (auto _ : state) {
        reset(*rays);
        strategy->closest(*rays);
    }
}

/// Throws unless the box holds the points.
void check(const obb::Obb& box, std::span<const glm::dvec3> points)
{
    for (const glm::dvec3& point : points)
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(glm::dot(point - box.centre, box.axes[axis])) > box.half[axis] * (1.0 + 1e-12))
                throw Error(Fault::rendering, "smallest_obb leaves a point out");
}

void fit_box(benchmark::State& state, const MadeScene& kind, int size)
{
    const std::vector<glm::dvec3>& points = scene_of(kind, size, false).positions;
    check(obb::smallest_obb(points), points);
    for (auto _ : state) benchmark::DoNotOptimize(obb::smallest_obb(points));
}

template <typename Run>
void add(const std::string& name, Run run)
{
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void register_scene(const MadeScene& kind, int size, const Settings& settings, const Executor* executor)
{
    using State = benchmark::State;
    const std::string scene = std::string(kind.name) + "_" + std::to_string(size);
    for (const Contestant& contestant : settings.contestants) {
        const Subject subject{&kind, size, false, contestant, executor};
        add(scene + "/first/" + contestant.name, [=](State& state) { build_first(state, subject); });
        add(scene + "/first_rays/" + contestant.name, [=](State& state) { first_rays(state, subject); });
        add(scene + "/rays/" + contestant.name, [=](State& state) { rays_again(state, subject); });
    }
    add(scene + "/smallest_obb/obb", [&kind, size](State& state) { fit_box(state, kind, size); });
    if (size > most_deforming) return;
    for (const Contestant& contestant : settings.contestants)
        add(scene + "/update/" + contestant.name,
            [=, subject = Subject{&kind, size, true, contestant, executor}](State& state) { update(state, subject); });
}

void register_all(const Settings& settings, const Executor* executor)
{
    for (const MadeScene& kind : made_scenes())
        for (const int size : settings.sizes) register_scene(kind, size, settings, executor);
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
