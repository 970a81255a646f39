#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/strategies.h"

namespace firstray {

/// A strategy with choices of its own.
struct Contestant {
    std::string name;  ///< as it was asked for, e.g. "obb+obb-top=list"
    const StrategyEntry* entry = nullptr;
    std::vector<std::pair<std::string, std::string>> own{};  ///< StrategyOptions::own
};

/// Reads NAME+FLAG=WORD+FLAG=WORD.
/// throws  Error (Fault::usage) for a strategy, flag or word that there is not
Contestant parse_contestant(std::string_view text);

}  // namespace firstray
