#include "bench/compare/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/compare/text.h"

namespace firstray::compare {
namespace {

constexpr double wide_range = 10.0;  // beyond it a logarithmic axis shows more

/// A strategy looks the same in all charts.
int style_of(const Json& results, const std::string& name)
{
    int style = 0;
    for (const Json& strategy : results["strategies"]) {
        if (strategy["name"] == name) return style;
        ++style;
    }
    return style;
}

void choose_y_axis(Chart& chart)
{
    double low = 0.0, high = 0.0;
    for (const Series& series : chart.series)
        for (const double y : series.y) {
            if (y > 0.0) low = low == 0.0 ? y : std::min(low, y);
            high = std::max(high, y);
        }
    chart.y_log = low > 0.0 && high > wide_range * low;
}

/// Moves the series a little to the left and right of each other, so that their bars do not hide one another.
void set_apart(Chart& chart)
{
    if (chart.series.empty() || chart.series[0].x.size() < 2) return;
    const double range = chart.series[0].x.back() - chart.series[0].x.front();
    const double middle = 0.5 * static_cast<double>(chart.series.size() - 1);
    for (std::size_t i = 0; i < chart.series.size(); ++i)
        for (double& x : chart.series[i].x) x += 0.008 * range * (static_cast<double>(i) - middle);
}

/// A rectangle in parts of a chart's width and height.
struct Patch {
    double left, right, low, high;
    bool meets(const Patch& other) const
    {
        return left < other.right && other.left < right && low < other.high && other.low < high;
    }
};

/// Where a label would be printed.
Patch patch_of(const Label& label, double x, double y)
{
    constexpr double letter = 0.0155, height = 0.05, gap = 0.015;  // of the chart
    const double width = letter * static_cast<double>(label.text.size());
    const double left = label.is_left ? x - gap - width : x + gap, low = label.is_below ? y - gap - height : y + gap;
    return {left, left + width, low, low + height};
}

/// Finds places in a chart for labels.
class Labeller {
public:
    explicit Labeller(const Chart& chart) : ends_(log_range(chart))
    {
        constexpr double half = 0.012;  // of a marker
        for (const Series& series : chart.series)
            for (const double y : series.y) top_ = std::max(top_, y);
        for (const Series& series : chart.series)
            for (std::size_t i = 0; i < series.x.size(); ++i) {
                const double x = across(series.x[i]), y = series.y[i] / top_;
                taken_.push_back({x - half, x + half, y - half, y + half});
            }
    }

    /// The label at a corner of its point where it covers nothing, or an empty one.
    Label place(const std::string& text, double x, double y)
    {
        if (text.empty()) return {};
        for (const bool is_left : {false, true})
            for (const bool is_below : {false, true}) {
                const Label label{text, is_left, is_below};
                const Patch patch = patch_of(label, across(x), y / top_);
                if (!is_free(patch)) continue;
                taken_.push_back(patch);
                return label;
            }
        return {};
    }

private:
    double across(double x) const { return std::log(x / ends_.first) / std::log(ends_.second / ends_.first); }
    bool is_free(const Patch& patch) const
    {
        constexpr double highest = 1.1;  // gnuplot rounds its axis up
        return patch.left >= 0.0 && patch.right <= 1.0 && patch.low >= 0.0 && patch.high <= highest &&
               std::none_of(taken_.begin(), taken_.end(), [&](const Patch& other) { return patch.meets(other); });
    }

