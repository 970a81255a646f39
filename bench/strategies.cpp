#include "bench/strategies.h"

#include "engine/strategy/grid.h"
#include "engine/strategy/list.h"

namespace firstray {

std::span<const StrategyEntry> strategies()
{
    static constexpr StrategyEntry table[] = {
        {"list", "test every primitive: slow, and the truth", false, &make_list<float>, &make_list<double>},
        {"grid", "one recursive grid, built anew every frame", false, &make_grid<float>, &make_grid<double>},
    };
    return table;
}

const StrategyEntry* find_strategy(std::string_view name)
{
    for (const StrategyEntry& entry : strategies())
        if (entry.name == name) return &entry;
    return nullptr;
}

}  // namespace firstray
