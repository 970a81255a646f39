#include "bench/compare/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// Leaves out labels that would be printed over others: the table has all names.
void thin_labels(const Series& series, std::vector<std::string>& labels)
{
    constexpr double label_width = 0.4, label_height = 0.06;  // of the chart
    if (series.x.empty()) return;
    const auto [left, right] = std::minmax_element(series.x.begin(), series.x.end());
    const double log_range = std::log(std::max(*right / *left, 1.01));
    const double y_range = std::max(*std::max_element(series.y.begin(), series.y.end()), 1e-12);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i].empty()) continue;
        const bool is_free = std::none_of(kept.begin(), kept.end(), [&](std::size_t k) {
            return std::abs(std::log(series.x[i] / series.x[k])) < label_width * log_range &&
                   std::abs(series.y[i] - series.y[k]) < label_height * y_range;
        });
        if (is_free)
            kept.push_back(i);
        else
            labels[i].clear();
    }
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
        .x_label = "the number of pixels is divided by",
        .y_label = "ms per frame",
        .x_log = true,
        .y_log = true};
    if (!has(results, "sweep")) return chart;
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
                .x_label = "the number of pixels is divided by",
                .y_label = "RMSE of colours in [0, 1]",
                .x_log = true};
    if (!has(results, "frameless")) return chart;
    Series mean{.name = "all compared frames", .style = 0},
        worst{.name = "the worst of them", .style = 1, .dashed = true};
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
    Series all{.name = "settings", .style = 0, .points_only = true}, frontier{.name = "frontier", .style = 1};
    std::vector<std::pair<double, double>> best;
    for (const Json& setting : results["trade"]["settings"]) {
        if (!setting["fault"].get<std::string>().empty()) continue;
        all.x.push_back(setting["total_ms"]["median"]);
        all.y.push_back(setting["image"]["rmse"]);
        chart.labels.push_back(setting["on_frontier"].get<bool>() ? setting["name"].get<std::string>() : "");
        if (setting["on_frontier"].get<bool>()) best.emplace_back(all.x.back(), all.y.back());
    }
    std::sort(best.begin(), best.end());
    for (const auto& [x, y] : best) {
        frontier.x.push_back(x);
        frontier.y.push_back(y);
    }
    thin_labels(all, chart.labels);
    if (!all.x.empty()) chart.series = {std::move(all), std::move(frontier)};
    return chart;
}

}  // namespace firstray::compare
