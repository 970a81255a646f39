#include "bench/compare/pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/image/image.h"
#include "engine/render/camera_rays.h"
#include "engine/render/draw_structure.h"

namespace firstray::compare {
namespace {

constexpr int metered_renders = 3;
constexpr double drawing_work = 2.0 * metered_renders;  // rays go one by one

std::vector<int> frames_to_draw(const Contest& contest)
{
    if (!contest.plan().pictured.empty()) return contest.plan().pictured;
    const auto heaviest =
        std::max_element(contest.frames().begin(), contest.frames().end(),
                         [](const FrameFacts& a, const FrameFacts& b) { return a.rays.total() < b.rays.total(); });
    if (heaviest == contest.frames().end()) return {};
    return {heaviest->frame};
}

/// What a strategy gave, before the scale that all share is known.
struct Drawn {
    std::string name;
    Frame frame;
    std::string structure;
};

bool is_metered(const Frame& frame)
{
    return std::any_of(frame.nanoseconds.begin(), frame.nanoseconds.end(), [](float ns) { return ns > 0.0f; });
}

/// Renders several times, each time coming from another frame, and keeps the least time of each pixel: what interrupts
/// a thread for a while would hide everything else.
void meter(Contender& contender, const RenderOptions& options, int frame, int frames, Frame& result)
{
    for (int i = 0; i < metered_renders; ++i) {
        if (frames > 1) contender.update(frame > 0 ? frame - 1 : 1);
        Frame again;
        contender.render(frame, options, i == 0 ? result : again);
        for (std::size_t p = 0; p < again.nanoseconds.size(); ++p)
            result.nanoseconds[p] = std::min(result.nanoseconds[p], again.nanoseconds[p]);
    }
}

Drawn draw(const std::string& name, Contender& contender, RenderOptions options, int frame, int frames)
{
    Drawn drawn{name, {}, {}};
    options.costs = true;
    meter(contender, options, frame, frames, drawn.frame);
    const std::vector<StructureBox> outline = contender.outline();
    if (outline.empty()) return drawn;
    const CameraRays camera = camera_rays(contender.current_pose(), options.width, options.height);
    drawn.structure = image::png_of(draw_structure(drawn.frame, camera, outline));
    return drawn;
}

std::string heat_png(const Frame& frame, const HeatScale& scale)
{
    if (!is_metered(frame)) return {};
    Frame heat;
    heat.width = frame.width;
    heat.height = frame.height;
    for (const float ns : frame.nanoseconds) heat.colour.push_back(heat_colour(scale.position(ns)));
    return image::png_of(heat);
}

FramePictures finish(int frame, const std::vector<Drawn>& all)
{
    std::vector<double> times;
    for (const Drawn& drawn : all)
        times.insert(times.end(), drawn.frame.nanoseconds.begin(), drawn.frame.nanoseconds.end());
    FramePictures pictures{frame, heat_scale(std::move(times)), {}};
    for (const Drawn& drawn : all)
        pictures.triptychs.push_back(
            {drawn.name, image::png_of(drawn.frame), drawn.structure, heat_png(drawn.frame, pictures.scale)});
    return pictures;
}

}  // namespace

double drawing_work_of(const Contest& contest)
{
    const std::size_t pictures = std::max<std::size_t>(contest.plan().pictured.size(), 1) * contest.rows().size();
    return static_cast<double>(pictures) * drawing_work;
}

std::vector<FramePictures> draw_pictures(Contest& contest)
{
    std::vector<FramePictures> pictures;
    const std::vector<int> frames = frames_to_draw(contest);
    for (const int frame : frames) {
        std::vector<Drawn> all;
        contest.for_each([&](const Row& row, Contender& contender) {
            contest.watch().step(fmt::format("drawing frame {}: {}", frame, row.contestant.name), drawing_work);
            all.push_back(draw(row.contestant.name, contender, contest.plan().render, frame, contest.scene().frames));
        });
        pictures.push_back(finish(frame, all));
    }
    return pictures;
}

}  // namespace firstray::compare
