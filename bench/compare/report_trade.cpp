#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/html.h"
#include "bench/compare/report_accuracy.h"
#include "bench/compare/report_sections.h"
#include "bench/compare/text.h"
#include "bench/compare/trade.h"

namespace firstray::compare {
namespace {

std::string note_of(const Json& setting)
{
    if (const std::string fault = setting["fault"]; !fault.empty()) return "failed: " + fault;
    if (setting["on_frontier"].get<bool>()) return "frontier";
    const std::string better = setting["worse_than"];
    if (!better.empty()) return "worse than " + better;
    return setting["is_orientation"].get<bool>() ? "memory" : "";
}

std::vector<std::string> cells_of(const Json& setting)
{
    std::vector<std::string> cells = {setting["name"].get<std::string>(), note_of(setting)};
    if (!setting["fault"].get<std::string>().empty()) return cells;
    const Json &image = setting["image"], &hits = setting["hits"];
    for (const char* key : {"update_ms", "trace_ms", "total_ms"}) cells.push_back(short_number(setting[key]["median"]));
    cells.push_back(short_number(image["rmse"]));
    cells.push_back(decibels(image["psnr"]));
    cells.push_back(short_number(image["largest"]));
    cells.push_back(percent(image["differing_share"]));
    cells.push_back(percent(image["perceived"].get<double>() / image["pixels"].get<double>()));
    for (const char* key : {"missed_per_million", "false_per_million", "t_error_p999"})
        cells.push_back(short_number(hits[key]));
    cells.push_back(megabytes(setting["bytes"]));
    return cells;
}

/// How many pixels every setting's pictures were compared on.
std::uint64_t compared_pixels(const Json& trade)
{
    std::uint64_t pixels = 0;
    for (const Json& setting : trade["settings"])
        if (setting.contains("image")) pixels = std::max(pixels, setting["image"]["pixels"].get<std::uint64_t>());
    return pixels;
}

}  // namespace

std::string trade_section(const Json& results)
{
    const Json& trade = results["trade"];
    const std::string rays = grouped(trade["rays"]), pixels = grouped(compared_pixels(trade));
    HtmlTable table({"setting", "", "update,|ms", "trace,|ms", "total,|ms", "RMSE", "PSNR,|dB", "largest|diff.",
                     "differ, of|" + pixels + " px", "hue|(Yee)", "missed/M|of " + rays, "false/M|of " + rays,
                     "error of t,|99.9th", "memory"});
    for (const Json& setting : trade["settings"])
        table.add(cells_of(setting), !setting["worse_than"].get<std::string>().empty());
    return paragraph("Settings nobody should use: " + listed(worse_settings(trade)) + ".", "plain") + table.html() +
           paragraph(fmt::format(
               "Strategy {}; pictures are compared with {}, hits with list in double. A setting nobody should use is "
               "slower than another in every round, by 5 % in the median, and no more accurate: its RMSE is not less "
               "by a per cent, and it misses and hits falsely as often or more. Settings that only cost memory are "
               "there for orientation.",
               trade["strategy"].get<std::string>(), trade["reference"].get<std::string>()));
}

}  // namespace firstray::compare
