#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/measure/contestant.h"
#include "bench/micro/frame_rays.h"
#include "engine/core/executor.h"

namespace firstray {

/// What a measurement of one scene consists of.
struct MeasurePlan {
    int frames = 10;  ///< spread evenly from the first on: 0, n/10, 2n/10 ...
    int rounds = 5;   ///< how often all strategies go through all frames
    int width = 800, height = 592;
    int threads = 1;                           ///< that update and trace, >= 1
    bool scattered = false;  ///< whether scattered rays are traced too
    RayMask shadow_mask = RayMask::opaque;     ///< as the renderer asks; taken as `all` where nothing transmits
    StrategyOptions options;                   ///< of every strategy; the executor is the measurement's own
    const StrategyEntry* reference = nullptr;  ///< answers are checked against its; its hits make the shadow rays
    std::vector<Contestant> contestants;
};

/// Seconds from beginning to end.
struct PhaseTimes {
    double update = 0.0, primary = 0.0, shadow = 0.0, scattered = 0.0;
};

/// Rays whose answers were compared with the reference's.
struct Agreement {
    std::uint64_t rays = 0;
    std::uint64_t differing = 0;  ///< only one of both hits, or their t differ by more than 1e-3 of it
    double per_million() const { return rays ? 1e6 * static_cast<double>(differing) / static_cast<double>(rays) : 0.0; }
};

/// What was learnt of one strategy.
struct Measured {
    std::string name;
    bool is_peer = false;  ///< StrategyEntry::peer
    std::string fault;     ///< why it was not timed; empty where it was
    Agreement agreement;
    StructureReport structure;                    ///< after the last frame's rays
    std::vector<std::vector<PhaseTimes>> rounds;  ///< [round][frame]
};

struct Measurement {
    std::vector<Measured> strategies;       ///< by MeasurePlan::contestants
    std::uint64_t primary = 0, shadow = 0, scattered = 0;  ///< rays of all frames
};

/// Checks every strategy's answers on all rays of all frames, then times update and rays. Batches of rays are handed to
/// the threads as these become free; a phase takes as long as the thread that searched longest. Strategies take turns
/// frame by frame, so that a machine that speeds up or slows down does so for all; rounds follow the animation, so that
/// an update always comes from another frame. A strategy that differs in more than 0.1 % of the rays, or throws Error,
/// is not timed.
/// throws Error when the reference does
Measurement measure(const Scene& scene, const MeasurePlan& plan);

}  // namespace firstray
