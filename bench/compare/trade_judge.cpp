#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/text.h"
#include "bench/compare/trade.h"

namespace firstray::compare {
namespace {

bool is_judged(const Json& setting)
{
    return setting["fault"].get<std::string>().empty() && !setting["is_orientation"].get<bool>();
}

double error_of(const Json& setting)
{
    return setting["image"]["rmse"];
}

double total_of(const Json& setting)
{
    return setting["total_ms"]["median"];
}

double wrong_of(const Json& setting)
{
    return setting["hits"]["missed_per_million"].get<double>() + setting["hits"]["false_per_million"].get<double>();
}

bool is_as_accurate(const Json& a, const Json& b)
{
    constexpr double same = 1.01;  // which samples a pixel happens to have makes as much
    return error_of(a) <= same * error_of(b) && wrong_of(a) <= wrong_of(b);
}

/// Faster in every round, by so much in the median, and not less accurate.
bool is_clearly_better(const Json& a, const Json& b)
{
    constexpr double least_gain = 1.05;  // three rounds are few: less than that is not worth a warning
    if (!is_as_accurate(a, b) || total_of(b) < least_gain * total_of(a)) return false;
    for (std::size_t round = 0; round < a["totals"].size(); ++round)
        if (a["totals"][round] >= b["totals"][round]) return false;
    return true;
}

bool beats(const Json& a, const Json& b)
{
    return is_as_accurate(a, b) && total_of(a) < total_of(b);
}

}  // namespace

void judge(Json& settings)
{
    for (Json& setting : settings) {
        if (!is_judged(setting)) continue;
        setting["on_frontier"] = true;
        for (const Json& other : settings) {
            if (!is_judged(other)) continue;
            if (beats(other, setting)) setting["on_frontier"] = false;
            if (setting["worse_than"] == "" && is_clearly_better(other, setting)) setting["worse_than"] = other["name"];
        }
    }
}

std::vector<std::string> worse_settings(const Json& trade)
{
    std::vector<std::string> worse;
    for (const Json& setting : trade["settings"])
        if (setting["worse_than"] != "")
            worse.push_back(fmt::format("{} (worse than {})", setting["name"].get<std::string>(),
                                        setting["worse_than"].get<std::string>()));
    return worse;
}

std::string trade_summary(const Json& trade)
{
    std::vector<const Json*> frontier;
    for (const Json& setting : trade["settings"])
        if (setting["on_frontier"].get<bool>()) frontier.push_back(&setting);
    std::sort(frontier.begin(), frontier.end(),
              [](const Json* a, const Json* b) { return total_of(*a) < total_of(*b); });
    std::string text = fmt::format("the trade, {}, against {}:\n", trade["strategy"].get<std::string>(),
                                   trade["reference"].get<std::string>());
    for (const Json* setting : frontier)
        text += fmt::format("  {:<26} {:>9} ms  RMSE {:.5f}  missed/M {}  false/M {} of {} rays\n",
                            (*setting)["name"].get<std::string>(), short_number(total_of(*setting)), error_of(*setting),
                            short_number((*setting)["hits"]["missed_per_million"]),
                            short_number((*setting)["hits"]["false_per_million"]), grouped(trade["rays"]));
    return text + "  nobody should use: " + listed(worse_settings(trade)) + "\n";
}

}  // namespace firstray::compare
