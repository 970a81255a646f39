#include "lazy/rule.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "engine/primitive/triangle_pack.h"

namespace firstray::inline v0::lazy {
namespace {

/// Packs that a ray meets of many, and blocks of boxes it goes through to find them: beyond these a voxel is a subgrid,
/// whose cells hold about as much.
constexpr double packs_met = 3.0, blocks_met = 4.0;

/// Packs and blocks of boxes that a ray is tested against where primitives stand in a grid.
double packs_tested(std::uint64_t primitives)
{
    const double packs = std::ceil(static_cast<double>(primitives) / pack_size);
    if (packs <= 1.0) return packs;
    return std::min(packs, packs_met) + std::min(std::ceil(packs / pack_size), blocks_met);
}

double parse_cost(std::string_view text)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value > 0.0) || !std::isfinite(value))
        throw std::invalid_argument("'" + std::string(text) + "', expected nanoseconds > 0");
    return value;
}

void replace_cost(Costs& costs, std::string_view text)
{
    const std::size_t equals = text.find('=');
    std::string known;
    for (const CostName& cost : cost_names()) {
        if (equals != text.npos && text.substr(0, equals) == cost.name) {
            costs.*cost.cost = parse_cost(text.substr(equals + 1));
            return;
        }
        known += (known.empty() ? "" : ", ") + std::string(cost.name);
    }
    throw std::invalid_argument("'" + std::string(text) + "', expected NAME=NS with a name of " + known);
}

}  // namespace

std::span<const CostName> cost_names()
{
    static constexpr CostName names[] = {
        {"test", "a ray against a primitive of a list", &Costs::test},
        {"test_alone", "the same where the group is not carried", &Costs::test_alone},
        {"pack", "a ray against sixteen triangles, or boxes of them", &Costs::pack},
        {"entry", "sending a ray into the grid of a group", &Costs::entry},
        {"packing", "putting a primitive into a flat list", &Costs::packing},
        {"carrying", "carrying a primitive into the root system", &Costs::carrying},
        {"listing", "putting a primitive into a top grid", &Costs::listing},
        {"building", "building, per primitive that a voxel lists", &Costs::building},
        {"making", "building, however small", &Costs::making},
    };
    return names;
}

Costs replace_costs(Costs costs, std::string_view text)
{
    for (std::size_t end; (end = text.find(',')) != text.npos; text.remove_prefix(end + 1))
        replace_cost(costs, text.substr(0, end));
    replace_cost(costs, text);
    return costs;
}

void set_choice(Rule& rule, std::string_view text)
{
    constexpr std::string_view words[] = {"learned", "always-grid", "always-list"};
    rule.forecasts = text != "evidence";
    if (text == "evidence") text = "learned";
    constexpr std::string_view prefix = "threshold=";
    for (std::size_t i = 0; i < std::size(words); ++i)
        if (text == words[i]) {
            rule.choice = static_cast<ListOrGrid>(i);
            return;
        }
    if (text.starts_with(prefix)) {
        const std::string_view number = text.substr(prefix.size());
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), rule.threshold);
        rule.choice = ListOrGrid::threshold;
        if (error == std::errc{} && end == number.data() + number.size()) return;
    }
    throw std::invalid_argument(
        "'" + std::string(text) +
        "', expected learned, evidence, always-grid, always-list or threshold=N, e.g. threshold=100");
}

bool is_carried_first(const Costs& costs)
{
    return costs.carrying + costs.test <= costs.test_alone;
}

/// Of the grid only the top level is made at first, but its rays soon have most of what they see built.
Alternatives scenery_alternatives(const Costs& costs, std::uint64_t primitives, double met)
{
    const auto n = static_cast<double>(primitives);
    const double packs = std::ceil(n / pack_size);
    return {.primitives = primitives,
            .pack = n * costs.packing,
            .list = (std::ceil(packs / pack_size) + met) * costs.pack,
            .grid = voxels_met * packs_tested(primitives) * costs.pack,
            .build = costs.making + n * (costs.listing + costs.building)};
}

Alternatives group_alternatives(const Costs& costs, std::uint64_t primitives, bool is_one_voxel)
{
    const auto n = static_cast<double>(primitives);
    const bool first = is_carried_first(costs);
    Alternatives place{.primitives = primitives,
                       .once = first ? n * costs.carrying : 0.0,
                       .list = n * (first ? costs.test : costs.test_alone),
                       .grid = costs.entry + packs_tested(primitives) * costs.pack,
                       .build = costs.making + n * (costs.listing + (first ? 0.0 : costs.carrying))};
    if (is_one_voxel) place.build += costs.making + n * costs.building;
    return place;
}

Alternatives voxel_alternatives(const Costs& costs, std::uint64_t listed)
{
    const auto n = static_cast<double>(listed);
    return {.primitives = listed,
            .list = n * costs.test,
            .grid = packs_tested(listed) * costs.pack,
            .build = costs.making + n * costs.building};
}

std::uint64_t rays_to_build(const Rule& rule, const Alternatives& place)
{
    if (rule.choice == ListOrGrid::always_grid) return 1;
    if (rule.choice == ListOrGrid::always_list) return never;
    if (rule.choice == ListOrGrid::threshold) return place.primitives > rule.threshold ? 1 : never;
    const double rays = std::max(place.build - place.pack, 0.0) / (place.list - place.grid);
    return place.list > place.grid && rays < 1e18 ? static_cast<std::uint64_t>(rays) + 1 : never;
}

double spent(const Alternatives& place, std::uint64_t listed, std::uint64_t gridded, bool is_built)
{
    if (listed + gridded == 0) return 0.0;
    return place.once + place.pack + (is_built ? place.build : 0.0) + static_cast<double>(listed) * place.list +
           static_cast<double>(gridded) * place.grid;
}

double least(const Alternatives& place, std::uint64_t rays)
{
    if (rays == 0) return 0.0;
    const auto r = static_cast<double>(rays);
    return place.once + std::min(place.pack + r * place.list, place.build + r * place.grid);
}

}  // namespace firstray::inline v0::lazy
