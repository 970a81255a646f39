#include <fmt/format.h>

#include "bench/compare/html.h"
#include "bench/compare/report_sections.h"
#include "bench/compare/text.h"

namespace firstray::compare {
namespace {

std::vector<std::string> cells_of(const Json& setting)
{
    std::vector<std::string> cells = {setting["name"].get<std::string>()};
    if (const std::string fault = setting["fault"]; !fault.empty()) {
        cells.resize(12, "–");
        cells.push_back("failed: " + fault);
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
    cells.push_back(setting["on_frontier"].get<bool>() ? "on the frontier"
                    : setting["worse_than"].get<std::string>().empty()
                        ? ""
                        : "worse than " + setting["worse_than"].get<std::string>());
    return cells;
}

}  // namespace

std::string trade_section(const Json& results)
{
    const Json& trade = results["trade"];
    HtmlTable table({"setting", "update,|ms", "trace,|ms", "total,|ms", "RMSE", "PSNR,|dB", "largest|difference",
                     "pixels that|differ", "another hue|(Yee)", "missed hits|per million", "false hits|per million",
                     "memory", ""});
    for (const Json& setting : trade["settings"])
        table.add(cells_of(setting), !setting["worse_than"].get<std::string>().empty());
    return table.html() +
           fmt::format(
               "<p class=\"note\">{}</p>\n",
               escaped(fmt::format(
                   "Strategy {}; the reference is {}. Missed and false hits against list in double, of {} rays each. "
                   "A setting is worse than another when it is slower in every round and not more accurate; such "
                   "settings nobody should use. Settings that only cost memory are there for orientation.",
                   trade["strategy"].get<std::string>(), trade["reference"].get<std::string>(),
                   grouped(trade["rays"]))));
}

}  // namespace firstray::compare
