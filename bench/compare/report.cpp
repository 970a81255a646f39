#include "bench/compare/report.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/compare/charts.h"
#include "bench/compare/html.h"
#include "bench/compare/report_accuracy.h"
#include "bench/compare/report_sections.h"
#include "bench/compare/report_style.h"
#include "bench/compare/table.h"
#include "bench/compare/text.h"
#include "bench/compare/verdict.h"

namespace firstray::compare {
namespace {

/// winner         of the verdict
/// clear, unclear  titles: whether it can be told from all others
std::string answer_of(const Json& winner, const char* clear, const char* unclear)
{
    return fmt::format("<p><strong>{}:</strong> {}</p>", winner["level"].empty() ? clear : unclear,
                       escaped(winner["sentence"].get<std::string>()));
}

std::string answer(const Json& results)
{
    const Json& verdict = results["verdict"];
    std::string text = "<div class=\"answer\">";
    if (verdict["all"].is_null())
        text += "<p>Nothing was timed whose answers are right.</p>";
    else
        text += answer_of(verdict["all"], "Fastest", "No clear winner");
    if (!verdict["own"].is_null() && verdict["own"]["fastest"] != verdict["all"]["fastest"])
        text += answer_of(verdict["own"], "Of our own", "Of our own, no clear winner");
    if (const Json& marked = verdict["faster_but_marked"]; !marked.empty())
        text += "<p><strong>Faster, but marked:</strong> " + escaped(listed(marked)) +
                ", whose answers differ from the reference's: see the accuracy columns.</p>";
    text += "</div>\n";
    if (const std::string load = load_warning(results); !load.empty()) text += paragraph("Note: " + load + ".");
    return text;
}

std::string head(const Json& results)
{
    const std::string scene = escaped(results["scene"]["name"].get<std::string>());
    std::string text =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>" +
        scene + ": strategies compared</title>\n<style>" + report_style +
        "</style></head>\n<body><main>\n"
        "<h1>" +
        scene +
        ": ray tracing strategies compared</h1>\n"
        "<p>" +
        escaped(setting_line(results)) + ".</p>\n";
    if (results["interrupted"].get<bool>())
        text +=
            "<p class=\"warning\">This run was interrupted. The report has what was finished: whole rounds "
            "alone.</p>\n";
    return text;
}

std::string charts(std::initializer_list<Chart> wanted)
{
    std::string text;
    bool is_missing = false;
    for (const Chart& chart : wanted) {
        if (chart.series.empty()) continue;
        const auto svg = draw_chart(chart);
        is_missing = is_missing || !svg;
        if (svg) text += "<figure>" + *svg + "<figcaption>" + escaped(chart.caption) + ".</figcaption></figure>\n";
    }
    if (!text.empty()) text = "<div class=\"charts\">\n" + text + "</div>\n";
    if (is_missing)
        text += "<p class=\"note\">Charts are missing: gnuplot was not found. The tables have the numbers.</p>\n";
    return text;
}

std::string triptych(const Triptych& triptych, int frame)
{
    const auto cell = [&](const std::string& png, const char* what, const char* none) {
        const std::string title = fmt::format("{}, frame {}: {}", triptych.name, frame, what);
        if (png.empty()) return "<div class=\"none\">" + escaped(none) + "</div>\n";
        return inline_png(png, title) + "\n";
    };
    return "<h3>" + escaped(triptych.name) + "</h3>\n<div class=\"triptych\">\n" +
           cell(triptych.picture, "picture", "no picture") +
           cell(triptych.structure, "structure", "it has no structure to draw") +
           cell(triptych.time, "time per pixel", "it does not tell time by ray") + "</div>\n";
}

/// Strategies of which there is a picture alone stand beside each other.
std::string plain_pictures(const std::vector<Triptych>& triptychs, int frame)
{
    std::string cells, names;
    for (const Triptych& shown : triptychs) {
        if (!shown.structure.empty() || !shown.time.empty()) continue;
        const std::string title = fmt::format("{}, frame {}: picture", shown.name, frame);
        cells += "<figure>" + inline_png(shown.picture, title) + "<figcaption>" + escaped(shown.name) +
                 "</figcaption></figure>\n";
    }
    if (cells.empty()) return "";
    return "<h3>Without a structure to draw or time by ray</h3>\n<div class=\"strip\">\n" + cells + "</div>\n";
}

std::string scale_bar(const HeatScale& scale)
{
    const auto microseconds = [](double ns) { return short_number(1e-3 * ns) + " µs"; };
    return "<div class=\"scale\"><div class=\"bar\" style=\"background:" + heat_gradient() +
           "\"></div><div class=\"ends\"><span>" + microseconds(scale.low) + "</span><span>" +
           microseconds(std::sqrt(scale.low * scale.high)) + "</span><span>" + microseconds(scale.high) +
           "</span></div>time searching for one pixel's rays, logarithmic, the same for all strategies</div>\n";
}

std::string pictures_section(const std::vector<FramePictures>& pictures)
{
    std::string text;
    for (const FramePictures& frame : pictures) {
        if (frame.triptychs.empty()) continue;
        text += fmt::format("<h2>Frame {}: picture, structure, time per pixel</h2>\n", frame.frame);
        text += scale_bar(frame.scale);
        for (const Triptych& shown : frame.triptychs)
            if (!shown.structure.empty() || !shown.time.empty()) text += triptych(shown, frame.frame);
        text += plain_pictures(frame.triptychs, frame.frame);
    }
    return text;
}

}  // namespace

std::string report_html(const Json& results, const std::vector<FramePictures>& pictures)
{
    std::string page = head(results) + answer(results);
    page += "<h2>Summary</h2>\n" + summary_section(results);
    page +=
        "<h2>Frame by frame</h2>\n" + charts({update_chart(results), trace_chart(results)}) + accuracy_note(results);
    page += pictures_section(pictures);
    page += "<h2>Structures</h2>\n" + structure_section(results);
    if (results.contains("prediction"))
        page += "<h2>Fewer rays, more processors</h2>\n" + charts({rays_chart(results), processors_chart(results)}) +
                accuracy_note(results) + prediction_section(results);
    if (results.contains("frameless"))
        page += "<h2>Frameless rendering</h2>\n" + charts({frameless_chart(results)}) + frameless_section(results);
    if (results.contains("trade"))
        page += "<h2>Speed for accuracy</h2>\n" + charts({trade_chart(results)}) + trade_section(results);
    page += "<h2>How this was measured</h2>\n" + method_section(results);
    return page + "</main></body></html>\n";
}

}  // namespace firstray::compare
