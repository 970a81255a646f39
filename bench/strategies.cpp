#include "bench/strategies.h"

#include "bench/peers/embree.h"
#include "engine/strategy/grid.h"
#include "engine/strategy/list.h"

namespace firstray {

std::span<const StrategyEntry> strategies()
{
    static constexpr StrategyEntry table[] = {
        {"list", "test every primitive: slow, and the truth", false, &make_list<float>, &make_list<double>},
        {"grid", "one recursive grid, built anew every frame", false, &make_grid<float>, &make_grid<double>},
#ifdef FIRSTRAY_HAVE_EMBREE
        {"embree", "Embree 3, one tree of medium quality, built anew every frame", true, &peers::make_embree_medium},
        {"embree-low", "Embree 3, the tree that is quickest to build", true, &peers::make_embree_low},
        {"embree-two-level", "Embree 3, a tree per group, moved as instances", true, &peers::make_embree_two_level},
#endif
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
