#include "bench/compare/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bench/compare/text.h"

namespace firstray::compare {
namespace {

std::vector<const Json*> ranked(const Json& results, const std::function<bool(const Json&)>& admits)
{
    std::vector<const Json*> rows;
    for (const Json& strategy : results["strategies"])
        if (counts(strategy) && admits(strategy)) rows.push_back(&strategy);
    std::stable_sort(rows.begin(), rows.end(), [](const Json* a, const Json* b) {
        return (*a)["times"]["total_ms"]["median"] < (*b)["times"]["total_ms"]["median"];
    });
    return rows;
}

/// level  who cannot be told from the fastest
std::string sentence_of(const Json& fastest, const std::vector<const Json*>& level, const Json* second,
                        const Spread& ratio, std::size_t rounds)
{
    const auto time = [](const Json& row) { return milliseconds(row["times"]["total_ms"]["median"]); };
    std::string text = fmt::format("{} takes {} a frame{}; {}.", fastest["name"].get<std::string>(), time(fastest),
                                   level.empty() ? "" : ", the least in the median", accuracy_sentence(fastest));
    std::vector<std::string> names;
    for (const Json* row : level)
        names.push_back(fmt::format("{} ({})", (*row)["name"].get<std::string>(), time(*row)));
    if (!level.empty())
        text += fmt::format(" {} cannot be told from it in {} round{}.", listed(names), rounds, rounds == 1 ? "" : "s");
    if (second)
        text += fmt::format(" {} takes {:.2f} times as long ({:.2f} to {:.2f} in the rounds).",
                            (*second)["name"].get<std::string>(), ratio.median, ratio.least, ratio.most);
    return text;
}

Json winner(const std::vector<const Json*>& rows)
{
    if (rows.empty()) return nullptr;
    const Json& fastest = *rows.front();
    std::vector<const Json*> level;
    const Json* second = nullptr;
    Spread ratio;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const Duel found = duel(fastest, *rows[i]);
        if (!found.is_clear) {
            level.push_back(rows[i]);
        } else if (!second) {
            second = rows[i];
            ratio = found.ratio;
        }
    }
    Json names = Json::array();
    for (const Json* row : level) names.push_back((*row)["name"]);
    Json json = {{"fastest", fastest["name"]},
                 {"total_ms", fastest["times"]["total_ms"]["median"]},
                 {"level", names},
                 {"second", second ? (*second)["name"] : Json(nullptr)},
                 {"ratio", second ? to_json(ratio) : Json(nullptr)}};
    json["sentence"] = sentence_of(fastest, level, second, ratio, by_round(fastest, "total_ms").size());
    return json;
}

/// Rows whose answers differ, outside the noise faster than what is called fastest.
Json faster_but_marked(const Json& results, const Json& fastest)
{
    Json names = Json::array();
    for (const Json& strategy : results["strategies"]) {
        if (strategy["status"] != "differs") continue;
        const Json* best = fastest.is_null() ? nullptr : find_row(results, fastest["fastest"]);
        if (!best || duel(strategy, *best).is_clear) names.push_back(strategy["name"]);
    }
    return names;
}

}  // namespace

Duel duel(const Json& first, const Json& second)
{
    const std::vector<double> a = by_round(first, "total_ms"), b = by_round(second, "total_ms");
    std::vector<double> ratios;
    for (std::size_t round = 0; round < std::min(a.size(), b.size()); ++round) ratios.push_back(b[round] / a[round]);
    const Spread ratio = spread_of(ratios);
    return {ratio, ratios.size() >= fewest_rounds && ratio.least > 1.0 && ratio.median >= least_gain};
}

const Json* find_row(const Json& results, const std::string& name)
{
    for (const Json& strategy : results["strategies"])
        if (strategy["name"] == name) return &strategy;
    return nullptr;
}

bool counts(const Json& strategy)
{
    return strategy["status"] == "exact" || strategy["status"] == "close";
}

Json verdict_of(const Json& results)
{
    const auto all = [](const Json&) { return true; };
    const auto own = [](const Json& strategy) { return !strategy["peer"].get<bool>(); };
    const Json fastest = winner(ranked(results, all));
    return {{"all", fastest},
            {"own", winner(ranked(results, own))},
            {"faster_but_marked", faster_but_marked(results, fastest)}};
}

std::string accuracy_sentence(const Json& strategy)
{
    const Json& accuracy = strategy["accuracy"];
    const std::string rays = grouped(accuracy["rays"].get<std::uint64_t>());
    if (strategy["status"] == "exact")
        return fmt::format("its hits and pictures are the reference's to the last bit (0 of {} rays differ)", rays);
    return fmt::format("of {} rays it misses {} and hits falsely {} per million, its pictures are off by {:.2g} (RMSE)",
                       rays, short_number(accuracy["missed_per_million"]), short_number(accuracy["false_per_million"]),
                       accuracy["image"]["rmse"].get<double>());
}

}  // namespace firstray::compare
