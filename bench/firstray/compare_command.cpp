#include <fmt/format.h>

#include "bench/compare/compare.h"
#include "bench/compare/regression.h"
#include "bench/compare/table.h"
#include "bench/compare/trade.h"
#include "bench/firstray/frame_list.h"
#include "bench/firstray/interrupt.h"
#include "bench/firstray/jobs.h"
#include "bench/firstray/progress.h"
#include "bench/firstray/scene_input.h"
#include "bench/firstray/search.h"
#include "bench/firstray/words.h"
#include "engine/core/pending_file.h"
#include "engine/image/image.h"

namespace firstray::command {
namespace {

constexpr int default_frames = 8;
constexpr std::size_t list_is_quick = 1000;  // primitives: more of them keep `list` out unless it is asked for

std::vector<Contestant> contestants_of(const CompareJob& job, const Scene& scene)
{
    std::vector<Contestant> contestants;
    if (!job.strategies.empty()) {
        for (const std::string_view name : split(job.strategies, ',')) contestants.push_back(parse_contestant(name));
        return contestants;
    }
    for (const StrategyEntry& entry : strategies())
        if (entry.name != "list" || scene.primitive_count() <= list_is_quick)
            contestants.push_back({std::string(entry.name), &entry, {}});
    return contestants;
}

/// As many as usual, from the first on, evenly.
std::vector<int> spread_frames(int frames)
{
    std::vector<int> spread;
    const int count = std::min(frames, default_frames);
    for (int i = 0; i < count; ++i) spread.push_back(static_cast<int>(std::int64_t{i} * frames / count));
    return spread;
}

std::vector<int> shares_of(const std::string& list)
{
    std::vector<int> shares;
    if (list.empty()) return shares;
    for (const std::string_view share : split(list, ',')) shares.push_back(parse_share("--frameless", share));
    return shares;
}

compare::Plan plan_of(const CompareJob& job, const Scene& scene)
{
    compare::Plan plan;
    plan.contestants = contestants_of(job, scene);
    plan.frames =
        job.frames.empty() ? spread_frames(scene.frames) : frames_of(parse_frame_list(job.frames), scene.frames);
    const glm::ivec2 size = job.size.empty() ? glm::ivec2(scene.view.width, scene.view.height) : parse_size(job.size);
    plan.render = {.width = size.x, .height = size.y, .depth = job.depth, .samples = job.samples};
    plan.options = options_of(job.search);
    plan.threads = job.search.threads;
    plan.repeat = job.repeat;
    plan.check_rays = static_cast<std::size_t>(job.check_rays);
    if (!job.pictures.empty()) plan.pictured = frames_of(parse_frame_list(job.pictures), scene.frames);
    plan.frameless = shares_of(job.frameless);
    plan.seed = job.seed;
    plan.trade = job.trade;
    return plan;
}

/// Refuses what needs no scene to be refused.
void check_words(const CompareJob& job, bool terminal)
{
    for (const std::string_view name : split(job.strategies, ','))
        if (!job.strategies.empty()) parse_contestant(name);
    options_of(job.search);
    if (!job.size.empty()) parse_size(job.size);
    if (!job.frames.empty()) parse_frame_list(job.frames);
    if (!job.pictures.empty()) parse_frame_list(job.pictures);
    shares_of(job.frameless);
    progress_style(job.progress, terminal);
}

/// Refuses a folder that cannot be written before minutes are spent on what belongs there.
void check_writable(const std::filesystem::path& folder)
{
    const std::filesystem::path probe = folder / ".firstray";
    write_whole_file(probe, "");
    std::filesystem::remove(probe);
}

/// Tells what changed from one run to another, and ends in failure where something is worse.
void compare_results(const CompareJob& job, Streams streams)
{
    const Json changes = compare::compare_runs(compare::read_results(job.scene.file), compare::read_results(job.other));
    streams.out << (job.json ? changes.dump(2) + "\n" : compare::change_table(changes));
    if (const int count = changes["regressions"]; count > 0)
        throw Error(Fault::rendering, fmt::format("{} beyond the noise", count == 1 ? "a regression" : "regressions"));
}

}  // namespace

void compare_strategies(const CompareJob& job, Streams streams)
{
    if (!job.other.empty()) return compare_results(job, streams);
    check_words(job, streams.terminal);
    const Scene scene = read_scene(job.scene);
    const compare::Plan plan = plan_of(job, scene);
    const std::vector<Texture> textures = read_textures(scene, job.scene);
    const std::filesystem::path folder = job.report.empty() ? "out/" + scene.name + "-report" : job.report;
    check_writable(folder);
    const InterruptGuard guard;
    compare::Report report;
    {
        Progress progress(streams.err, progress_style(job.progress, streams.terminal), 0);
        const compare::Watch watch{[&](double work) { progress.expect(work); },
                                   [&](const std::string& what, double work) { progress.step(what, work); },
                                   [] { return InterruptGuard::is_interrupted(); }};
        report = compare::compare(scene, textures, plan, {job.command_line, job.scene.file}, watch);
    }
    compare::write_report(folder, report);
    const Json& results = report.results;
    streams.out << (job.json ? results.dump(2) + "\n" : compare::summary_table(results));
    if (!job.json && results.contains("trade")) streams.out << compare::trade_summary(results["trade"]);
    streams.err << fmt::format("firstray: report in {}\n", (folder / "index.html").string());
    if (results["interrupted"].get<bool>())
        throw Error(Fault::rendering, "interrupted; the report has what was finished");
}

}  // namespace firstray::command
