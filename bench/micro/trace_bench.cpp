// How fast does each strategy update and trace, next to Embree? Replays the primary and shadow rays of frames spread
// over BART's animations through every strategy, checks the answers first, and reports ratios within this one run.
// Every benchmark line shows the rounds of the scene's measurement: nothing is measured twice.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <iostream>
#include <optional>

#include "bench/micro/flags.h"
#include "bench/micro/summary.h"
#include "engine/aff/reader.h"
#include "engine/core/errors.h"
#include "engine/core/simd.h"

namespace firstray {
namespace {

constexpr const char* usage =
    "trace_bench [--scene=FILE]... [--strategies=a,b] [--base=embree|best] [--reference=NAME] [--rounds=5]\n"
    "            [--frames=10] [--size=800x592] [--threads=1] [--isa=NAME] [--precision=robust|fast]\n"
    "            [--scattered] [--shadow-mask=opaque|all]\n"
    "            [--grid-density=0.1] [--max-list=256] [--grid-depth=3] [Google Benchmark's own flags]\n"
    "A strategy may carry choices of its own: --strategies=grid,obb,obb+obb-top=list,embree+embree-rays=single.\n"
    "The base is what ratios are to: a strategy, written as among --strategies; or best, which of Embree's ways is "
    "the\n"
    "one whose frames, update and trace, take least in this run on this scene.\n"
    "The instruction set, e.g. AVX3, AVX2 or SSE4, holds for all, Embree too; without it, the best there is.\n"
    "Default scenes: BART's, found in the folder that FIRSTRAY_BART_DIR names. Default strategies: all but `list`.\n"
    "Scattered rays start where primary rays hit, in random directions, and look for the closest hit.\n"
    "Shadow rays look at opaque primitives alone, as the renderer's do, or with --shadow-mask=all at all.\n"
    "The reference, whose answers the others must give, is by default the first strategy of our own.\n";

constexpr std::string_view best = "best";

struct Settings {
    MeasurePlan plan;
    std::string base = "embree";
    std::vector<NamedScene> scenes;
};

void apply_size(std::string_view value, MeasurePlan& plan)
{
    const auto sides = split(value, 'x');
    if (sides.size() != 2) refuse("--size takes WIDTHxHEIGHT");
    plan.width = whole_number("--size", sides[0]);
    plan.height = whole_number("--size", sides[1]);
}

/// One of two words: the value for the first, or for the second.
template <typename T>
T choice(std::string_view flag, std::string_view value, std::pair<std::string_view, T> a,
         std::pair<std::string_view, T> b)
{
    if (value == a.first) return a.second;
    if (value == b.first) return b.second;
    refuse(std::string(flag) + " takes " + std::string(a.first) + " or " + std::string(b.first));
}

/// returns  whether the flag is one of ours
bool apply(std::string_view flag, std::string_view value, Settings& settings)
{
    MeasurePlan& plan = settings.plan;
    if (flag == "--scene")
        settings.scenes.push_back({std::filesystem::path(value).stem().string(), value});
    else if (flag == "--base")
        settings.base = value == best ? value : contestant_of(value).name;
    else if (flag == "--reference")
        plan.reference = entry_of(value);
    else if (flag == "--rounds")
        plan.rounds = whole_number(flag, value);
    else if (flag == "--frames")
        plan.frames = whole_number(flag, value);
    else if (flag == "--size")
        apply_size(value, plan);
    else if (flag == "--threads")
        plan.threads = whole_number(flag, value);
    else if (flag == "--isa")
        hold_to(value);
    else if (flag == "--scattered")
        plan.scattered = true;
    else if (flag == "--precision")
        plan.options.precision =
            choice<Precision>(flag, value, {"robust", Precision::robust}, {"fast", Precision::fast});
    else if (flag == "--shadow-mask")
        plan.shadow_mask = choice<RayMask>(flag, value, {"all", RayMask::all}, {"opaque", RayMask::opaque});
    else if (flag == "--grid-density")
        plan.options.grid_density = std::stof(std::string(value));
    else if (flag == "--max-list")
        plan.options.max_list = whole_number(flag, value);
    else if (flag == "--grid-depth")
        plan.options.grid_depth = whole_number(flag, value);
    else if (flag == "--strategies")
        for (const std::string_view name : split(value, ',')) plan.contestants.push_back(contestant_of(name));
    else
        return false;
    return true;
}

void fill_defaults(Settings& settings)
{
    MeasurePlan& plan = settings.plan;
    const bool all = plan.contestants.empty();
    for (const StrategyEntry& entry : strategies()) {
        if (!entry.make || entry.name == "list") continue;  // testing every primitive takes hours on BART
        if (all) plan.contestants.push_back({std::string(entry.name), &entry, {}});
        if (!plan.reference && !entry.peer) plan.reference = &entry;
    }
    if (plan.contestants.empty()) refuse("no strategy to measure");
    if (!plan.reference) plan.reference = plan.contestants.front().entry;
    if (settings.scenes.empty()) settings.scenes = bart_scenes("trace_bench");
}

Settings read_flags(int& argc, char** argv)
{
    Settings settings;
    take_flags(argc, argv, usage,
               [&](std::string_view flag, std::string_view value) { return apply(flag, value, settings); });
    fill_defaults(settings);
    return settings;
}

/// A scene's measurement, made when the first benchmark asks for it (so that filtered scenes cost nothing).
class SceneRun {
public:
    /// settings  must outlive the run
    SceneRun(NamedScene scene, const Settings& settings) : scene_(std::move(scene)), settings_(settings) {}
    const std::string& name() const { return scene_.name; }

