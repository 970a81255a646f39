#pragma once
#include <string>
#include <vector>

#include "bench/compare/contest.h"
#include "bench/measure/frame_stats.h"

namespace firstray::compare {

/// Reflections in a row of the settings that do not say otherwise, and at least of the reference.
inline constexpr int trade_depth = 4;

/// One way to render: a name, and what differs from the others.
struct TradeSetting {
    std::string name;  ///< e.g. "spp 4, depth 2"
    Contestant contestant;
    StrategyOptions options;
    RenderOptions render;
    int turns = 1;                ///< of frameless rendering
    bool is_orientation = false;  ///< costs or saves memory only: not held against the others
};

/// What buys speed with accuracy, one knob at a time and the sensible pairs, for one strategy.
std::vector<TradeSetting> trade_settings(const Plan& plan, const Contestant& contestant);

/// Renders two frames with every setting, in turns, and compares them with the reference: double precision, all
/// reflections, 16 samples, whole frames.
/// into  becomes {"strategy", "reference", "frames", "rays", "settings": [{"name", "fault", "update_ms", "trace_ms",
///       "total_ms", "totals", "image", "hits", "bytes", "is_orientation", "on_frontier", "worse_than"}]}; when
///       interrupted, from whole rounds, if there are any
/// throws  Interrupted
void measure_trade(Contest& contest, const Contestant& contestant, Json& into);

/// What measure_trade() comes to, about; see Watch.
double trade_work(const Plan& plan);

/// Fills in "on_frontier" and "worse_than". A setting is worse than another that was faster in every round, by 5 % in
/// the median, and is not less accurate: in RMSE, of which a per cent does not count, and in rays that miss or hit
/// falsely. On the frontier are those that no other beats in time and is as accurate. Orientation neither beats nor is
/// beaten.
void judge(Json& settings);

/// "NAME (worse than OTHER)" of every setting nobody should use.
std::vector<std::string> worse_settings(const Json& trade);

/// Frontier and settings nobody should use, as lines for a terminal.
std::string trade_summary(const Json& trade);

}  // namespace firstray::compare
