#pragma once
#include <optional>
#include <string>
#include <vector>

namespace firstray::compare {

/// What a strategy's frame takes, as a law: the update is partly shared by processors, part of the tracing is the same
/// however few rays there are (building, walks that rays share), and all else is in proportion to the rays. "Rays" are
/// primary rays; those that spring from them are in `ns_per_ray`. One processor's time.
struct Cost {
    double update_serial_ms = 0.0, update_shared_ms = 0.0;
    double fixed_ms = 0.0;
    double ns_per_ray = 0.0;
};

/// One measured point.
struct Point {
    int threads = 1;
    double rays = 0.0;  ///< primary rays a frame
    double update_ms = 0.0, trace_ms = 0.0;
    double build_ms = 0.0;  ///< part of trace, summed over threads
    double total_ms() const { return update_ms + trace_ms; }
};

/// Fits the law to a point on one thread. Where there is one on several threads, the update's serial share follows by
/// Amdahl's law; where there is one of few rays, what tracing takes without regard to rays follows from the line
/// through both, else it is what was built.
/// alone  on one thread, rays > 0
/// few    on one thread, fewer rays
/// source G. Amdahl, "Validity of the single processor approach to achieving large scale computing capabilities", 1967
Cost fit_cost(const Point& alone, const std::optional<Point>& shared, const std::optional<Point>& few = {});

double predicted_update_ms(const Cost& cost, double processors);
double predicted_trace_ms(const Cost& cost, double processors, double rays);
double predicted_total_ms(const Cost& cost, double processors, double rays);

/// Number of processors at which tracing takes no longer than updating: more of them hardly help (the paper's 16 and
/// 128). The update is taken to be serial, as there. Infinity without an update.
double balanced_processors(const Cost& cost, double rays);

/// Rays at which both take the same time on so many processors; nothing where one is faster throughout.
std::optional<double> break_even_rays(const Cost& a, const Cost& b, double processors);

/// Who is fastest over a range.
struct Reign {
    std::size_t fastest = 0;  ///< position among the costs
    double from = 0.0, to = 0.0;
};

/// Over numbers of processors from 1 to `most`, whole ones.
std::vector<Reign> fastest_by_processors(const std::vector<Cost>& costs, double rays, int most);
/// Over rays a frame from `from` to `to`.
std::vector<Reign> fastest_by_rays(const std::vector<Cost>& costs, double processors, double from, double to);

}  // namespace firstray::compare
