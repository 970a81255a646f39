#pragma once
#include <string>

#include "bench/measure/frame_stats.h"

namespace firstray::compare {

// Two runs were not interleaved, so a time has changed only where the rounds of both do not overlap, and the medians
// are further apart than machines drift.
inline constexpr double least_change = 0.05;     // of the former
inline constexpr double least_change_ms = 0.02;  // below it clocks and caches decide

/// What changed from one run to another of the same scene and settings:
/// {"notes", "changes": [{"strategy", "what", "before", "after", "is_regression"}], "regressions"}.
/// Times by median; memory; accuracy, where anything worse counts; a strategy that now fails or disagrees.
/// throws  Error (Fault::usage) where the runs cannot be compared
Json compare_runs(const Json& before, const Json& after);

/// The same for a terminal.
std::string change_table(const Json& changes);

}  // namespace firstray::compare
