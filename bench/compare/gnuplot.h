#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace firstray::compare {

/// A line of a chart with its spread. A value that is not finite is a gap.
struct Series {
    std::string name;
    int style = 0;  ///< decides colour, dash and marker
    bool dashed = false, points_only = false;
    std::vector<double> x{}, y{}, least{}, most{};  ///< the last two empty: no spread
};

/// Beside a point; empty for none.
struct Label {
    std::string text;
    bool is_left = false, is_below = false;  ///< of the point; otherwise right and above
};

/// What to draw.
struct Chart {
    std::string id;       ///< letters and digits, another for every chart of a page
    std::string caption;  ///< plain text
    std::string x_label{}, y_label{};
    bool x_log = false, y_log = false;
    bool x_marks = true;  ///< a logarithmic x axis is marked at the points of the first series
    std::vector<Series> series{};
    std::vector<Label> labels{};  ///< at the points of the first series, where there are any
};

/// Where a logarithmic x axis begins and ends.
std::pair<double, double> log_range(const Chart& chart);

/// The commands that make gnuplot draw the chart into `file`.
std::string gnuplot_script(const Chart& chart, const std::string& file);

/// The chart as an SVG element for a page, its lines of text in the page's colour; nothing where there is no gnuplot or
/// it fails.
std::optional<std::string> draw_chart(const Chart& chart);

/// For tests: what gnuplot wrote, made fit for a page.
std::string fit_for_page(std::string svg, const Chart& chart);

}  // namespace firstray::compare
