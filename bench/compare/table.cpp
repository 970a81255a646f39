#include "bench/compare/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bench/compare/text.h"
#include "bench/compare/verdict.h"

namespace firstray::compare {
namespace {

constexpr std::size_t columns = 14;
using Line = std::array<std::string, columns>;

const Line headings = {"strategy", "update ms", "trace ms", "total ms", "[least most]", "alone ms", "MB",
                       "missed/M", "false/M",   "t error",  "RMSE",     "PSNR",         "largest",  "differ %"};

Line line_of(const Json& strategy)
{
    Line line;
    line[0] = strategy["name"];
    const Json &times = strategy["times"], &accuracy = strategy["accuracy"], &image = accuracy["image"];
    if (times.is_null()) return line;
    const auto median = [&](const char* key) { return short_number(times[key]["median"]); };
    const Json& total = times["total_ms"];
    line[1] = median("update_ms");
    line[2] = median("trace_ms");
    line[3] = median("total_ms");
    line[4] = fmt::format("[{} {}]", short_number(total["least"]), short_number(total["most"]));
    line[5] = median("structure_ms");
    double bytes = 0.0;
    for (const Json& frame : strategy["frames"]) bytes = std::max(bytes, frame["structure"]["bytes"].get<double>());
    line[6] = short_number(1e-6 * bytes);
    line[7] = short_number(accuracy["missed_per_million"]);
    line[8] = short_number(accuracy["false_per_million"]);
    line[9] = short_number(accuracy["t_error_p999"]);
    line[10] = short_number(image["rmse"]);
    line[11] = image["psnr"].is_null() ? "inf" : fmt::format("{:.1f}", image["psnr"].get<double>());
    line[12] = short_number(image["largest"]);
    line[13] = short_number(100.0 * image["differing_share"].get<double>());
    return line;
}

std::string aligned(const std::vector<Line>& lines, const std::vector<std::string>& remarks)
{
    std::array<std::size_t, columns> widths{};
    for (const Line& line : lines)
        for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], line[c].size());
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string row = fmt::format("{:<{}}", lines[i][0], widths[0]);
        if (lines[i][1].empty())
            row += "  " + remarks[i];
        else {
            for (std::size_t c = 1; c < columns; ++c) row += fmt::format("  {:>{}}", lines[i][c], widths[c]);
            if (!remarks[i].empty()) row += "  " + remarks[i];
        }
        text += row + "\n";
    }
    return text;
}

std::string answer_line(const Json& winner, const char* clear, const char* unclear)
{
    return fmt::format("{}: {}\n", winner["level"].empty() ? clear : unclear, winner["sentence"].get<std::string>());
}

}  // namespace

std::uint64_t checked_rays(const Json& results)
{
    std::uint64_t rays = 0;
    for (const Json& strategy : results["strategies"])
        rays = std::max(rays, strategy["accuracy"]["rays"].get<std::uint64_t>());
    return rays;
}

std::string remark(const Json& strategy)
{
    const std::string status = strategy["status"];
    if (status == "failed") return "failed: " + strategy["reason"].get<std::string>();
    if (status == "unmeasured") return "not timed";
    if (status == "differs") return "!! disagrees with the reference";
    return "";
}

std::string setting_line(const Json& results)
{
    const Json& settings = results["settings"];
    const auto plural = [](std::int64_t count, const char* word) {
        return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
    };
    return fmt::format("{} of {}, {}x{}, depth {}, {}, {}, {}, {}",
                       plural(static_cast<std::int64_t>(results["frames"].size()), "frame"),
                       results["scene"]["name"].get<std::string>(), settings["size"][0].dump(),
                       settings["size"][1].dump(), settings["depth"].dump(), plural(settings["spp"], "sample"),
                       settings["precision"].get<std::string>(), plural(settings["threads"], "thread"),
                       plural(settings["rounds"], "round"));
}

std::string summary_table(const Json& results)
{
    std::vector<Line> lines = {headings};
    std::vector<std::string> remarks = {""};
    for (const Json& strategy : results["strategies"]) {
        lines.push_back(line_of(strategy));
        remarks.push_back(remark(strategy));
    }
    std::string text = setting_line(results) + (results["interrupted"].get<bool>() ? " (interrupted)" : "") + "\n";
    text += aligned(lines, remarks);
    text += fmt::format(
        "means over the frames, medians of the rounds; alone: searching the structure for the frame's rays, nothing "
        "else; hits are checked against list on {} rays (t error: 99.9th percentile), pictures against {}\n",
        grouped(checked_rays(results)), results["settings"]["reference"].get<std::string>());
    if (const std::string load = load_warning(results); !load.empty()) text += load + "\n";
    const Json verdict = verdict_of(results);
    if (verdict["all"].is_null()) return text;
    text += answer_line(verdict["all"], "fastest", "no clear winner");
    if (!verdict["own"].is_null() && verdict["own"]["fastest"] != verdict["all"]["fastest"])
        text += answer_line(verdict["own"], "of our own", "of our own, no clear winner");
    if (!verdict["faster_but_marked"].empty())
        text += "faster, but marked !!: " + listed(verdict["faster_but_marked"]) + "\n";
    return text;
}

}  // namespace firstray::compare
