#include "bench/compare/report.h"

#include <doctest/doctest.h>

#include "bench/compare/compare.h"
#include "bench/compare/gnuplot.h"
#include "bench/compare/html.h"
#include "bench/compare/text.h"
#include "bench/compare/trade.h"
#include "bench/compare/verdict.h"
#include "tests/compare/broken_strategies.h"
#include "tests/support/call_command.h"
#include "tests/support/scene_files.h"

using namespace firstray;
using namespace firstray::compare;

namespace {

Report run(const Scene& scene, bool trade = false)
{
    Plan plan;
    for (const char* name : {"grid", "obb", "lazy"}) plan.contestants.push_back(parse_contestant(name));
    plan.contestants.push_back({"unmakable", &test::unmakable, {}});
    plan.frames = {0, 2};
    plan.render = {.width = 16, .height = 12, .depth = 1};
    plan.threads = 2;
    plan.repeat = 3;
    plan.frameless = {1, 4};
    plan.trade = trade;
    return compare::compare(scene, {}, plan, {"firstray compare '<b>'", "a&b.aff"}, {});
}

}  // namespace

TEST_CASE("text is escaped for elements and attributes, bytes become base64")
{
    CHECK(escaped("<script>\"a\" & 'b'</script>") == "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;");
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64(std::string("\xff\xfe\x00", 3)) == "//4A");
    HtmlTable table({"name", "two|lines"});
    table.add({"<a>", "1"}, true);
    CHECK(table.html().find("<th scope=\"row\">&lt;a&gt;</th><td>1</td>") != std::string::npos);
    CHECK(table.html().find("two<br>lines") != std::string::npos);
    CHECK(table.html().find("<tr class=\"marked\">") != std::string::npos);
}

TEST_CASE("a report of a scene named <script> holds no script, nothing from elsewhere, and says what failed")
{
    Scene scene = test::scene_of(test::moving_square);
    scene.name = "<script>alert(1)</script>";
    const Report report = run(scene);
    const std::string page = report_html(report.results, report.pictures);
    CHECK(page.find("<script") == std::string::npos);
    CHECK(page.find("&lt;script&gt;alert(1)") != std::string::npos);
    CHECK(page.find("<b>") == std::string::npos);
    CHECK(page.find("a&amp;b.aff") != std::string::npos);
    CHECK(page.find("failed: cannot be made") != std::string::npos);
    CHECK(page.find("src=\"http") == std::string::npos);
    CHECK(page.find("href=\"http") == std::string::npos);
    CHECK(page.find("src=\"data:image/png;base64,iVBORw0KGgo") != std::string::npos);
}

TEST_CASE("a machine that was busy before is told of")
{
    CHECK(load_warning({{"load_before", 0.2}}).empty());
    CHECK(load_warning({{"load_before", 3.84}}).find("load average 3.8") != std::string::npos);
}

TEST_CASE("the page's numbers are those of the results document")
{
    const Report report = run(test::scene_of(test::moving_square));
    const std::string page = report_html(report.results, report.pictures);
    for (const Json& strategy : report.results["strategies"]) {
        if (strategy["times"].is_null()) continue;
        CAPTURE(strategy["name"]);
        const std::string start = "<tr><th scope=\"row\">" + strategy["name"].get<std::string>() + "</th>";
        const std::size_t begin = page.find(start);
        REQUIRE(begin != std::string::npos);
        const std::string row = page.substr(begin, page.find("</tr>", begin) - begin);
        for (const char* key : {"update_ms", "trace_ms", "total_ms"})
            CHECK(row.find("<td>" + short_number(strategy["times"][key]["median"]) + "</td>") != std::string::npos);
        CHECK(page.find("missed/M<br>of " + grouped(strategy["accuracy"]["rays"])) != std::string::npos);
    }
    CHECK(report.results["verdict"] == verdict_of(report.results));
    CHECK(page.find(escaped(report.results["verdict"]["own"]["sentence"].get<std::string>())) != std::string::npos);
}

TEST_CASE("pictures come for the frame of most rays, structure and time where a strategy has them")
{
    const Report report = run(test::scene_of(test::moving_square));
    REQUIRE(report.pictures.size() == 1);
    REQUIRE(report.pictures[0].triptychs.size() == 3);
    for (const Triptych& triptych : report.pictures[0].triptychs) {
        CAPTURE(triptych.name);
        for (const std::string& png : {triptych.picture, triptych.structure, triptych.time})
            CHECK(png.starts_with("\x89PNG"));
    }
    CHECK(report.pictures[0].triptychs[0].picture == report.pictures[0].triptychs[1].picture);
    CHECK(report.pictures[0].scale.low < report.pictures[0].scale.high);
}

