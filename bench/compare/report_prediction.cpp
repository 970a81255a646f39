#include <fmt/format.h>

#include "bench/compare/html.h"
#include "bench/compare/report_accuracy.h"
#include "bench/compare/report_sections.h"
#include "bench/compare/text.h"
#include "bench/compare/verdict.h"

namespace firstray::compare {
namespace {

std::string whole(const Json& value)
{
    return grouped(static_cast<std::uint64_t>(value.get<double>()));
}

std::string reign_list(const Json& reigns, const char* what)
{
    std::vector<std::string> parts;
    for (const Json& reign : reigns) {
        const std::string from = whole(reign["from"]), to = whole(reign["to"]);
        parts.push_back(reign["fastest"].get<std::string>() +
                        (from == to ? fmt::format(" at {}", from) : fmt::format(" from {} to {}", from, to)));
    }
    return parts.empty() ? "" : paragraph(fmt::format("Fastest by {}: {}.", what, listed(parts)), "plain");
}

std::string law_table(const Json& results)
{
    HtmlTable table(with_accuracy(results, {"strategy", "update,|ms", "not|shared", "any rays,|ms", "ns per|primary",
                                            "balance,|CPUs", "total at 16, 32,|128 CPUs, ms"}));
    for (const Json& law : results["prediction"]["strategies"]) {
        const Json& totals = law["totals"];
        const double update = law["update_serial_ms"].get<double>() + law["update_shared_ms"].get<double>();
        add_speed_row(*find_row(results, law["name"]),
                      {short_number(update), short_number(law["update_serial_ms"]), short_number(law["fixed_ms"]),
                       short_number(law["ns_per_primary_ray"]),
                       law["balanced_processors"].is_null() ? "∞" : short_number(law["balanced_processors"]),
                       fmt::format("{}, {}, {}", short_number(totals[4]["total_ms"]),
                                   short_number(totals[5]["total_ms"]), short_number(totals[7]["total_ms"]))},
                      table);
    }
    return table.html();
}

std::string folded(const char* title, const std::string& content)
{
    return fmt::format("<details><summary>{}</summary>\n{}</details>\n", title, content);
}

std::string check_table(const Json& results)
{
    HtmlTable table(
        with_accuracy(results, {"strategy", "threads", "rays|divided by", "predicted,|ms", "measured,|ms", "off by"}));
    for (const Json& law : results["prediction"]["strategies"])
        for (const Json& point : law["checked"])
            add_speed_row(
                *find_row(results, law["name"]),
                {point["threads"].dump(), point["turns"].dump(), short_number(point["predicted_ms"]),
                 short_number(point["measured_ms"]), fmt::format("{:+.0f} %", 100.0 * point["error"].get<double>())},
                table);
    return folded("Prediction against measurement, point by point", table.html());
}

std::string break_even_table(const Json& prediction)
{
    if (prediction["break_even"].empty())
        return paragraph("No two strategies break even within a thousandth to a hundred times these rays.");
    HtmlTable table({"primary rays|a frame", "faster with|fewer", "faster with|more"});
    for (const Json& entry : prediction["break_even"])
        table.add({whole(entry["rays"]), entry["below"], entry["above"]});
    return folded("Where each two strategies break even, on this machine's threads", table.html());
}

}  // namespace

std::string prediction_section(const Json& results)
{
    const Json& prediction = results["prediction"];
    const Json& by_threads = prediction["median_error_threads"];
    const std::string parts = by_threads.is_null() ? ""
                                                   : fmt::format(" ({} with fewer rays on one thread, {} on {})",
                                                                 percent(prediction["median_error_one_thread"]),
                                                                 percent(by_threads), prediction["threads"].dump());
    std::string text = paragraph(
        fmt::format(
            "The law: total = update (not shared) + (update (shared) + what any rays take + ns per primary ray x "
            "rays) / processors. Held against {} measured points it is off by {} in the median{} and by {} at "
            "most: strategies that are closer to each other than that it does not tell apart.",
            prediction["checked_points"].dump(), percent(prediction["median_error"]), parts,
            percent(prediction["largest_error"])),
        "plain");
    text += reign_list(prediction["fastest_by_processors"], "number of processors, at all rays");
    text += reign_list(prediction["fastest_by_rays"],
                       "primary rays a frame, on this machine's threads (they break even in between)");
    text += break_even_table(prediction) + law_table(results);
    text += paragraph(fmt::format(
        "Fitted to whole frames of {} primary rays and to the fewest rays, on one thread, and to the update on all "
        "threads. What any rays take is the same for few and many: building, walks that rays share. What springs from "
        "primary rays, shadows, reflections and shading, is in their ns. Balance is the number of processors at which "
        "tracing takes no longer than the update does on one: more hardly help where it is not shared. Measured points "
        "are the least of three rounds.",
        whole(prediction["rays"])));
    return text + check_table(results);
}

}  // namespace firstray::compare
