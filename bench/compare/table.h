#pragma once
#include <string>

#include "bench/compare/results.h"

namespace firstray::compare {

/// The summary as aligned lines: what was compared, a line per strategy with its accuracy, the verdict, and what the
/// marks mean.
std::string summary_table(const Json& results);

/// Why a row was not timed or is not right, or nothing: behind the numbers of tables.
std::string remark(const Json& strategy);

/// How many rays everyone's hits were compared on.
std::uint64_t checked_rays(const Json& results);

/// "8 frames of Robot, 400x300, depth 4, 1 sample, robust, 2 threads, 5 rounds".
std::string setting_line(const Json& results);

}  // namespace firstray::compare
