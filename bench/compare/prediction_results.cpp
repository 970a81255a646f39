#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/compare/prediction.h"
#include "bench/compare/results.h"
#include "bench/compare/sweep.h"
#include "bench/compare/verdict.h"

namespace firstray::compare {
namespace {

constexpr int most_processors = 128;         // the paper's
constexpr double fewest_of_all_rays = 1e-3;  // of the frame's
constexpr double most_of_all_rays = 100.0;

Point point_of(const Json& json)
{
    return {.threads = json["threads"],
            .rays = json["rays"],
            .update_ms = json["update_ms"],
            .trace_ms = json["trace_ms"],
            .build_ms = json["build_ms"]};
}

/// The point on so many threads that traces every pixel.
std::optional<Point> whole_frame(const Json& points, bool alone)
{
    for (const Json& point : points)
        if (point["turns"] == 1 && (point["threads"] == 1) == alone) return point_of(point);
    return std::nullopt;
}

/// The point on one thread that traces the fewest pixels.
Json fewest_rays(const Json& points)
{
    Json fewest;
    for (const Json& point : points)
        if (point["threads"] == 1 && (fewest.is_null() || point["turns"] > fewest["turns"])) fewest = point;
    return fewest;
}

/// Points that the law was not fitted to, and how far it is off there.
Json checked_points(const Json& points, const Cost& cost)
{
    const Json fewest = fewest_rays(points);
    Json checked = Json::array();
    for (const Json& json : points) {
        const Point point = point_of(json);
        const bool is_fitted_to = point.threads == 1 && (json["turns"] == 1 || json["turns"] == fewest["turns"]);
        if (is_fitted_to) continue;
        const double predicted = predicted_total_ms(cost, point.threads, point.rays);
        checked.push_back({{"threads", point.threads},
                           {"turns", json["turns"]},
                           {"rays", point.rays},
                           {"predicted_ms", predicted},
                           {"measured_ms", point.total_ms()},
                           {"error", predicted / point.total_ms() - 1.0}});
    }
    return checked;
}

/// Rays of each kind that spring from a primary ray in the frames that were swept, and what searching for one takes on
/// one thread.
Json kinds_of(const Json& results, const Json& measured)
{
    const auto rays = [&](const char* kind) {
        double sum = 0.0;
        for (const Json& frame : results["frames"])
            for (const Json& swept : results["sweep"]["frames"])
                if (frame["frame"] == swept) sum += frame["asked"][kind].get<double>();
        return sum;
    };
    Json kinds = Json::object();
    for (const char* kind : {"primary", "shadow", "secondary"})
        kinds[kind] = {{"per_primary", rays(kind) / std::max(1.0, rays("primary"))},
                       {"ns", measured["ns_per_ray"][kind]}};
    return kinds;
}

Json totals_of(const Cost& cost, double rays)
{
    Json totals = Json::array();
    for (int processors = 1; processors <= most_processors; processors *= 2)
        totals.push_back({{"processors", processors}, {"total_ms", predicted_total_ms(cost, processors, rays)}});
    return totals;
}

Json law_of(const Json& results, const Json& measured, const Cost& cost, double rays)
{
    const Json kinds = kinds_of(results, measured);
    double searching = 0.0;
    for (const Json& kind : kinds) searching += kind["per_primary"].get<double>() * kind["ns"].get<double>();
    const double balance = balanced_processors(cost, rays);
    return {{"name", measured["name"]},
            {"update_serial_ms", cost.update_serial_ms},
            {"update_shared_ms", cost.update_shared_ms},
            {"fixed_ms", cost.fixed_ms},
            {"ns_per_primary_ray", cost.ns_per_ray},
            {"kinds", kinds},
            {"other_ns_per_primary_ray", 1e6 * cost.fixed_ms / rays + cost.ns_per_ray - searching},
            {"balanced_processors", std::isfinite(balance) ? Json(balance) : Json(nullptr)},
            {"totals", totals_of(cost, rays)},
            {"checked", checked_points(measured["points"], cost)}};
}

Json reigns_of(const std::vector<Reign>& reigns, const std::vector<std::string>& names)
{
    Json json = Json::array();
    for (const Reign& reign : reigns)
        json.push_back({{"fastest", names[reign.fastest]}, {"from", reign.from}, {"to", reign.to}});
    return json;
}

Json break_evens(const std::vector<Cost>& costs, const std::vector<std::string>& names, int threads, double rays)
{
    Json json = Json::array();
    for (std::size_t i = 0; i < costs.size(); ++i)
        for (std::size_t k = i + 1; k < costs.size(); ++k) {
            const auto at = break_even_rays(costs[i], costs[k], threads);
            if (!at || *at < fewest_of_all_rays * rays || *at > most_of_all_rays * rays) continue;
            const bool first_is_faster_below = costs[i].ns_per_ray > costs[k].ns_per_ray;
            json.push_back({{"below", names[first_is_faster_below ? i : k]},
                            {"above", names[first_is_faster_below ? k : i]},
                            {"rays", *at}});
        }
    std::sort(json.begin(), json.end(), [](const Json& a, const Json& b) { return a["rays"] < b["rays"]; });
    return json;
}

/// Of all checked points: the median and the largest size of the error, and the medians of those on one thread, which
/// differ by rays, and on several.
void add_errors(Json& prediction)
{
    std::vector<double> all, alone, shared;
    for (const Json& law : prediction["strategies"])
        for (const Json& point : law["checked"]) {
            all.push_back(std::abs(point["error"].get<double>()));
            (point["threads"] == 1 ? alone : shared).push_back(all.back());
        }
    prediction["checked_points"] = all.size();
    prediction["median_error"] = quantile(all, 0.5);
    prediction["median_error_one_thread"] = quantile(alone, 0.5);
    prediction["median_error_threads"] = shared.empty() ? Json(nullptr) : Json(quantile(shared, 0.5));
    prediction["largest_error"] = quantile(all, 1.0);
}

}  // namespace

Json prediction_of(const Json& results)
{
    std::vector<Cost> costs;
    std::vector<std::string> names;  // of those whose answers are right: the others have laws, but win nothing
    double rays = 0.0;
    const int threads = results["settings"]["threads"];
    Json prediction = {{"threads", threads}, {"rays", nullptr}, {"strategies", Json::array()}};
    for (const Json& measured : results["sweep"]["strategies"]) {
        const Json* strategy = find_row(results, measured["name"]);
        if (!strategy || (*strategy)["times"].is_null()) continue;
        const Json& points = measured["points"];
        const std::optional<Point> alone = whole_frame(points, true);
        if (!alone || alone->rays <= 0.0) continue;
        rays = alone->rays;
        const Cost cost = fit_cost(*alone, whole_frame(points, false), point_of(fewest_rays(points)));
        prediction["strategies"].push_back(law_of(results, measured, cost, rays));
        if (!counts(*strategy)) continue;
        costs.push_back(cost);
        names.push_back(measured["name"]);
    }
    prediction["rays"] = rays;
    prediction["fastest_by_processors"] = reigns_of(fastest_by_processors(costs, rays, most_processors), names);
    prediction["fastest_by_rays"] =
        reigns_of(fastest_by_rays(costs, threads, fewest_of_all_rays * rays, most_of_all_rays * rays), names);
    prediction["break_even"] = break_evens(costs, names, threads, rays);
    add_errors(prediction);
    return prediction;
}

}  // namespace firstray::compare
