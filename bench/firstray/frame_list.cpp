#include "bench/firstray/frame_list.h"

#include <fmt/format.h>

#include <limits>
#include <set>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

constexpr int last_frame = std::numeric_limits<int>::max() / 2;  // so that a step beyond it still is an int

FrameRange parse_range(std::string_view text)
{
    const auto with_step = split(text, ':');
    const auto ends = split(with_step[0], '-');
    if (with_step.size() > 2 || ends.size() > 2 || (with_step.size() == 2 && ends.size() == 1))
        throw UsageError(fmt::format("--frames: '{}', expected N, N-M or N-M:STEP", text));
    FrameRange range;
    range.first = parse_int("--frames", ends.front(), 0, last_frame);
    range.last = parse_int("--frames", ends.back(), 0, last_frame);
    if (with_step.size() == 2) range.step = parse_int("--frames: step", with_step[1], 1, last_frame);
    if (range.last < range.first) throw UsageError(fmt::format("--frames: '{}' ends before it begins", text));
    return range;
}

}  // namespace

std::vector<FrameRange> parse_frame_list(std::string_view text)
{
    std::vector<FrameRange> ranges;
    for (const std::string_view part : split(text, ',')) ranges.push_back(parse_range(part));
    return ranges;
}

std::vector<int> frames_of(const std::vector<FrameRange>& ranges, int frames)
{
    std::set<int> listed;
    for (const FrameRange& range : ranges) {
        if (range.last >= frames)
            throw UsageError(
                fmt::format("frame {} is not in the scene, expected one from 0 to {}", range.last, frames - 1));
        for (int frame = range.first; frame <= range.last; frame += range.step) listed.insert(frame);
    }
    return {listed.begin(), listed.end()};
}

void check_frame(int frame, int frames)
{
    if (frame < 0 || frame >= frames)
        throw UsageError(fmt::format("--frame: {} is not in the scene, expected one from 0 to {}", frame, frames - 1));
}

}  // namespace firstray::command
