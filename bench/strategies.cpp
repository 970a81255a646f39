#include "bench/strategies.h"

namespace firstray {

std::span<const StrategyEntry> strategies()
{
    return {};
}

const StrategyEntry* find_strategy(std::string_view name)
{
    for (const StrategyEntry& entry : strategies())
        if (entry.name == name) return &entry;
    return nullptr;
}

}  // namespace firstray
