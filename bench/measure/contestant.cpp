#include "bench/measure/contestant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "engine/core/errors.h"

namespace firstray {
namespace {

[[noreturn]] void refuse(std::string_view what, std::string_view word, const std::vector<std::string_view>& known)
{
    throw Error(Fault::usage, fmt::format("{} '{}', expected one of {}", what, word, fmt::join(known, ", ")));
}

const StrategyEntry& entry_of(std::string_view name)
{
    if (const StrategyEntry* entry = find_strategy(name)) return *entry;
    std::vector<std::string_view> names;
    for (const StrategyEntry& entry : strategies()) names.push_back(entry.name);
    refuse("strategy", name, names);
}

void check_word(const OwnChoice& choice, std::string_view word)
{
    if (!choice.check) {
        if (std::find(choice.words.begin(), choice.words.end(), word) == choice.words.end())
            refuse(choice.flag, word, {choice.words.begin(), choice.words.end()});
        return;
    }
    try {
        choice.check(std::string(word));
    } catch (const std::invalid_argument& fault) {
        throw Error(Fault::usage, fmt::format("{}: {}", choice.flag, fault.what()));
    }
}

std::pair<std::string, std::string> own_choice(std::string_view strategy, std::string_view text)
{
    const std::size_t equals = text.find('=');
    const std::string_view flag = text.substr(0, equals);
    const std::string_view word = equals == text.npos ? "" : text.substr(equals + 1);
    std::vector<std::string_view> flags;
    for (const OwnChoice& choice : own_choices()) {
        if (!offers(strategy, choice)) continue;
        flags.push_back(choice.flag);
        if (choice.flag != flag) continue;
        check_word(choice, word);
        return {std::string(flag), std::string(word)};
    }
    refuse(fmt::format("strategy {} has no choice", strategy), flag, flags);
}

}  // namespace

Contestant parse_contestant(std::string_view text)
{
    const std::size_t end = text.find('+');
    const StrategyEntry& entry = entry_of(text.substr(0, end));
    Contestant contestant{std::string(text), &entry, {}};
    for (std::size_t plus = end; plus != text.npos;) {
        const std::size_t next = text.find('+', plus + 1);
        contestant.own.push_back(own_choice(entry.name, text.substr(plus + 1, next - plus - 1)));
        plus = next;
    }
    return contestant;
}

}  // namespace firstray
