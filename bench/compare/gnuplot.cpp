#include "bench/compare/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "bench/compare/html.h"

extern char** environ;

namespace firstray::compare {
namespace {

// Colours that the colour-blind can tell apart; markers tell them apart without colour. Black is the page's ink.
// Source: M. Okabe, K. Ito, "Color Universal Design", 2008, with grey for their yellow, which vanishes on white.
constexpr std::array<const char*, 8> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#8A8A8A", "#000000"};
constexpr std::array<int, 8> markers = {7, 5, 9, 11, 13, 6, 4, 12}, others = {6, 4, 8, 10, 12, 7, 5, 13};

std::string quoted(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result + "\"";
}

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN";
}

std::string data_block(const Series& series, std::size_t index)
{
    std::string text = fmt::format("$d{} << EOD\n", index);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        text += number(series.x[i]) + " " + number(series.y[i]);
        if (!series.least.empty()) text += " " + number(series.least[i]) + " " + number(series.most[i]);
        text += "\n";
    }
    return text + "EOD\n";
}

std::string plot_of(const Series& series, std::size_t index)
{
    const auto style = static_cast<std::size_t>(series.style);
    const std::size_t look = style % colours.size();
    const bool is_second_turn = style / colours.size() % 2 == 1;  // the same colours again
    const char* with = series.points_only ? "points" : series.least.empty() ? "linespoints" : "yerrorlines";
    std::string text = fmt::format("$d{} using {} with {} lc rgb {} pt {} ps 0.8 lw 1.8", index,
                                   series.least.empty() ? "1:2" : "1:2:3:4", with, quoted(colours[look]),
                                   is_second_turn ? others[look] : markers[look]);
    if (!series.points_only) text += series.dashed ? " dt 2" : is_second_turn ? " dt 4" : " dt 1";
    return text + (series.name.empty() ? " notitle" : " title " + quoted(series.name) + " noenhanced");
}

std::string label_of(const Chart& chart, std::size_t i)
{
    const Series& series = chart.series.front();
    const Label& label = chart.labels[i];
    return fmt::format("set label {} at {}, {} {} offset {}0.6,{}0.5 noenhanced font \",11\"\n", quoted(label.text),
                       number(series.x[i]), number(series.y[i]), label.is_left ? "right" : "left",
                       label.is_left ? "-" : "", label.is_below ? "-" : "");
}

/// The least and the largest x of all points.
std::pair<double, double> x_ends(const Chart& chart)
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Series& series : chart.series)
        for (const double x : series.x) {
            low = std::min(low, x);
            high = std::max(high, x);
        }
    return {low, high};
}

/// Wide enough for all points; a logarithmic axis has its marks at the first series' points.
std::string x_axis(const Chart& chart)
{
    const auto [low, high] = x_ends(chart);
    if (!(low < high)) return "";  // gnuplot's own, around a single point
    const double margin = 0.04 * (high - low);
    if (!chart.x_log) return fmt::format("set xrange [{}:{}]\n", number(low - margin), number(high + margin));
    const auto [from, to] = log_range(chart);
    std::string text = fmt::format("set logscale x\nset xrange [{}:{}]\n", number(from), number(to));
    if (!chart.x_marks) return text + "set format x \"%g\"\n";
    std::string marks;
    for (const double x : chart.series.front().x) marks += (marks.empty() ? "" : ", ") + number(x);
    return text + "set xtics (" + marks + ")\n";
}

void replace_all(std::string& text, const std::string& what, const std::string& by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
}

/// Runs gnuplot on a script and waits for it; what it prints goes nowhere.
bool run_gnuplot(const std::filesystem::path& script)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    std::string program = "gnuplot", file = script.string();
    std::array<char*, 3> arguments = {program.data(), file.data(), nullptr};
    pid_t child = 0;
    const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (failed != 0 || waitpid(child, &status, 0) != child) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// A folder that goes away.
class Workplace {
public:
    Workplace()
    {
        std::string name = (std::filesystem::temp_directory_path() / "firstray-XXXXXX").string();
        if (mkdtemp(name.data())) path_ = name;
    }
    ~Workplace()
    {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace

std::pair<double, double> log_range(const Chart& chart)
{
    const auto [low, high] = x_ends(chart);
    return {0.9 * low, high * (chart.labels.empty() ? 1.1 : std::pow(high / low, 0.4))};  // labels need room
}

std::string gnuplot_script(const Chart& chart, const std::string& file)
{
    std::string text = fmt::format(
        "set terminal svg size 520,400 dynamic font \"sans-serif,14\" name {}\nset output {}\n"
        "set xlabel {} offset 0,0.5 noenhanced\nset ylabel {} noenhanced\nset grid lc rgb \"#999999\" lw 0.5 dt 3\n"
        "set key below horizontal maxrows 3 samplen 2 height 1\nset border 3\nset tics nomirror\n",
        quoted(chart.id), quoted(file), quoted(chart.x_label), quoted(chart.y_label));
    text += x_axis(chart);
    text += chart.y_log ? "set logscale y\nset format y \"%g\"\n" : "set yrange [0:*]\n";
    for (std::size_t i = 0; i < chart.series.size(); ++i) text += data_block(chart.series[i], i);
    for (std::size_t i = 0; i < chart.labels.size(); ++i)
        if (!chart.labels[i].text.empty()) text += label_of(chart, i);
    text += "plot ";
    for (std::size_t i = 0; i < chart.series.size(); ++i) text += (i ? ", \\\n  " : "") + plot_of(chart.series[i], i);
    return text + "\n";
}

std::string fit_for_page(std::string svg, const Chart& chart)
{
    const std::size_t begin = svg.find("<svg");
    if (begin == std::string::npos) return {};
    svg.erase(0, begin);
    for (const char* black : {"color=\"black\" ", "color=\"white\" "}) replace_all(svg, black, "");
    replace_all(svg, "stroke='black'", "stroke='currentColor'");
    replace_all(svg, "stroke=\"black\"", "stroke=\"currentColor\"");
    replace_all(svg, "fill=\"black\"", "fill=\"currentColor\"");
    replace_all(svg, "rgb(  0,   0,   0)", "currentColor");
    // Charts share a page, so names of their parts must differ.
    for (const char* name : {"gpPt", "gpDot", "gnuplot_canvas", "textbox", "greybox"})
        replace_all(svg, name, chart.id + name);
    replace_all(svg, "<title>" + chart.id + "</title>", "<title>" + escaped(chart.caption) + "</title>");
    replace_all(svg, "<svg", "<svg role=\"img\"");
    return svg;
}

std::optional<std::string> draw_chart(const Chart& chart)
{
    if (chart.series.empty()) return std::nullopt;
    const Workplace place;
    if (place.path().empty()) return std::nullopt;
    const auto script = place.path() / "chart.gp", picture = place.path() / "chart.svg";
    std::ofstream(script) << gnuplot_script(chart, picture.string());
    if (!run_gnuplot(script)) return std::nullopt;
    std::ifstream in(picture);
    const std::string svg = fit_for_page({std::istreambuf_iterator<char>(in), {}}, chart);
    if (svg.empty()) return std::nullopt;
    return svg;
}

}  // namespace firstray::compare
