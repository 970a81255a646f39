#include "bench/compare/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/compare/html.h"
#include "bench/compare/report_accuracy.h"
#include "bench/compare/table.h"
#include "bench/compare/text.h"
#include "bench/compare/verdict.h"

namespace firstray::compare {
namespace {

/// How many rays everyone's t was compared on.
std::uint64_t checked_hits(const Json& results)
{
    std::uint64_t hits = 0;
    for (const Json& strategy : results["strategies"])
        hits = std::max(hits, strategy["accuracy"]["hits"].get<std::uint64_t>());
    return hits;
}

std::string median(const Json& spread)
{
    return short_number(spread["median"]);
}

std::string total_table(const Json& results)
{
    HtmlTable table(with_accuracy(results, {"strategy", "agrees", "update,|ms", "trace,|ms", "building|in it, ms",
                                            "total,|ms", "least to most|of the rounds"}));
    for (const Json& strategy : results["strategies"]) {
        const Json& times = strategy["times"];
        if (times.is_null()) {
            add_speed_row(strategy, {}, table);
            continue;
        }
        const Json& total = times["total_ms"];
        add_speed_row(strategy,
                      {agreement_word(strategy), median(times["update_ms"]), median(times["trace_ms"]),
                       median(times["lazy_build_ms"]), median(total),
                       fmt::format("{} to {}", short_number(total["least"]), short_number(total["most"]))},
                      table);
    }
    return table.html();
}

std::string alone_table(const Json& results)
{
    HtmlTable table(
        with_accuracy(results, {"strategy", "structure|alone, ms", "ns per|primary", "shadow", "other ray"}));
    for (const Json& strategy : results["strategies"]) {
        const Json& times = strategy["times"];
        if (times.is_null()) continue;
        const Json& ns = times["ns_per_ray"];
        add_speed_row(
            strategy,
            {median(times["structure_ms"]), median(ns["primary"]), median(ns["shadow"]), median(ns["secondary"])},
            table);
    }
    return table.html();
}

}  // namespace

/// Which rays the wrong hits of strategies are of.
std::string wrong_hits(const Json& results)
{
    std::string text;
    for (const Json& strategy : results["strategies"]) {
        const Json& wrong = strategy["accuracy"]["wrong_by_kind"];
        const auto count = [&](const char* kind) { return wrong[kind].get<std::uint64_t>(); };
        if (count("primary") + count("shadow") + count("secondary") == 0) continue;
        text += paragraph(
            fmt::format("{}: of its missed and false hits {} are of primary, {} of shadow and {} of other rays.",
                        strategy["name"].get<std::string>(), grouped(count("primary")), grouped(count("shadow")),
                        grouped(count("secondary"))));
    }
    return text;
}

/// What marks mean: the rows that were not timed tell why themselves.
std::string remarks(const Json& results)
{
    std::string text;
    for (const Json& strategy : results["strategies"])
        if (!strategy["times"].is_null() && !remark(strategy).empty())
            text += "<p class=\"warning\">" + escaped(strategy["name"].get<std::string>() + ": " + remark(strategy)) +
                    "</p>\n";
    return text;
}

std::string summary_section(const Json& results)
{
    return total_table(results) + remarks(results) + wrong_hits(results) +
           paragraph(fmt::format(
               "Means over the frames, medians over the rounds; strategies took turns frame by frame. Trace has "
               "shading, textures and lazy building in it; building in it is added up over threads. Hits are compared "
               "with list, which tests every primitive: missed and false ones per million (M) of so many rays; 0 of N "
               "means less than 3/N with 95 % confidence. The error of t is relative, over {} hits. Pictures, of "
               "colours in [0, 1], are compared with {}'s; pixels differ when a channel does by more than half of "
               "1/255.",
               grouped(checked_hits(results)), results["settings"]["reference"].get<std::string>())) +
           "<h3>The structure alone</h3>\n" + alone_table(results) +
           paragraph(
               "The frame's rays asked again of the structure as it then stands, and nothing else: ns are a "
               "thread's, ms are all threads'. Other rays are reflected and transmitted ones.");
}

std::string structure_section(const Json& results)
{
    HtmlTable table({"strategy", "grids", "subgrids", "filled|voxels", "built by rays|this frame", "kept from|before",
                     "never|needed", "references per|primitive", "largest|list", "regridded|by the update", "memory",
                     "at most"});
    for (const Json& strategy : results["strategies"]) {
        if (strategy["frames"].empty()) continue;
        const Json& s = strategy["frames"].back()["structure"];
        const bool is_told = s["references"].get<std::uint64_t>() > 0;
        const auto count = [&](const char* key) { return is_told ? grouped(s[key].get<std::uint64_t>()) : "–"; };
        const auto built = s["built_voxels"].get<std::uint64_t>(), kept = s["kept_voxels"].get<std::uint64_t>();
        const auto filled = s["filled_voxels"].get<std::uint64_t>();
        const bool is_lazy = built > 0;
        const double primitives = std::max(1.0, s["primitives"].get<double>());
        table.add({strategy["name"], count("grids"), count("subgrids"), count("filled_voxels"),
                   is_lazy ? grouped(built - std::min(kept, built)) : "–", is_lazy ? grouped(kept) : "–",
                   is_lazy ? grouped(filled - std::min(built, filled)) : "–",
                   is_told ? short_number(s["references"].get<double>() / primitives) : "–", count("largest_list"),
                   count("regridded"), megabytes(s["bytes"]), megabytes(s["peak_bytes"])});
    }
    return table.html() + paragraph(
                              "After the last frame of the last round. Voxels are told of structures that build them "
                              "when a ray enters; those of subgrids are not in that count.");
}

std::string frameless_section(const Json& results)
{
    HtmlTable table({"pixels|divided by", "RMSE", "worst frame's", "PSNR, dB", "largest|difference",
                     "pixels that|differ", "another hue|(Yee)", "pixels|compared", "frames|compared", ""});
    for (const Json& entry : results["frameless"]) {
        const Json& image = entry["image"];
        const double perceived = image["perceived"].get<double>() / std::max(1.0, image["pixels"].get<double>());
        table.add({entry["turns"].dump(), short_number(image["rmse"]), short_number(entry["worst_rmse"]),
                   decibels(image["psnr"]), short_number(image["largest"]), percent(image["differing_share"]),
                   percent(perceived), grouped(image["pixels"]), std::to_string(entry["frames"].size()),
                   entry["is_refreshed"].get<bool>() ? "" : "the animation is too short for all pixels"});
    }
    return table.html() +
           paragraph(
               "Frames in a row; the last ones, when every pixel has been traced anew, are compared with whole frames "
               "of the same times. The error is lag, not noise. It does not depend on the strategy; times are in the "
               "chart of fewer rays.");
}

std::string method_section(const Json& results)
{
    const Json &machine = results["machine"], &scene = results["scene"];
    std::string text = "<ul>\n";
    const auto item = [&](const std::string& line) { text += "<li>" + escaped(line) + "</li>\n"; };
    item(fmt::format("Scene: {}, {} primitives in {} groups, {} lights, {} frames.", scene["file"].get<std::string>(),
                     grouped(scene["primitives"]), grouped(scene["groups"]), scene["lights"].dump(),
                     scene["frames"].dump()));
    item(fmt::format("Machine: {}, {} threads, {}.", machine["cpu"].get<std::string>(), machine["threads"].dump(),
                     machine["instruction_set"].get<std::string>()));
    std::string versions = fmt::format("firstray {}", machine["version"].get<std::string>());
    for (const auto& [peer, version] : machine["peers"].items())
        versions += fmt::format(", {} {}", peer, version.get<std::string>());
    item(fmt::format("{}; {}; {}; {}.", versions, machine["libraries"].get<std::string>(),
                     machine["compiler"].get<std::string>(), results["created"].get<std::string>()));
    text += "<li>Command: <code>" + escaped(results["command"].get<std::string>()) + "</code></li>\n";
    item(
        "Every frame was first rendered and checked by every strategy, which warms up, then timed in rounds; a "
        "strategy is "
        "called faster where it was so in every round, three or more, and by a per cent in the median.");
    item(fmt::format("list took {} per ray on one thread.",
                     milliseconds(1e-6 * results["list_ns_per_ray"].get<double>())));
    for (const Json& strategy : results["strategies"])
        item(fmt::format("{}: {}", strategy["name"].get<std::string>(), strategy["summary"].get<std::string>()));
    return text + "</ul>\n" +
           paragraph("The same numbers, and every round's, are in results.json and results.csv beside this page.");
}

}  // namespace firstray::compare
