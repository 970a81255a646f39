#pragma once
#include <memory>
#include <string>
#include <variant>

#include "bench/firstray/jobs.h"
#include "bench/firstray/stats.h"
#include "bench/strategies.h"

namespace firstray::command {

/// A strategy in the arithmetic that the precision asks for.
using AnyStrategy = std::variant<std::unique_ptr<Strategy<float>>, std::unique_ptr<Strategy<double>>>;

/// The strategies and precisions that there are, as a list for --help.
std::string strategy_names();

/// Refuses a strategy or precision that does not exist before anything large is read.
/// throws  UsageError
void check_search(const SearchChoice& choice);

/// The choices that the strategy alone offers, with their words.
Json own_choices_of(const SearchChoice& choice);

/// What strategies are made with; the executor and own choices are left out.
/// throws  UsageError
StrategyOptions options_of(const SearchChoice& choice);

/// throws  UsageError, and what making the strategy throws
AnyStrategy make_strategy(const SearchChoice& choice, const Scene& scene, const Executor& executor);

}  // namespace firstray::command