    std::pair<double, double> ends_;
    double top_ = 1e-12;
    std::vector<Patch> taken_;
};

/// Labels that find no place are left out: the table has all names.
void place_labels(Chart& chart)
{
    Labeller labeller(chart);
    const Series& points = chart.series.front();
    for (std::size_t i = 0; i < chart.labels.size(); ++i)
        chart.labels[i] = labeller.place(chart.labels[i].text, points.x[i], points.y[i]);
}

std::vector<double> values_of(const Json& rounds)
{
    std::vector<double> values;
    for (const Json& value : rounds) values.push_back(value);
    return values;
}

Chart by_frame(const Json& results, const char* key, Chart chart)
{
    chart.x_label = "frame";
    for (const Json& strategy : results["strategies"]) {
        if (strategy["times"].is_null()) continue;
        const std::string name = strategy["name"];
        Series series{.name = name, .style = style_of(results, name)};
        for (const Json& frame : strategy["frames"]) {
            const Spread spread = spread_of(values_of(frame[key]));
            series.x.push_back(frame["frame"]);
            series.y.push_back(spread.median);
            series.least.push_back(spread.least);
            series.most.push_back(spread.most);
        }
        chart.series.push_back(std::move(series));
    }
    set_apart(chart);
    choose_y_axis(chart);
    return chart;
}

bool has(const Json& results, const char* key)
{
    return results.contains(key) && !results[key].is_null();
}

}  // namespace

Chart update_chart(const Json& results)
{
    return by_frame(
        results, "update_ms",
        {.id = "update",
         .caption = "Update: what changing the structure takes before each frame, with the spread of the rounds",
         .y_label = "update, ms"});
}

Chart trace_chart(const Json& results)
{
    return by_frame(results, "trace_ms",
                    {.id = "trace",
                     .caption = "Trace: what the rays of each frame take, shading and lazy building included",
                     .y_label = "trace, ms"});
}

Chart rays_chart(const Json& results)
{
    Chart chart{
        .id = "rays",
        .caption = "The fewer pixels a frame traces, the more the update counts: trace (solid) and update (dashed)",
        .y_label = "ms per frame",
        .x_log = true,
        .y_log = true};
    if (!has(results, "sweep") || !has(results, "prediction")) return chart;
    chart.x_label = fmt::format("a frame's {} primary rays are divided by",
                                grouped(static_cast<std::uint64_t>(results["prediction"]["rays"].get<double>())));
    const int threads = results["settings"]["threads"];
    for (const Json& strategy : results["sweep"]["strategies"]) {
        const std::string name = strategy["name"];
        Series trace{.name = name, .style = style_of(results, name)},
            update{.name = "", .style = trace.style, .dashed = true};
        for (const Json& point : strategy["points"]) {
            if (point["threads"] != threads) continue;
            trace.x.push_back(point["turns"]);
            trace.y.push_back(point["trace_ms"]);
            update.x.push_back(point["turns"]);
            update.y.push_back(point["update_ms"]);
        }
        chart.series.push_back(std::move(trace));
        chart.series.push_back(std::move(update));
    }
    return chart;
}

Chart processors_chart(const Json& results)
{
    Chart chart{.id = "processors",
                .caption = "Predicted total time by number of processors: rays are shared, part of the update is not",
                .x_label = "processors",
                .y_label = "total, ms per frame",
                .x_log = true,
                .y_log = true};
    if (!has(results, "prediction")) return chart;
    for (const Json& law : results["prediction"]["strategies"]) {
        const std::string name = law["name"];
        Series series{.name = name, .style = style_of(results, name)};
        for (const Json& total : law["totals"]) {
            series.x.push_back(total["processors"]);
            series.y.push_back(total["total_ms"]);
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart frameless_chart(const Json& results)
{
    Chart chart{.id = "frameless",
                .caption = "Error of frameless rendering against whole frames of the same time",
                .x_label = "the number of pixels traced is divided by",
                .y_label = "RMSE of colours in [0, 1]",
                .x_log = true};
    if (!has(results, "frameless")) return chart;
    Series mean{.name = "compared frames", .style = 0}, worst{.name = "worst frame", .style = 1, .dashed = true};
    for (const Json& entry : results["frameless"]) {
        for (Series* series : {&mean, &worst}) series->x.push_back(entry["turns"]);
        mean.y.push_back(entry["image"]["rmse"]);
        worst.y.push_back(entry["worst_rmse"]);
    }
    if (!mean.x.empty()) chart.series = {std::move(mean), std::move(worst)};
    return chart;
}

Chart trade_chart(const Json& results)
{
    Chart chart{.id = "trade",
                .caption = "Time against error: settings to the lower left are better",
                .x_label = "total, ms per frame",
                .y_label = "RMSE against the reference",
                .x_log = true,
                .x_marks = false};
    if (!has(results, "trade")) return chart;
    Series all{.name = "settings", .style = 0, .points_only = true}, frontier{.name = "frontier", .style = 1},
        memory{.name = "memory only", .style = 6, .points_only = true};
    std::vector<std::pair<double, double>> best;
    for (const Json& setting : results["trade"]["settings"]) {
        if (!setting["fault"].get<std::string>().empty()) continue;
        Series& series = setting["is_orientation"].get<bool>() ? memory : all;
        series.x.push_back(setting["total_ms"]["median"]);
        series.y.push_back(setting["image"]["rmse"]);
        if (&series == &memory) continue;
        const bool is_best = setting["on_frontier"];
        chart.labels.push_back({is_best ? setting["name"].get<std::string>() : ""});
        if (is_best) best.emplace_back(series.x.back(), series.y.back());
    }
    std::sort(best.begin(), best.end());
    for (const auto& [x, y] : best) {
        frontier.x.push_back(x);
        frontier.y.push_back(y);
    }
    if (all.x.empty()) return chart;
    chart.series = {std::move(all), std::move(frontier), std::move(memory)};
    place_labels(chart);
    return chart;
}

}  // namespace firstray::compare
