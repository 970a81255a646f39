#pragma once
#include "bench/compare/gnuplot.h"
#include "bench/compare/results.h"

namespace firstray::compare {

// What is drawn, taken from the results document alone. A chart without data has no series.

Chart update_chart(const Json& results);      ///< the paper's figures 3 and 4
Chart trace_chart(const Json& results);       ///< likewise
Chart rays_chart(const Json& results);        ///< the paper's figure 1
Chart processors_chart(const Json& results);  ///< its argument of 16, 32 and 128 processors
Chart frameless_chart(const Json& results);
Chart trade_chart(const Json& results);

}  // namespace firstray::compare
