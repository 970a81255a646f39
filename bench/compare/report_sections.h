#pragma once
#include <string>

#include "bench/compare/results.h"

namespace firstray::compare {

// Parts of the report as HTML, each from the results document alone.

std::string summary_section(const Json& results);
std::string structure_section(const Json& results);
std::string prediction_section(const Json& results);
std::string frameless_section(const Json& results);
std::string trade_section(const Json& results);
std::string method_section(const Json& results);

}  // namespace firstray::compare
