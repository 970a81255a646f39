#pragma once
#include <vector>

#include "bench/compare/contest.h"
#include "bench/measure/frame_stats.h"

namespace firstray::compare {

// How time depends on the number of rays and threads, and how wrong a picture is that is only partly new.

/// Times everyone who is in on one thread and on all, tracing 1, 1/4, 1/16 and 1/64 of the pixels, and the shares that
/// the plan asks for, in up to two of the plan's frames.
/// into  becomes {"frames", "strategies": [{"name", "points": [{"threads", "turns", "rays", "update_ms", "trace_ms",
///       "build_ms"}], "ns_per_ray": {kind}}]}: the least over rounds, which noise touches least, of means over frames;
///       when interrupted, over whole rounds, if there are any
/// throws  Interrupted
void measure_sweep(Contest& contest, Json& into);

/// What measure_sweep() and measure_frameless() come to; see Watch.
double sweep_work(const Contest& contest);
double frameless_work_of(const Contest& contest);

/// Fits the law of prediction.h to each strategy's points and holds it against the others.
/// results  with "sweep", "frames" and "strategies"
/// returns  what results.json has under "prediction"
Json prediction_of(const Json& results);

/// Renders frames in a row, frameless, and compares the last ones with whole frames of the same times. The error does
/// not depend on the strategy; the first of our own that is in renders.
/// into  null; becomes [{"turns", "frames", "is_refreshed", "image", "worst_rmse"}], unless nobody can render; when
///       interrupted, those that are finished
/// throws  Interrupted
void measure_frameless(Contest& contest, Json& into);

}  // namespace firstray::compare
