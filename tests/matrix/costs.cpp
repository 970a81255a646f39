// T18 to T20: what `firstray compare` tells of precision and frameless rendering has its accuracy beside it; what
// robust costs over fast.
#include <fmt/format.h>

#include <map>

#include "tests/matrix/shoot.h"
#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

namespace firstray::matrix {
namespace {

constexpr const char* scene = "scenes/everything.aff";

bool is_number(const nlohmann::json& row, const char* key)
{
    return row.contains(key) && (row[key].is_number() || (row[key].is_null() && std::string(key) == "psnr"));
}

bool has_accuracy(const nlohmann::json& hits, const nlohmann::json& image)
{
    return is_number(hits, "missed_per_million") && is_number(hits, "false_per_million") &&
           is_number(hits, "t_error_p999") && is_number(image, "rmse") && is_number(image, "psnr") &&
           is_number(image, "largest") && is_number(image, "differing_share");
}

nlohmann::json compared(Matrix& matrix)
{
    const test::TempFolder folder;
    const bool is_quick = matrix.part() < 1.0;
    const test::Outcome outcome = test::call_line(
        fmt::format("compare {} --strategies grid,obb,lazy,adaptive --frames 12-36:12 --size {} --repeat {} --trade "
                    "--frameless 1,1/2,1/4,1/8,1/16 --progress never --report {}",
                    scene, is_quick ? "48x36" : "160x120", is_quick ? 1 : 3, (folder.path() / "report").string()));
    return outcome.code == 0 ? test::read_json(folder.path() / "report/results.json") : nlohmann::json();
}

void trade_row(Matrix& matrix, const nlohmann::json& results)
{
    std::uint64_t rows = 0, whole = 0;
    for (const auto& strategy : results["strategies"]) {
        ++rows;
        whole += has_accuracy(strategy["accuracy"], strategy["accuracy"]["image"]);
    }
    for (const auto& setting : results["trade"]["settings"]) {
        ++rows;
        whole += setting["fault"] == "" && has_accuracy(setting["hits"], setting["image"]);
    }
    matrix.add({.id = "T18",
                .tried = fmt::format(
                    "compare {} --trade: strategies and settings with missed and false hits, error of t, RMSE, "
                    "PSNR, largest difference and share of differing pixels beside their times",
                    scene),
                .n = rows,
                .result = fmt::format("{} of {}", whole, rows),
                .target = "all",
                .met = rows > 10 && whole == rows,
                .known_miss = {}});
}

void frameless_row(Matrix& matrix, const nlohmann::json& results)
{
    std::string errors, worst;
    std::uint64_t unlike = 1, pixels = 0, shares = 0;
    for (const auto& share : results["frameless"]) {
        const auto& image = share["image"];
        if (share["turns"] == 1) unlike = image["unlike"];
        pixels += image["pixels"].get<std::uint64_t>();
        const char* const slash = shares++ == 0 ? "" : "/";
        errors += fmt::format("{}{:.3f}", slash, image["rmse"].get<double>());
        worst += fmt::format("{}{:.3f}", slash, share["worst_rmse"].get<double>());
    }
    matrix.add(
        {.id = "T20",
         .tried = "frameless 1, 1/2, 1/4, 1/8, 1/16: pixels of 1 that differ from whole frames; RMSE, worst frame's",
         .n = pixels,
         .result = fmt::format("{}; {}, {}", unlike, errors, worst),
         .target = "0; reported",
         .met = unlike == 0 && shares == 5,
         .known_miss = {}});
}

/// Milliseconds to trace the frames of a short animation.
double trace_ms(const std::string& precision, const std::string& strategy, bool is_quick)
{
    const test::TempFolder folder;
    const test::Outcome outcome =
        test::call_line(fmt::format("render {} --frames 0-45:15 --size {} --depth 1 --strategy {} --precision {} "
                                    "--threads 1 --progress never --stats {} "
                                    "--output {}",
                                    scene, is_quick ? "80x60" : "480x360", strategy, precision,
                                    (folder.path() / "stats.json").string(), (folder.path() / "x.####.png").string()));
    if (outcome.code != 0) throw std::runtime_error(outcome.err);
    double ms = 0.0;
    const nlohmann::json stats = test::read_json(folder.path() / "stats.json");
    for (const auto& frame : stats["frames"]) ms += frame["trace_ms"].get<double>();
    return ms;
}

}  // namespace

void compare_rows(Matrix& matrix)
{
    const nlohmann::json results = compared(matrix);
    if (results.is_null()) throw std::runtime_error("firstray compare failed");
    trade_row(matrix, results);
    frameless_row(matrix, results);
}

void cost_rows(Matrix& matrix)
{
    std::string ratios;
    double most = 0.0;
    const bool is_quick = matrix.part() < 1.0;
    const int rounds = is_quick ? 1 : 7;
    for (const std::string strategy : {"grid", "obb", "lazy"}) {
        std::map<std::string, double> least;
        for (int round = 0; round < rounds; ++round)
            for (const std::string precision : {"fast", "robust", "double"}) {
                const double ms = trace_ms(precision, strategy, is_quick);
                least[precision] = least.contains(precision) ? std::min(least[precision], ms) : ms;
            }
        const double ratio = least["robust"] / least["fast"];
        most = std::max(most, ratio);
        ratios += fmt::format("{}{} {:.2f} ({:.1f})", ratios.empty() ? "" : ", ", strategy, ratio,
                              least["double"] / least["fast"]);
    }
    matrix.add({.id = "T19",
                .tried = fmt::format(
                    "time to trace four frames of {}, least of {} rounds, one thread: robust (double) over fast", scene,
                    rounds),
                .n = static_cast<std::uint64_t>(rounds) * 9,
                .result = ratios,
                .target = "reported (1.15 was hoped for)",
                .known_miss = {}});
}

}  // namespace firstray::matrix
