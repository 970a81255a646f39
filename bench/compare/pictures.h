#pragma once
#include <string>
#include <vector>

#include "bench/compare/contest.h"
#include "bench/compare/heat.h"

namespace firstray::compare {

/// What one strategy made of a frame, as PNG files; empty where there is nothing to show.
struct Triptych {
    std::string name;
    std::string picture, structure, time;
};

/// A frame as in the paper's figures 5 to 7: picture, structure, time per pixel, for every strategy.
struct FramePictures {
    int frame = 0;
    HeatScale scale;  ///< of time per pixel, nanoseconds, the same for all strategies
    std::vector<Triptych> triptychs;
};

/// Renders Plan::pictured once more, metering every ray; where that names none, the frame of most rays.
std::vector<FramePictures> draw_pictures(Contest& contest);

/// What that comes to; see Watch.
double drawing_work_of(const Contest& contest);

}  // namespace firstray::compare
