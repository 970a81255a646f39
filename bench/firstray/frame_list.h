#pragma once
#include <string_view>
#include <vector>

namespace firstray::command {

/// Frames first, first + step, ... up to last.
struct FrameRange {
    int first = 0, last = 0, step = 1;
    bool operator==(const FrameRange&) const = default;
};

/// Reads "0,5,10-20,100-200:10": numbers and ranges, a range perhaps with a step.
/// throws  UsageError
std::vector<FrameRange> parse_frame_list(std::string_view text);

/// The frames of a list, each once, in ascending order.
/// frames  how many the scene has
/// throws  UsageError for a frame outside [0, frames)
std::vector<int> frames_of(const std::vector<FrameRange>& ranges, int frames);

/// Refuses a value of --frame that the scene does not have.
/// frames  how many the scene has
/// throws  UsageError
void check_frame(int frame, int frames);

}  // namespace firstray::command
