#include "bench/firstray/search.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

std::vector<std::string_view> known_strategies()
{
    std::vector<std::string_view> names;
    for (const StrategyEntry& entry : strategies()) names.push_back(entry.name);
    return names;
}

Precision parse_precision(std::string_view word)
{
    constexpr std::string_view words[] = {"fast", "robust", "double"};
    constexpr Precision precisions[] = {Precision::fast, Precision::robust, Precision::double_};
    return precisions[find_word("--precision", word, words)];
}

const StrategyEntry& parse_strategy(std::string_view word)
{
    return strategies()[find_word("--strategy", word, known_strategies())];
}

void check_word(const OwnChoice& own, const std::string& word)
{
    const std::string flag = "--" + std::string(own.flag);
    if (!own.check) {
        find_word(flag, word, own.words);
        return;
    }
    try {
        own.check(word);
    } catch (const std::invalid_argument& error) {
        throw UsageError(flag + ": " + error.what());
    }
}

}  // namespace

std::string strategy_names()
{
    return list_of(known_strategies());
}

void check_search(const SearchChoice& choice)
{
    const StrategyEntry& entry = parse_strategy(choice.strategy);
    const bool in_double = parse_precision(choice.precision) == Precision::double_;
    if (in_double ? entry.make_double == nullptr : entry.make == nullptr)
        throw UsageError(fmt::format("--precision: strategy {} has no {}, expected {}", entry.name, choice.precision,
                                     in_double ? "fast or robust" : "double"));
    for (const OwnChoice& own : own_choices())
        if (const auto word = choice.own.find(own.flag); word != choice.own.end() && !word->second.empty()) {
            check_word(own, word->second);
            if (!offers(entry.name, own))
                throw UsageError(fmt::format("--{} is for --strategy {}, not {}", own.flag, own.strategy, entry.name));
        }
    if (choice.structure_budget > 0 && entry.name != "lazy" && entry.name != "adaptive")
        throw UsageError(fmt::format("--structure-budget is for --strategy lazy or adaptive, not {}", entry.name));
}

Json own_choices_of(const SearchChoice& choice)
{
    Json chosen = Json::object();
    for (const OwnChoice& own : own_choices()) {
        const auto word = choice.own.find(own.flag);
        const bool is_given = word != choice.own.end() && !word->second.empty();
        if (offers(choice.strategy, own))
            chosen[std::string(own.flag)] = is_given ? word->second : std::string(own.words[0]);
    }
    return chosen;
}

StrategyOptions options_of(const SearchChoice& choice)
{
    return {.precision = parse_precision(choice.precision),
            .grid_density = choice.grid_density,
            .max_list = choice.max_list,
            .structure_budget = choice.structure_budget,
            .grid_depth = choice.grid_depth};
}

AnyStrategy make_strategy(const SearchChoice& choice, const Scene& scene, const Executor& executor)
{
    check_search(choice);
    const StrategyEntry& entry = parse_strategy(choice.strategy);
    StrategyOptions options = options_of(choice);
    options.executor = &executor;
    for (const auto& [flag, word] : choice.own)
        if (!word.empty()) options.own.emplace_back(flag, word);
    if (options.precision == Precision::double_) return entry.make_double(scene, options);
    return entry.make(scene, options);
}

}  // namespace firstray::command
