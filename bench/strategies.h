#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "engine/scene/scene.h"
#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// One way to find hits, by name.
struct StrategyEntry {
    std::string_view name;     ///< as --strategy takes it
    std::string_view summary;  ///< one line for --help
    bool peer = false;         ///< somebody else's structure: agrees with ours, but not to the last bit
    std::unique_ptr<Strategy<float>> (*make)(const Scene& scene,
                                             const StrategyOptions& options) = nullptr;  ///< never null
    std::unique_ptr<Strategy<double>> (*make_double)(const Scene& scene, const StrategyOptions& options) =
        nullptr;  ///< null where there is no such precision
};

/// Every strategy that this build knows; the command, the tests and the benchmarks loop over this.
std::span<const StrategyEntry> strategies();

/// A choice that one strategy alone offers, or a family of them; StrategyOptions::own takes its flag and one of its
/// words.
struct OwnChoice {
    std::string_view strategy;                ///< its name, or what the family's names begin with: "embree"
    std::string_view flag;                    ///< without dashes, e.g. "obb-top"
    std::span<const std::string_view> words;  ///< the first is the default
    std::string_view summary;                 ///< for --help
    /// Where words are patterns, e.g. "threshold=N": refuses what fits none with std::invalid_argument. Null: the words
    /// are all there is.
    void (*check)(const std::string& word) = nullptr;
};

/// All choices of all strategies.
std::span<const OwnChoice> own_choices();

/// Whether a strategy has this choice.
bool offers(std::string_view strategy, const OwnChoice& choice);

/// The entry of that name, or null.
const StrategyEntry* find_strategy(std::string_view name);

/// Makes the strategy of that name for a scene, which outlives it.
/// Real    float for Precision::fast and robust; double has Precision::double_, whatever the options say
/// throws  Error (Fault::usage) for a name that is none or that has no such precision, std::invalid_argument for a word
///         of StrategyOptions::own that is no choice, and what making the strategy throws
template <typename Real = float>
std::unique_ptr<Strategy<Real>> make_strategy(std::string_view name, const Scene& scene, StrategyOptions options = {});

}  // namespace firstray::inline v0
