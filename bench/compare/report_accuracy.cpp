#include "bench/compare/report_accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/compare/table.h"
#include "bench/compare/text.h"
#include "bench/compare/verdict.h"

namespace firstray::compare {
namespace {

/// How many pixels everyone's pictures were compared on.
std::uint64_t checked_pixels(const Json& results)
{
    std::uint64_t pixels = 0;
    for (const Json& strategy : results["strategies"])
        pixels = std::max(pixels, strategy["accuracy"]["image"]["pixels"].get<std::uint64_t>());
    return pixels;
}

std::string accuracy_of(const Json& strategy)
{
    if (strategy["status"] == "exact") return "the reference's hits and pictures to the last bit, 0 differ";
    const Json &accuracy = strategy["accuracy"], &image = accuracy["image"];
    return fmt::format(
        "{} missed and {} false hits per million, t off by {}, RMSE {}, PSNR {} dB, largest difference {}, {} of the "
        "pixels differ",
        short_number(accuracy["missed_per_million"]), short_number(accuracy["false_per_million"]),
        short_number(accuracy["t_error_p999"]), short_number(image["rmse"]), decibels(image["psnr"]),
        short_number(image["largest"]), percent(image["differing_share"]));
}

}  // namespace

std::string decibels(const Json& psnr)
{
    return psnr.is_null() ? "∞" : fmt::format("{:.1f}", psnr.get<double>());
}

std::string agreement_word(const Json& strategy)
{
    const std::string status = strategy["status"];
    return status == "exact" ? "bit for bit" : status == "close" ? "nearly" : "NO";
}

std::vector<std::string> with_accuracy(const Json& results, std::vector<std::string> headings)
{
    const std::string rays = grouped(checked_rays(results)), pixels = grouped(checked_pixels(results));
    for (const std::string& heading :
         {"missed/M|of " + rays, "false/M|of " + rays, std::string("error of t,|99.9th"), std::string("RMSE"),
          std::string("PSNR,|dB"), std::string("largest|diff."), "differ, of|" + pixels + " px"})
        headings.push_back(heading);
    return headings;
}

void add_speed_row(const Json& strategy, std::vector<std::string> speed, HtmlTable& table)
{
    std::vector<std::string> cells = {strategy["name"].get<std::string>()};
    if (strategy["times"].is_null()) {
        cells.push_back(remark(strategy));
        return table.add(std::move(cells), true);
    }
    const Json &accuracy = strategy["accuracy"], &image = accuracy["image"];
    cells.insert(cells.end(), speed.begin(), speed.end());
    for (const char* key : {"missed_per_million", "false_per_million", "t_error_p999"})
        cells.push_back(short_number(accuracy[key]));
    cells.push_back(short_number(image["rmse"]));
    cells.push_back(decibels(image["psnr"]));
    cells.push_back(short_number(image["largest"]));
    cells.push_back(percent(image["differing_share"]));
    table.add(std::move(cells), !counts(strategy));
}

std::string accuracy_note(const Json& results)
{
    std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // accuracy, who has it
    for (const Json& strategy : results["strategies"]) {
        if (strategy["times"].is_null()) continue;
        const std::string accuracy = accuracy_of(strategy);
        const auto found =
            std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.first == accuracy; });
        auto& group = found == groups.end() ? groups.emplace_back(accuracy, std::vector<std::string>{}) : *found;
        group.second.push_back(strategy["name"]);
    }
    if (groups.empty()) return "";
    std::string text =
        fmt::format("Accuracy, on {} rays (t: 99.9th percentile) and {} pixels:", grouped(checked_rays(results)),
                    grouped(checked_pixels(results)));
    for (std::size_t i = 0; i < groups.size(); ++i)
        text += fmt::format("{} {}: {}", i == 0 ? "" : ";", listed(groups[i].second), groups[i].first);
    return paragraph(text + ".");
}

}  // namespace firstray::compare
