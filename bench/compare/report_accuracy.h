#pragma once
#include <string>
#include <vector>

#include "bench/compare/html.h"
#include "bench/compare/results.h"

namespace firstray::compare {

// Every speed stands beside its accuracy: columns behind a table's, a sentence beneath charts.

/// The headings of a table of speed with those of accuracy behind, which name how many rays and pixels were compared.
std::vector<std::string> with_accuracy(const Json& results, std::vector<std::string> headings);

/// A row of such a table.
/// strategy  an entry of "strategies"; one that was not timed has its reason for all cells
/// speed     what stands between the strategy's name and its accuracy
void add_speed_row(const Json& strategy, std::vector<std::string> speed, HtmlTable& table);

/// The same accuracy as text, for what stands above: strategies that have it in common are named together.
std::string accuracy_note(const Json& results);

/// "bit for bit", or how far apart: of a row's hits and pictures and the reference's.
std::string agreement_word(const Json& strategy);

/// A peak signal-to-noise ratio, dB; null is infinite.
std::string decibels(const Json& psnr);

}  // namespace firstray::compare
