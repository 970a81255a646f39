#include <fmt/format.h>

#include <cmath>

#include "bench/compare/html.h"
#include "bench/compare/report_sections.h"
#include "bench/compare/text.h"

namespace firstray::compare {
namespace {

std::string whole_or_short(double value)
{
    return value == std::floor(value) && value < 1e6 ? fmt::format("{:.0f}", value) : short_number(value);
}

std::string reign_list(const Json& reigns, double unit, const char* what)
{
    std::vector<std::string> parts;
    for (const Json& reign : reigns)
        parts.push_back(fmt::format("{} from {} to {}", reign["fastest"].get<std::string>(),
                                    whole_or_short(reign["from"].get<double>() * unit),
                                    whole_or_short(reign["to"].get<double>() * unit)));
    return parts.empty() ? "" : paragraph(fmt::format("Fastest by {}: {}.", what, listed(parts)), "plain");
}

std::string law_table(const Json& prediction)
{
    HtmlTable table({"strategy", "update, one|processor, ms", "of that not|shared, ms", "lazy,|ms",
                     "ns per primary|with its others", "searching,|ns", "balance at,|processors", "total at|16, ms",
                     "at 32,|ms", "at 128,|ms"});
    for (const Json& law : prediction["strategies"]) {
        const double all = law["ns_per_primary_ray"], other = law["other_ns_per_primary_ray"];
        const Json& totals = law["totals"];
        const double update = law["update_serial_ms"].get<double>() + law["update_shared_ms"].get<double>();
        table.add({law["name"], short_number(update), short_number(law["update_serial_ms"]),
                   short_number(law["build_ms"]), short_number(all), short_number(all - other),
                   law["balanced_processors"].is_null() ? "∞" : short_number(law["balanced_processors"]),
                   short_number(totals[4]["total_ms"]), short_number(totals[5]["total_ms"]),
                   short_number(totals[7]["total_ms"])});
    }
    return table.html();
}

std::string check_table(const Json& prediction)
{
    HtmlTable table({"strategy", "threads", "pixels|divided by", "predicted, ms", "measured, ms", "error"});
    for (const Json& law : prediction["strategies"])
        for (const Json& point : law["checked"])
            table.add({law["name"], point["threads"].dump(), point["turns"].dump(), short_number(point["predicted_ms"]),
                       short_number(point["measured_ms"]),
                       fmt::format("{:+.0f} %", 100.0 * point["error"].get<double>())});
    return "<details><summary>Prediction against measurement, point by point</summary>\n" + table.html() +
           "</details>\n";
}

std::string break_even_list(const Json& prediction)
{
    std::string text;
    for (const Json& entry : prediction["break_even"])
        text += fmt::format("<li>{} below, {} above {} primary rays a frame</li>\n",
                            escaped(entry["below"].get<std::string>()), escaped(entry["above"].get<std::string>()),
                            grouped(static_cast<std::uint64_t>(entry["rays"].get<double>())));
    if (text.empty())
        return paragraph("No two strategies break even within a thousandth to a hundred times these rays.");
    return "<p>Break-even points on this machine's threads:</p><ul>\n" + text + "</ul>\n";
}

}  // namespace

std::string prediction_section(const Json& results)
{
    const Json& prediction = results["prediction"];
    const double rays = prediction["rays"];
    std::string text = reign_list(prediction["fastest_by_processors"], 1.0, "number of processors");
    text +=
        reign_list(prediction["fastest_by_rays"], 1e-3, "thousands of primary rays a frame, on this machine's threads");
    text += break_even_list(prediction) + law_table(prediction);
    text += paragraph(fmt::format(
        "Balance is the number of processors at which tracing takes no longer than an update that is not shared: "
        "more hardly help. The law: total = update (not shared) + (update (shared) + lazy building + ns per ray x "
        "rays) "
        "/ processors, fitted to whole frames of {} primary rays on one thread, to the update on all threads, and to "
        "what the fewest rays have built; building that grows with the rays is in their ns. Held against {} threads "
        "and fewer rays (the least of three rounds each) it is off by {} in the median, {} at most.",
        grouped(static_cast<std::uint64_t>(rays)), prediction["threads"].dump(), percent(prediction["median_error"]),
        percent(prediction["largest_error"])));
    return text + check_table(prediction);
}

}  // namespace firstray::compare
