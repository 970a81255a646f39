#pragma once
#include <optional>
#include <string>

#include "bench/compare/results.h"

namespace firstray::compare {

/// How much longer one strategy's frames took than another's, round by round: rounds were measured side by side.
struct Duel {
    Spread ratio;           ///< slower / faster, at least one round
    bool is_clear = false;  ///< the first was faster outside the noise: see fewest_rounds and least_gain
};

// A strategy is called faster where it was so in every one of three rounds or more, and by a per cent in the median. By
// chance alone it would be so in 1 of 4 comparisons of three rounds and in 1 of 16 of five (both directions).
inline constexpr std::size_t fewest_rounds = 3;
inline constexpr double least_gain = 1.01;

/// first, second  entries of "strategies" that were timed
Duel duel(const Json& first, const Json& second);

/// The entry of that name, or null.
const Json* find_row(const Json& results, const std::string& name);

/// Whether a row was timed and its answers are right, or nearly.
bool counts(const Json& strategy);

/// Which strategy is fastest by total time, among all and among our own:
/// {"all": {"fastest", "level": [names], "second", "ratio", "sentence"} or null, "own": likewise or null,
/// "faster_but_marked": [names of rows that are faster but whose answers differ]}.
/// "level" are those that cannot be told from the fastest; "ratio" is how much longer the first that can be took.
Json verdict_of(const Json& results);

/// "the same hits and pictures as the reference: 0 of N rays differ", or how they differ.
std::string accuracy_sentence(const Json& strategy);

}  // namespace firstray::compare
