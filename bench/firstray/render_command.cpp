#include <fmt/format.h>

#include <set>

#include "bench/firstray/frame_list.h"
#include "bench/firstray/interrupt.h"
#include "bench/firstray/jobs.h"
#include "bench/firstray/output_pattern.h"
#include "bench/firstray/progress.h"
#include "bench/firstray/resume.h"
#include "bench/firstray/scene_input.h"
#include "bench/firstray/search.h"
#include "bench/firstray/stats.h"
#include "bench/firstray/words.h"
#include "bench/measure/frame_loop.h"
#include "engine/render/draw_structure.h"
#include "engine/render/frameless.h"

namespace firstray::command {
namespace {

/// A job with every word read and every default filled in.
struct Plan {
    std::vector<int> frames;
    RenderOptions options;
    int turns = 1;  ///< of frameless rendering
    std::vector<image::Aov> aovs;
    std::string output;
    Attributes recorded;  ///< in every frame's file
};

Plan plan_of(const RenderJob& job, const std::vector<FrameRange>& ranges, const Scene& scene)
{
    Plan plan;
    plan.frames = frames_of(ranges, scene.frames);
    plan.turns = parse_share("--frameless", job.frameless);
    plan.aovs = parse_aovs(job.aovs);
    const glm::ivec2 size = job.size.empty() ? glm::ivec2(scene.view.width, scene.view.height) : parse_size(job.size);
    plan.options = {
        .width = size.x, .height = size.y, .depth = job.depth, .samples = job.samples, .costs = any_cost(plan.aovs),
        .cancelled = &InterruptGuard::is_interrupted};
    plan.output = !job.output.empty() ? job.output : scene.name + (plan.aovs.empty() ? ".####.png" : ".####.exr");
    check_pattern(plan.output, plan.frames.size(), !plan.aovs.empty());
    return plan;
}

/// A table tells by itself how far it is.
ProgressStyle style_of(const RenderJob& job, bool terminal)
{
    const ProgressStyle style = progress_style(job.progress, terminal);
    return job.table && job.progress == "auto" ? ProgressStyle::never : style;
}

/// Refuses what needs no scene to be refused: a large scene takes its time to read.
std::vector<FrameRange> check_words(const RenderJob& job, bool terminal)
{
    check_search(job.search);
    if (!job.size.empty()) parse_size(job.size);
    const bool layers = !parse_aovs(job.aovs).empty();
    if (!job.output.empty()) check_pattern(job.output, 1, layers);
    progress_style(job.progress, terminal);
    limits_of(job.scene);
    if (parse_share("--frameless", job.frameless) != 1 && job.resume)
        throw UsageError("--resume cannot go on with --frameless: a frame holds pixels of those before it");
    return parse_frame_list(job.frames);
}

Json settings_of(const RenderJob& job, const Plan& plan, const Executor& executor)
{
    return {{"scene", job.scene.file},
            {"strategy", job.search.strategy},
            {"precision", job.search.precision},
            {"frames", job.frames},
            {"size", {plan.options.width, plan.options.height}},
            {"depth", plan.options.depth},
            {"spp", plan.options.samples},
            {"frameless", fmt::format("1/{}", plan.turns)},
            {"seed", job.seed},
            {"threads", executor.threads()},
            {"grid_density", job.search.grid_density},
            {"max_list", job.search.max_list},
            {"grid_depth", job.search.grid_depth},
            {"structure_budget", job.search.structure_budget},
            {"own", own_choices_of(job.search)},
            {"allow_outside", job.scene.allow_outside},
            {"aov", job.aovs},
            {"structure", job.structure},
            {"resume", job.resume},
            {"output", plan.output}};
}

/// All that the pictures may depend on. No JSON: its destructor allocates, and may then not fail.
std::string recorded_settings(const RenderJob& job, const Plan& plan)
{
    std::string text = fmt::format(
        "strategy={} precision={} size={}x{} depth={} spp={} frameless=1/{} seed={} grid-density={} max-list={} "
        "grid-depth={} aov={} structure={}",
        job.search.strategy, job.search.precision, plan.options.width, plan.options.height, plan.options.depth,
        plan.options.samples, plan.turns, job.seed, job.search.grid_density, job.search.max_list, job.search.grid_depth,
        job.aovs, job.structure);
    for (const auto& [flag, word] : job.search.own)
        if (!word.empty()) text += fmt::format(" {}={}", flag, word);
    return text;
}

/// Says once of every node that its transform is singular.
class SingularWarnings {
public:
    void add(const Pose& pose, int frame, Progress& progress)
    {
        for (const std::uint32_t node : pose.singular_nodes)
            if (warned_.insert(node).second)
                progress.message(
                    fmt::format("frame {}: the transform '{}' is singular, what it moves is hidden (said once)", frame,
                                pose.scene->nodes[node].name));
    }

private:
    std::set<std::uint32_t> warned_;
};

/// The outline is drawn over a copy: the picture itself is what was hashed.
void write_picture(const Plan& plan, const Pose& pose, int frame, const Frame& picture,
                   std::span<const StructureBox> outline)
{
    const auto write = [&](const Frame& shown) {
        image::write_frame(frame_file(plan.output, frame), shown, plan.aovs, frame_attributes(plan.recorded, frame));
    };
    if (outline.empty()) return write(picture);
    write(draw_structure(picture, camera_rays(pose, picture.width, picture.height), outline));
}

struct Totals {
    double update_ms = 0.0, trace_ms = 0.0;
};

template <typename Real>
Totals render_frames(const RenderJob& job, const Plan& plan, FrameLoop<Real>& loop, StatsFile& stats_file,
                     Streams streams)
{
    Totals totals;
    Progress progress(streams.err, style_of(job, streams.terminal), plan.frames.size());
    SingularWarnings warnings;
    Frame picture;
    const FramelessTurns turns(plan.options.width, plan.options.height, plan.turns, job.seed);
    std::size_t next_turn = 0;
    bool drawn = false;
    if (job.table) streams.out << table_heading();
    for (const int frame : plan.frames) {
        const bool is_whole = plan.turns == 1 || frame == plan.frames.front();
        const FrameStats stats = is_whole ? loop.render(frame, plan.options, picture)
                                          : loop.render_part(frame, plan.options, turns.pixels(next_turn++), picture);
        const Pose& pose = loop.current_pose();
        warnings.add(pose, frame, progress);
        const std::vector<StructureBox> outline = job.structure ? loop.outline() : std::vector<StructureBox>{};
        write_picture(plan, pose, frame, picture, outline);
        drawn = drawn || !outline.empty();
        stats_file.add(stats);
        if (job.table) streams.out << table_row(stats) << std::flush;
        progress.frame_done(frame);
        totals.update_ms += stats.update_ms;
        totals.trace_ms += stats.trace_ms;
    }
    if (job.structure && !drawn)
        progress.message(fmt::format("strategy {} has no structure to draw", job.search.strategy));
    return totals;
}

/// Runs the loop; whatever ends it early, the frames that were finished are in the statistics.
template <typename Real>
Totals render_all(const RenderJob& job, const Plan& plan, FrameLoop<Real> loop, StatsFile& stats_file, Streams streams)
{
    const InterruptGuard guard;
    try {
        const Totals totals = render_frames(job, plan, loop, stats_file, streams);
        stats_file.flush();
        return totals;
    } catch (...) {
        try {
            stats_file.flush();
        } catch (...) {
            // the first failure is the one to report
        }
        if (InterruptGuard::is_interrupted())
            throw Error(Fault::rendering, "interrupted; finished frames are whole, --resume goes on behind them");
        throw;
    }
}

/// Leaves out the frames that are there.
void keep_finished(Plan& plan, Streams streams)
{
    Resumption left = resume(plan.frames, plan.output, plan.recorded);
    streams.err << fmt::format("firstray: {} of {} frames are there{}\n", left.kept, plan.frames.size(),
                               left.of_another == 0 ? ""
                                                    : fmt::format("; {} of other scenes or settings, or not whole, "
                                                                  "are rendered anew",
                                                                  left.of_another));
    plan.frames = std::move(left.missing);
}

}  // namespace

void render_scene(const RenderJob& job, Streams streams)
{
    const std::vector<FrameRange> ranges = check_words(job, streams.terminal);
    const Scene scene = read_scene(job.scene);
    Plan plan = plan_of(job, ranges, scene);
    const std::vector<Texture> textures = read_textures(scene, job.scene);
    const Executor executor(job.search.threads);
    plan.recorded = run_attributes(scene, textures, recorded_settings(job, plan));
    if (job.resume) keep_finished(plan, streams);
    if (plan.frames.empty()) return;
    const AnyStrategy strategy = make_strategy(job.search, scene, executor);
    StatsFile stats_file(job.stats, job.stats.empty() ? Json() : settings_of(job, plan, executor));
    const Totals totals = std::visit(
        [&](const auto& chosen) {
            return render_all(job, plan, FrameLoop(scene, textures, *chosen, executor), stats_file, streams);
        },
        strategy);
    const double frames = static_cast<double>(plan.frames.size());
    streams.err << fmt::format("firstray: {} {}, mean update {:.1f} ms, mean trace {:.1f} ms; written to {}\n",
                               plan.frames.size(), plan.frames.size() == 1 ? "frame" : "frames",
                               totals.update_ms / frames, totals.trace_ms / frames, plan.output);
}

}  // namespace firstray::command
