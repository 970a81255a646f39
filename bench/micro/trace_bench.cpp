// How fast does each strategy update and trace, next to Embree, on one thread? Replays the primary and shadow rays of
// frames spread over BART's animations through every strategy, checks the answers first, and reports ratios within
// this one run. Every benchmark line shows the rounds of the scene's measurement: nothing is measured twice.
#include <benchmark/benchmark.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

#include "bench/micro/summary.h"
#include "engine/aff/reader.h"
#include "engine/core/errors.h"

namespace firstray {
namespace {

constexpr const char* usage =
    "trace_bench [--scene=FILE]... [--strategies=a,b] [--base=embree] [--reference=NAME] [--rounds=5] [--frames=10]\n"
    "            [--size=800x592] [--precision=robust|fast] [--shadow-mask=opaque|all]\n"
    "            [--grid-density=0.1] [--max-list=256] [--grid-depth=3] [Google Benchmark's own flags]\n"
    "A strategy may carry choices of its own: --strategies=grid,obb,obb+obb-top=list.\n"
    "Default scenes: BART's, found in the folder that FIRSTRAY_BART_DIR names. Default strategies: all but `list`.\n"
    "Shadow rays look at opaque primitives alone, as the renderer's do, or with --shadow-mask=all at all.\n"
    "The reference, whose answers the others must give, is by default the first strategy of our own.\n";

struct NamedScene {
    std::string name;
    std::filesystem::path file;
};

struct Settings {
    MeasurePlan plan;
    std::string base = "embree";
    std::vector<NamedScene> scenes;
};

[[noreturn]] void refuse(const std::string& message)
{
    throw Error(Fault::usage, message + "\n" + usage);
}

const StrategyEntry* entry_of(std::string_view name)
{
    const StrategyEntry* entry = find_strategy(name);
    if (!entry || !entry->make) refuse("no strategy of single precision is named " + std::string(name));
    return entry;
}

int whole_number(std::string_view flag, std::string_view text)
{
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1)
        refuse(std::string(flag) + " takes a whole number >= 1");
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> pieces;
    for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
        pieces.push_back(text.substr(0, end));
    pieces.push_back(text);
    return pieces;
}

Contestant contestant_of(std::string_view text)
{
    Contestant contestant = parse_contestant(text);
    entry_of(contestant.entry->name);
    return contestant;
}

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
        settings.base = entry_of(value)->name;
    else if (flag == "--reference")
        plan.reference = entry_of(value);
    else if (flag == "--rounds")
        plan.rounds = whole_number(flag, value);
    else if (flag == "--frames")
        plan.frames = whole_number(flag, value);
    else if (flag == "--size")
        apply_size(value, plan);
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

/// BART's scenes that are there; says on stderr which are not.
std::vector<NamedScene> bart_scenes()
{
    constexpr std::pair<const char*, const char*> scenes[] = {
        {"robots", "robots/Robot.aff"}, {"kitchen", "kitchen/kitchen.aff"}, {"museum", "museum/museum5.aff"}};
    const char* variable = std::getenv("FIRSTRAY_BART_DIR");
    const std::filesystem::path folder = variable && *variable ? variable : FIRSTRAY_BART_DIR;
    std::vector<NamedScene> found;
    for (const auto& [name, file] : scenes)
        if (std::filesystem::exists(folder / file))
            found.push_back({name, folder / file});
        else
            std::cerr << "trace_bench: skipped " << name << ": no file " << (folder / file).string() << "\n";
    return found;
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
    if (settings.scenes.empty()) settings.scenes = bart_scenes();
}

/// Takes our flags out of the command line and leaves Google Benchmark's.
Settings read_flags(int& argc, char** argv)
{
    Settings settings;
    int kept = 1;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--help") std::cout << usage << "\n";  // Google Benchmark adds its own and leaves
        const std::size_t equals = argument.find('=');
        const std::string_view value = equals == argument.npos ? "" : argument.substr(equals + 1);
        if (!apply(argument.substr(0, equals), value, settings)) argv[kept++] = argv[i];
    }
    argc = kept;
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
        if (measurement_) write_table(out, scene_.name, *measurement_, settings_.base);
    }

private:
    void show_counters(benchmark::State& state, const Measured& measured, const ReportedPart& part) const
    {
        if (const std::uint64_t rays = rays_of(*measurement_, part))
            state.counters["Mrays/s"] = 1e-6 * static_cast<double>(rays) / typical_seconds(measured, part);
        if (const Measured* base = timed(*measurement_, settings_.base)) {
            const Spread ratio = ratio_to(*base, measured, part);
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
    for (const ReportedPart& part : reported_parts())
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
    benchmark::AddCustomContext("threads", "1");
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
        return static_cast<int>(error.fault());
    }
}
