#include "bench/strategies.h"

#include <stdexcept>

#include "bench/peers/embree.h"
#include "engine/strategy/grid.h"
#include "engine/strategy/list.h"
#include "obb/obb.h"

namespace firstray {

namespace {

/// The value that a word stands for, in the order of `words`.
template <typename Enum, std::size_t size>
void choose(Enum& target, const std::pair<std::string, std::string>& option, std::string_view flag,
            const std::string_view (&words)[size])
{
    if (option.first != flag) return;
    for (std::size_t i = 0; i < size; ++i)
        if (option.second == words[i]) {
            target = static_cast<Enum>(i);
            return;
        }
    throw std::invalid_argument("--" + option.first + ": no such choice: " + option.second);
}

obb::Options obb_options(const std::vector<std::pair<std::string, std::string>>& words)
{
    obb::Options options;
    for (const auto& word : words) {
        choose(options.groups, word, "obb-groups", {"dynamic", "all"});
        choose(options.top, word, "obb-top", {"grid", "list"});
        choose(options.hits, word, "obb-hits", {"root", "local"});
        choose(options.inside, word, "obb-inside", {"auto", "grid", "list"});
    }
    return options;
}

template <typename Real>
std::unique_ptr<Strategy<Real>> make_obb(const Scene& scene, const StrategyOptions& options)
{
    return obb::make_obb<Real>(scene, options, obb_options(options.own));
}

}  // namespace

std::span<const StrategyEntry> strategies()
{
    static constexpr StrategyEntry table[] = {
        {"list", "test every primitive: slow, and the truth", false, &make_list<float>, &make_list<double>},
        {"grid", "one recursive grid, built anew every frame", false, &make_grid<float>, &make_grid<double>},
        {"obb", "boxes that keep their grids and move with what is in them", false, &make_obb<float>,
         &make_obb<double>},
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
