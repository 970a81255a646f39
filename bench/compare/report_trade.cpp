#include <fmt/format.h>

#include "bench/compare/html.h"
#include "bench/compare/report_sections.h"
#include "bench/compare/text.h"

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
    if (!setting["fault"].get<std::string>().empty()) {
        cells.resize(13, "–");
        return cells;
    }
    const Json &image = setting["image"], &hits = setting["hits"];
    for (const char* key : {"update_ms", "trace_ms", "total_ms"}) cells.push_back(short_number(setting[key]["median"]));
    cells.push_back(short_number(image["rmse"]));
    cells.push_back(image["psnr"].is_null() ? "∞" : fmt::format("{:.1f}", image["psnr"].get<double>()));
    cells.push_back(short_number(image["largest"]));
    cells.push_back(short_number(100.0 * image["differing_share"].get<double>()) + " %");
    const double perceived = image["perceived"].get<double>() / image["pixels"].get<double>();
    cells.push_back(short_number(100.0 * perceived) + " %");
    cells.push_back(short_number(hits["missed_per_million"]));
    cells.push_back(short_number(hits["false_per_million"]));
    cells.push_back(megabytes(setting["bytes"]));
    return cells;
}

}  // namespace

std::string trade_section(const Json& results)
{
    const Json& trade = results["trade"];
    HtmlTable table({"setting", "", "update,|ms", "trace,|ms", "total,|ms", "RMSE", "PSNR,|dB", "largest|diff.",
                     "pixels|differ", "hue|(Yee)", "missed|per M", "false|per M", "memory"});
    for (const Json& setting : trade["settings"])
        table.add(cells_of(setting), !setting["worse_than"].get<std::string>().empty());
    return table.html() +
           fmt::format(
               "<p class=\"note\">{}</p>\n",
               escaped(fmt::format(
                   "Strategy {}; the reference is {}. Missed and false hits against list in double, of {} rays each. "
                   "A setting is worse than another when it is slower in every round, by 5 % in the median, and not "
                   "more accurate; such "
                   "settings nobody should use. Settings that only cost memory are there for orientation.",
                   trade["strategy"].get<std::string>(), trade["reference"].get<std::string>(),
                   grouped(trade["rays"]))));
}

}  // namespace firstray::compare
