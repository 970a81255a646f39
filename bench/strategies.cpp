#include "bench/strategies.h"

#include <algorithm>
#include <stdexcept>

#include "bench/peers/embree.h"
#include "engine/core/errors.h"
#include "engine/strategy/grid.h"
#include "engine/strategy/list.h"
#include "lazy/calibrate.h"
#include "lazy/lazy.h"
#include "obb/obb.h"

namespace firstray::inline v0 {

namespace {

using OwnWords = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view obb_groups[] = {"dynamic", "all"}, obb_top[] = {"grid", "list"},
                           obb_hits[] = {"root", "local"}, obb_inside[] = {"auto", "grid", "list", "lazy"},
                           lazy_top[] = {"groups", "primitives"},
                           list_or_grid[] = {"learned", "evidence", "always-grid", "always-list", "threshold=N"},
                           costs[] = {"calibrated", "NAME=NS,..."};

/// Position of the word that was chosen for a flag; 0 where none was.
/// throws  std::invalid_argument for a word that is not one of the choice's
std::size_t chosen(const OwnWords& own, std::string_view flag)
{
    for (const auto& [name, word] : own) {
        if (name != flag) continue;
        for (const OwnChoice& choice : own_choices()) {
            const auto found = std::find(choice.words.begin(), choice.words.end(), word);
            if (choice.flag == flag && found != choice.words.end())
                return static_cast<std::size_t>(found - choice.words.begin());
        }
        throw std::invalid_argument("--" + name + ": no such choice: " + word);
    }
    return 0;
}

obb::Options obb_options(const OwnWords& own)
{
    return {static_cast<obb::Groups>(chosen(own, "obb-groups")), static_cast<obb::Top>(chosen(own, "obb-top")),
            static_cast<obb::Hits>(chosen(own, "obb-hits")), static_cast<obb::Inside>(chosen(own, "obb-inside"))};
}

template <typename Real>
std::unique_ptr<Strategy<Real>> make_obb(const Scene& scene, const StrategyOptions& options)
{
    return obb::make_obb<Real>(scene, options, obb_options(options.own));
}

lazy::Options lazy_options(const OwnWords& own)
{
    return {.top = static_cast<lazy::LazyTop>(chosen(own, "lazy-top"))};
}

template <typename Real>
std::unique_ptr<Strategy<Real>> make_lazy(const Scene& scene, const StrategyOptions& options)
{
    return lazy::make_lazy<Real>(scene, options, lazy_options(options.own));
}

#ifdef FIRSTRAY_HAVE_EMBREE
constexpr std::string_view embree_rays[] = {"packets", "single"};

template <auto make>
std::unique_ptr<Strategy<float>> make_peer(const Scene& scene, const StrategyOptions& options)
{
    return make(scene, options, peers::Options{static_cast<peers::Rays>(chosen(options.own, "embree-rays"))});
}
#endif

/// The word that was chosen for a flag with patterns, or null.
const std::string* word_of(const OwnWords& own, std::string_view flag)
{
    for (const auto& [name, word] : own)
        if (name == flag) return &word;
    return nullptr;
}

void check_list_or_grid(const std::string& word)
{
    lazy::Rule rule;
    lazy::set_choice(rule, word);
}

void check_costs(const std::string& word)
{
    lazy::replace_costs({}, word);
}

template <typename Real>
std::unique_ptr<Strategy<Real>> make_adaptive(const Scene& scene, const StrategyOptions& options)
{
    lazy::Rule rule{.costs = lazy::calibrated_costs()};
    if (const std::string* word = word_of(options.own, "list-or-grid")) lazy::set_choice(rule, *word);
    if (const std::string* word = word_of(options.own, "costs")) rule.costs = lazy::replace_costs(rule.costs, *word);
    return lazy::make_lazy<Real>(scene, options, {.rule = rule});
}

}  // namespace

std::span<const StrategyEntry> strategies()
{
    static constexpr StrategyEntry table[] = {
        {"list", "test every primitive: slow, and the truth", false, &make_list<float>, &make_list<double>},
        {"grid", "one recursive grid, built anew every frame", false, &make_grid<float>, &make_grid<double>},
        {"obb", "boxes that keep their grids and move with what is in them", false, &make_obb<float>,
         &make_obb<double>},
        {"lazy", "a grid whose parts come into being when the first ray enters them", false, &make_lazy<float>,
         &make_lazy<double>},
        {"adaptive", "as lazy, with lists where rays are too few for a grid to pay", false, &make_adaptive<float>,
         &make_adaptive<double>},
#ifdef FIRSTRAY_HAVE_EMBREE
        {"embree", "Embree 3, one tree of medium quality, built anew every frame", true,
         &make_peer<peers::make_embree_medium>},
        {"embree-low", "Embree 3, the tree that is quickest to build", true, &make_peer<peers::make_embree_low>},
        {"embree-refit", "Embree 3, one tree built once, whose boxes follow what moves", true,
         &make_peer<peers::make_embree_refit>},
        {"embree-two-level", "Embree 3, a tree per group, moved as instances", true,
         &make_peer<peers::make_embree_two_level>},
#endif
    };
    return table;
}

std::span<const OwnChoice> own_choices()
{
    static constexpr OwnChoice table[] = {
        {"obb", "obb-groups", obb_groups, "boxes per dynamic transform, or per static one below too"},
        {"obb", "obb-top", obb_top, "boxes in the scenery's grid, or in a list (the paper)"},
        {"obb", "obb-hits", obb_hits, "decide hits in the root system, or the box's (the paper)"},
        {"obb", "obb-inside", obb_inside, "what is in a box"},
        {"lazy", "lazy-top", lazy_top, "list what moves by groups, or all of it (the paper)"},
        {"adaptive", "list-or-grid", list_or_grid, "by last frame's rays and this one's, by these, ...",
         &check_list_or_grid},
        {"adaptive", "costs", costs, "what it counts with; see info --costs", &check_costs},
#ifdef FIRSTRAY_HAVE_EMBREE
        {"embree", "embree-rays", embree_rays, "rays with a common apex in packets, or one by one"},
#endif
    };
    return table;
}

bool offers(std::string_view strategy, const OwnChoice& choice)
{
    return strategy == choice.strategy || strategy.starts_with(std::string(choice.strategy) + "-");
}

const StrategyEntry* find_strategy(std::string_view name)
{
    for (const StrategyEntry& entry : strategies())
        if (entry.name == name) return &entry;
    return nullptr;
}

namespace {

std::string names_of_strategies()
{
    std::string names;
    for (const StrategyEntry& entry : strategies()) names += (names.empty() ? "" : ", ") + std::string(entry.name);
    return names;
}

}  // namespace

template <typename Real>
std::unique_ptr<Strategy<Real>> make_strategy(std::string_view name, const Scene& scene, StrategyOptions options)
{
    const StrategyEntry* const entry = find_strategy(name);
    if (!entry)
        throw Error(Fault::usage, "no strategy '" + std::string(name) + "', expected one of " + names_of_strategies());
    constexpr bool in_double = std::is_same_v<Real, double>;
    if (in_double)
        options.precision = Precision::double_;
    else if (options.precision == Precision::double_)
        throw Error(Fault::usage, "Precision::double_ is for make_strategy<double>");
    const auto make = [&] {
        if constexpr (in_double)
            return entry->make_double;
        else
            return entry->make;
    }();
    if (!make) throw Error(Fault::usage, "strategy '" + std::string(name) + "' has no such precision");
    return make(scene, options);
}

template std::unique_ptr<Strategy<float>> make_strategy(std::string_view, const Scene&, StrategyOptions);
template std::unique_ptr<Strategy<double>> make_strategy(std::string_view, const Scene&, StrategyOptions);

}  // namespace firstray::inline v0
