#include <fmt/format.h>

#include "bench/compare/trade.h"

namespace firstray::compare {

std::vector<TradeSetting> trade_settings(const Plan& plan, const Contestant& contestant)
{
    TradeSetting base{"base", contestant, plan.options, plan.render};
    base.options.precision = Precision::robust;
    base.render.depth = trade_depth;
    base.render.samples = 1;
    std::vector<TradeSetting> settings;
    const auto add = [&](const std::string& name, const auto& change) {
        settings.push_back(base);
        settings.back().name = name;
        change(settings.back());
    };
    add("robust, depth 4, spp 1", [](TradeSetting&) {});
    add("fast", [](TradeSetting& s) { s.options.precision = Precision::fast; });
    add("double", [](TradeSetting& s) { s.options.precision = Precision::double_; });
    for (const int depth : {0, 1, 2, 3})
        add(fmt::format("depth {}", depth), [&](TradeSetting& s) { s.render.depth = depth; });
    for (const int samples : {4, 16})
        add(fmt::format("spp {}", samples), [&](TradeSetting& s) { s.render.samples = samples; });
    for (const int turns : {2, 4, 16})
        add(fmt::format("frameless 1/{}", turns), [&](TradeSetting& s) { s.turns = turns; });
    add("spp 4, depth 2", [](TradeSetting& s) { s.render.samples = 4, s.render.depth = 2; });
    add("spp 4, frameless 1/4", [](TradeSetting& s) { s.render.samples = 4, s.turns = 4; });
    add("depth 2, frameless 1/4", [](TradeSetting& s) { s.render.depth = 2, s.turns = 4; });
    add("fast, depth 2", [](TradeSetting& s) { s.options.precision = Precision::fast, s.render.depth = 2; });

    base.is_orientation = true;
    for (const float density : {1.0f, 8.0f})
        add(fmt::format("grid density {}", density), [&](TradeSetting& s) { s.options.grid_density = density; });
    for (const int list : {4, 64})
        add(fmt::format("max list {}", list), [&](TradeSetting& s) { s.options.max_list = list; });
    add("obb, obb-groups all", [](TradeSetting& s) { s.contestant = parse_contestant("obb+obb-groups=all"); });
    add("lazy, structure budget 1 MB", [](TradeSetting& s) {
        s.contestant = parse_contestant("lazy");
        s.options.structure_budget = 1000000;
    });
    return settings;
}

}  // namespace firstray::compare
