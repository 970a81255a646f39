#include "bench/compare/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace firstray::compare {
namespace {

/// Positions where the order of two costs may change, with both ends, ascending.
std::vector<double> borders(const std::vector<Cost>& costs, double processors, double from, double to)
{
    std::vector<double> at = {from, to};
    for (std::size_t i = 0; i < costs.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (const auto rays = break_even_rays(costs[i], costs[k], processors); rays && *rays > from && *rays < to)
                at.push_back(*rays);
    std::sort(at.begin(), at.end());
    return at;
}

std::size_t fastest(const std::vector<Cost>& costs, double processors, double rays)
{
    const auto total = [&](const Cost& cost) { return predicted_total_ms(cost, processors, rays); };
    const auto least =
        std::min_element(costs.begin(), costs.end(), [&](const Cost& a, const Cost& b) { return total(a) < total(b); });
    return static_cast<std::size_t>(least - costs.begin());
}

void extend(std::vector<Reign>& reigns, std::size_t fastest, double from, double to)
{
    if (!reigns.empty() && reigns.back().fastest == fastest)
        reigns.back().to = to;
    else
        reigns.push_back({fastest, from, to});
}

/// Where the line through what both points' rays took meets no rays at all.
double fixed_part(const Point& many, const Point& few)
{
    if (few.rays >= many.rays) return many.build_ms;
    const double per_ray = (many.trace_ms - few.trace_ms) / (many.rays - few.rays);
    return std::clamp(few.trace_ms - per_ray * few.rays, 0.0, many.trace_ms);
}

}  // namespace

Cost fit_cost(const Point& alone, const std::optional<Point>& shared, const std::optional<Point>& few)
{
    Cost cost;
    cost.fixed_ms = few ? fixed_part(alone, *few) : alone.build_ms;
    cost.ns_per_ray = 1e6 * std::max(0.0, alone.trace_ms - cost.fixed_ms) / alone.rays;
    cost.update_serial_ms = alone.update_ms;
    if (shared && shared->threads > 1) {
        const double n = shared->threads;
        const double serial = (n * shared->update_ms - alone.update_ms) / (n - 1.0);
        cost.update_serial_ms = std::clamp(serial, 0.0, alone.update_ms);
    }
    cost.update_shared_ms = alone.update_ms - cost.update_serial_ms;
    return cost;
}

double predicted_update_ms(const Cost& cost, double processors)
{
    return cost.update_serial_ms + cost.update_shared_ms / processors;
}

double predicted_trace_ms(const Cost& cost, double processors, double rays)
{
    return (cost.fixed_ms + 1e-6 * cost.ns_per_ray * rays) / processors;
}

double predicted_total_ms(const Cost& cost, double processors, double rays)
{
    return predicted_update_ms(cost, processors) + predicted_trace_ms(cost, processors, rays);
}

double balanced_processors(const Cost& cost, double rays)
{
    const double update = predicted_update_ms(cost, 1.0);
    if (update <= 0.0) return std::numeric_limits<double>::infinity();
    return predicted_trace_ms(cost, 1.0, rays) / update;
}

std::optional<double> break_even_rays(const Cost& a, const Cost& b, double processors)
{
    const double fixed = predicted_total_ms(b, processors, 0.0) - predicted_total_ms(a, processors, 0.0);
    const double per_ray = 1e-6 * (a.ns_per_ray - b.ns_per_ray) / processors;
    if (per_ray == 0.0 || fixed / per_ray <= 0.0) return std::nullopt;
    return fixed / per_ray;
}

std::vector<Reign> fastest_by_processors(const std::vector<Cost>& costs, double rays, int most)
{
    std::vector<Reign> reigns;
    if (costs.empty()) return reigns;
    for (int processors = 1; processors <= most; ++processors)
        extend(reigns, fastest(costs, processors, rays), processors, processors);
    return reigns;
}

std::vector<Reign> fastest_by_rays(const std::vector<Cost>& costs, double processors, double from, double to)
{
    std::vector<Reign> reigns;
    if (costs.empty()) return reigns;
    const std::vector<double> at = borders(costs, processors, from, to);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
        extend(reigns, fastest(costs, processors, 0.5 * (at[i] + at[i + 1])), at[i], at[i + 1]);
    return reigns;
}

}  // namespace firstray::compare