    const Measurement& measurement()
    {
        if (!measurement_) {
            std::cerr << "trace_bench: measuring " << scene_.file.string() << "\n";
            const Scene scene = read_aff(scene_.file);
            measurement_ = measure(scene, settings_.plan);
        }
        return *measurement_;
    }

    /// A benchmark line: an iteration is a round, its time that of all frames.
    void show(benchmark::State& state, std::size_t contender, const ReportedPart& part)
    {
        const Measured& measured = measurement().strategies[contender];
        if (!measured.fault.empty()) return state.SkipWithError(measured.fault.c_str());
        std::size_t round = 0;
        for ([[maybe_unused]] auto _ : state) state.SetIterationTime(round_seconds(measured, round++, part));
        show_counters(state, measured, part);
    }

    void write_table_if_measured(std::ostream& out) const
    {
        if (!measurement_) return;
        write_table(out, scene_.name, *measurement_, base());
        if (settings_.base == best && base()) out << "  the best that is not ours: " << base()->name << "\n";
    }

private:
    /// Whom the scene's ratios are to, or null. Asked for once it is measured.
    const Measured* base() const
    {
        return settings_.base == best ? best_peer(*measurement_) : timed(*measurement_, settings_.base);
    }

    void show_counters(benchmark::State& state, const Measured& measured, const ReportedPart& part) const
    {
        if (const std::uint64_t rays = rays_of(*measurement_, part))
            state.counters["Mrays/s"] = 1e-6 * static_cast<double>(rays) / typical_seconds(measured, part);
        if (const Measured* to = base()) {
            const Spread ratio = ratio_to(*to, measured, part);
            state.counters["ratio"] = ratio.median;
            state.counters["ratio_least"] = ratio.least;
            state.counters["ratio_most"] = ratio.most;
        }
        state.counters["differ_per_M"] = measured.agreement.per_million();
        state.counters["MB"] = 1e-6 * static_cast<double>(measured.structure.bytes);
    }

    NamedScene scene_;
    const Settings& settings_;
    std::optional<Measurement> measurement_;
};

void register_benchmarks(SceneRun& run, const MeasurePlan& plan)
{
    for (const ReportedPart& part : reported_parts(plan.scattered))
        for (std::size_t i = 0; i < plan.contestants.size(); ++i) {
            const std::string name = run.name() + "/" + std::string(part.name) + "/" + plan.contestants[i].name;
            benchmark::RegisterBenchmark(name.c_str(), [&run, &part, i](auto& state) { run.show(state, i, part); })
                ->UseManualTime()
                ->Iterations(plan.rounds)
                ->Unit(benchmark::kMillisecond);
        }
}

/// So that a report says by itself how its numbers came about.
void describe(const Settings& settings)
{
    const MeasurePlan& plan = settings.plan;
    benchmark::AddCustomContext("threads", std::to_string(plan.threads));
    benchmark::AddCustomContext("instruction_set", instruction_set());
    benchmark::AddCustomContext("frames", std::to_string(plan.frames));
    benchmark::AddCustomContext("rounds", std::to_string(plan.rounds));
    benchmark::AddCustomContext("picture", std::to_string(plan.width) + "x" + std::to_string(plan.height));
    benchmark::AddCustomContext("precision", plan.options.precision == Precision::fast ? "fast" : "robust");
    benchmark::AddCustomContext("shadow_mask", plan.shadow_mask == RayMask::all ? "all" : "opaque");
    benchmark::AddCustomContext("ratios_to", settings.base);
    benchmark::AddCustomContext("reference", std::string(plan.reference->name));
}

int run_all(int argc, char** argv)
{
    const Settings settings = read_flags(argc, argv);
    benchmark::Initialize(&argc, argv);
    if (settings.scenes.empty()) {
        std::cerr << "trace_bench: no scene to measure\n";
        return 0;
    }
    describe(settings);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) refuse("unknown flag");
    std::vector<std::unique_ptr<SceneRun>> runs;
    for (const NamedScene& scene : settings.scenes) {
        runs.push_back(std::make_unique<SceneRun>(scene, settings));
        register_benchmarks(*runs.back(), settings.plan);
    }
    benchmark::RunSpecifiedBenchmarks();
    for (const auto& run : runs) run->write_table_if_measured(std::cerr);
    return 0;
}

}  // namespace
}  // namespace firstray

int main(int argc, char** argv)
{
    try {
        return firstray::run_all(argc, argv);
    } catch (const firstray::Error& error) {
        std::cerr << "trace_bench: " << error.what() << "\n";
        if (error.fault() == firstray::Fault::usage) std::cerr << firstray::usage;
        return static_cast<int>(error.fault());
    }
}