TEST_CASE("a heat scale leaves out the extremes, its colours rise from dark to bright")
{
    std::vector<double> values(5000, 100.0);
    values[0] = 1e9;
    values[1] = 0.0;
    for (int i = 2; i < 500; ++i) values[static_cast<std::size_t>(i)] = 1000.0;
    const HeatScale scale = heat_scale(values);
    CHECK(scale.low == 100.0);
    CHECK(scale.high < 1e9);
    CHECK(scale.position(50.0) == 0.0);
    CHECK(scale.position(1e10) == 1.0);
    CHECK(HeatScale{10.0, 1000.0}.position(100.0) == doctest::Approx(0.5));
    CHECK(heat_scale({}).high > heat_scale({}).low);
    CHECK(heat_scale({5.0, 5.0}).high == 10.0);
    float former = -1.0f;
    for (int i = 0; i <= 32; ++i) {
        const glm::vec3 c = heat_colour(i / 32.0);
        const float luma = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
        CHECK(luma > former);
        former = luma;
    }
    CHECK(heat_colour(-1.0) == heat_colour(0.0));
    CHECK(heat_colour(7.0) == heat_colour(1.0));
}

TEST_CASE("a chart's text cannot break out of gnuplot's script, and its picture fits a page")
{
    const Chart chart{.id = "c1",
                      .caption = "<one>",
                      .x_label = "a \"b\" \\ c\nset output 'x'",
                      .y_label = "y",
                      .y_log = true,
                      .series = {{.name = "s\"1", .x = {1, 2}, .y = {3, 4}, .least = {2, 3}, .most = {4, 5}}}};
    const std::string script = gnuplot_script(chart, "/tmp/x.svg");
    CHECK(script.find("set xlabel \"a \\\"b\\\" \\\\ c set output 'x'\"") != std::string::npos);
    CHECK(script.find("title \"s\\\"1\"") != std::string::npos);
    CHECK(script.find("1 3 2 4\n2 4 3 5\nEOD") != std::string::npos);
    CHECK(script.find("set logscale y") != std::string::npos);
    const std::string fitted =
        fit_for_page("<?xml?>\n<svg ><title>c1</title><g color=\"black\" stroke='black'></svg>", chart);
    CHECK(fitted == "<svg role=\"img\" ><title>&lt;one&gt;</title><g stroke='currentColor'></svg>");
    CHECK_FALSE(draw_chart(Chart{.id = "none", .caption = ""}));
    if (const auto svg = draw_chart(chart)) {
        CHECK(svg->starts_with("<svg"));
        CHECK(svg->find("</svg>") != std::string::npos);
    } else {
        MESSAGE("skipped: gnuplot is not installed");
    }
}

TEST_CASE(
    "settings are worse than others that are faster in every round and as accurate, and the frontier has the rest")
{
    const auto setting = [](const char* name, std::vector<double> totals, double rmse, bool orientation = false) {
        return Json{
            {"name", name},     {"fault", ""},      {"is_orientation", orientation},       {"on_frontier", false},
            {"worse_than", ""}, {"totals", totals}, {"total_ms", {{"median", totals[1]}}}, {"image", {{"rmse", rmse}}}};
    };
    Json settings = {setting("quick", {1, 1, 1}, 0.5), setting("good", {9, 9, 9}, 0.1),
                     setting("bad", {10, 10, 10}, 0.2), setting("noisy", {8, 9.5, 11}, 0.1),
                     setting("memory", {1, 1, 1}, 0.0, true)};
    judge(settings);
    const auto frontier = [&](int i) { return settings[static_cast<std::size_t>(i)]["on_frontier"].get<bool>(); };
    const auto worse = [&](int i) { return settings[static_cast<std::size_t>(i)]["worse_than"].get<std::string>(); };
    CHECK(frontier(0));
    CHECK(frontier(1));
    CHECK_FALSE(frontier(2));
    CHECK_FALSE(frontier(3));
    CHECK_FALSE(frontier(4));
    CHECK(worse(2) == "good");
    CHECK(worse(3) == "");
    CHECK(worse(4) == "");
}

TEST_CASE("the trade measures every setting against the reference and draws it")
{
    const Report report = run(test::scene_of(test::moving_square), true);
    const Json& trade = report.results["trade"];
    CHECK(trade["frames"] == Json::array({0, 2}));
    CHECK(trade["settings"].size() > 15);
    for (const Json& setting : trade["settings"]) {
        CAPTURE(setting["name"]);
        CHECK(setting["fault"] == "");
        CHECK(setting["totals"].size() == 3);
        if (setting["name"] == "spp 16") CHECK(setting["image"]["rmse"].get<double>() < 1e-3);
        if (setting["name"] == "depth 0") CHECK(setting["hits"]["rays"] == trade["rays"]);
    }
    CHECK(trade_summary(trade).find("RMSE") != std::string::npos);
    CHECK(report_html(report.results, {}).find("Speed for accuracy") != std::string::npos);
}
