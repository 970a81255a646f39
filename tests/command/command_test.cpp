#include "bench/firstray/command.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "bench/firstray/words.h"
#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

namespace firstray::command {
namespace {

using test::call;
using test::call_line;
using test::moving_square;
using test::Outcome;
using test::read_json;

/// The first three channels of a picture, pixel by pixel.
std::vector<float> channels(const std::filesystem::path& file)
{
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<float> values(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * 3);
    REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, values.data()));
    return values;
}

TEST_CASE("a command line that cannot be taken is told in one line and exits with 2")
{
    const std::pair<std::string, std::string> cases[] = {
        {"rendr a.aff", "did you mean render?"},
        {"render", "render needs a scene, e.g.: firstray render scenes/everything.aff"},
        {"render a.aff --strateg grid", "unknown option --strateg; did you mean --strategy?"},
        {"render a.aff b.aff", "'b.aff' was not expected"},
        {"render a.aff --strategy gird", "did you mean grid?"},
        {"render a.aff --precision exact", "expected fast, robust or double"},
        {"render a.aff --frames 3-1", "ends before it begins"},
        {"render a.aff --size 800", "expected WIDTHxHEIGHT"},
        {"render a.aff --size 0x5", "from 1 to 16384"},
        {"render a.aff --depth -1", "--depth"},
        {"render a.aff --spp 1.5", "--spp"},
        {"render a.aff --threads many", "--threads"},
        {"render a.aff --aov depth", "expected distance, primitive"},
        {"render a.aff --output a.jpg", ".exr or .png"},
        {"render a.aff --progress often", "expected auto, always or never"},
        {"render a.aff --frameless 0.2", "expected 1 or 1/X"},
        {"render a.aff --seed -1", "--seed"},
        {"compare a.aff --strategies grid,gird", "strategy 'gird', expected one of list"},
        {"compare a.aff --strategies obb+obb-top=gird", "obb-top 'gird'"},
        {"compare a.aff --repeat 0", "--repeat"},
        {"compare a.aff --strategy grid", "did you mean --strategies?"},
        {"info a.aff --strategy grid", "--strategy requires --structure"},
        {"info a.aff --frame 3", "--frame requires --structure"},
        {"info a.aff --structure --strategy gird", "did you mean grid?"},
        {"render a.aff --obb-top gird", "--obb-top: 'gird', expected grid or list; did you mean grid?"},
        {"render a.aff --obb-groups static", "--obb-groups: 'static', expected dynamic or all"},
        {"trace a.aff --frame 0 --rays r.csv --obb-hits world", "--obb-hits: 'world', expected root or local"},
        {"info a.aff --structure --obb-inside auot", "expected auto, grid, list or lazy; did you mean auto?"},
        {"render a.aff --obb-top list", "--obb-top is for --strategy obb, not grid"},
#ifdef FIRSTRAY_HAVE_EMBREE
        {"render a.aff --embree-rays single", "--embree-rays is for --strategy embree, not grid"},
        {"render a.aff --strategy embree-low --obb-top list", "--obb-top is for --strategy obb, not embree-low"},
        {"render a.aff --strategy embree-low --embree-rays one", "expected packets or single"},
#endif
        {"render a.aff --strategy obb --structure-budget 9", "--structure-budget is for --strategy lazy or adaptive, not obb"},
        {"info a.aff --obb-top list", "--obb-top requires --structure"},
        {"trace a.aff --rays r.csv", "needs --frame"},
        {"trace a.aff --frame 0", "needs --rays"},
    };
    for (const auto& [line, message] : cases) {
        const auto line_now = line;  // clang 14 captures no structured bindings
        CAPTURE(line_now);
        const Outcome outcome = call_line(line);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with("firstray: "));
        CHECK(outcome.err.find(message) != std::string::npos);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
    CHECK(call({}).code == 2);
}

TEST_CASE("help fits one screen, ends in two examples and exits with 0")
{
    for (const std::string command : {"", "render", "compare", "info", "trace"}) {
        CAPTURE(command);
        const Outcome outcome = command.empty() ? call({"--help"}) : call({command, "--help"});
        CHECK(outcome.code == 0);
        CHECK(outcome.err.empty());
        CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') <= 50);
        for (const std::string_view line : command::split(outcome.out, '\n')) CHECK(line.size() <= 100);
        const std::string examples = outcome.out.substr(outcome.out.find("Examples:\n") + 10);
        CHECK(std::count(examples.begin(), examples.end(), '\n') == 2);
    }
    CHECK(call({"--version"}).out.starts_with("firstray 0."));
}

TEST_CASE("options that are seldom used are shown by --help-all, and work without it")
{
    for (const std::string command : {"render", "compare", "info", "trace"}) {
        CAPTURE(command);
        const Outcome some = call({command, "--help"}), all = call({command, "--help-all"});
        CHECK(all.code == 0);
        CHECK(some.out.find("--grid-depth") == std::string::npos);
        CHECK(all.out.find("--grid-depth") != std::string::npos);
        CHECK(some.out.find("--help-all") != std::string::npos);
        CHECK(call({command, "a.aff", "--grid-dept", "2"}).err.find("did you mean --grid-depth?") != std::string::npos);
    }
}

TEST_CASE("a command without a scene says what to type next")
{
    for (const std::string command : {"render", "compare", "info", "trace"}) {
        const Outcome outcome = call({command});
        CHECK(outcome.code == 2);
        CHECK(outcome.err.starts_with("firstray: " + command + " needs a scene, e.g.: firstray " + command +
                                      " scenes/everything.aff"));
    }
}

TEST_CASE("bad scenes, missing files and frames beyond the end have their own exit codes")
{
    const test::TempFolder folder;
    const std::string bad = folder.write("bad.aff", "v from 0 0").string();
    const std::string good = folder.write("good.aff", moving_square).string();
    const std::string rays = folder.write("rays.csv", "1,2,3\n").string();
    CHECK(call({"info", bad}).code == 3);
    CHECK(call({"info", bad + "x"}).code == 4);
    CHECK(call({"render", good, "--frames", "5"}).code == 2);
    CHECK(call({"info", good, "--structure", "--frame", "5"}).code == 2);
    CHECK(call({"trace", good, "--frame", "0", "--rays", rays}).code == 3);
    CHECK(call({"trace", good, "--frame", "0", "--rays", rays + "x"}).code == 4);
    CHECK(call({"trace", good, "--frame", "-1", "--rays", rays}).code == 2);
}

TEST_CASE("frames rendered alone or in a row, by any strategy and number of threads, are the same picture")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto render = [&](const std::string& frames, const std::string& strategy, const std::string& threads) {
        const auto stats = (folder.path() / "stats.json").string();
        const Outcome outcome = call({"render", scene, "--frames", frames, "--strategy", strategy, "--threads", threads,
                                      "--stats", stats, "--output", (folder.path() / "a.##.png").string()});
        CAPTURE(outcome.err);
        REQUIRE(outcome.code == 0);
        return read_json(stats)["frames"];
    };
    const auto all = render("0-4", "list", "1");
    REQUIRE(all.size() == 5);
    CHECK(all[0]["image_hash"] != all[4]["image_hash"]);
    CHECK(all[4]["rays"]["primary"] == 16 * 12);
    CHECK(all[4]["time"] == 4.0);
    CHECK(all[4]["total_ms"].get<double>() > 0.0);
    for (const std::string strategy : {"list", "grid", "obb"})
        for (const std::string threads : {"1", "2"}) {
            CAPTURE(strategy);
            CHECK(render("4", strategy, threads)[0]["image_hash"] == all[4]["image_hash"]);
        }
    CHECK(std::filesystem::is_regular_file(folder.path() / "a.04.png"));
}

TEST_CASE("when a frame cannot be written, those before it are in the statistics")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    std::filesystem::create_directory(folder.path() / "a.2.png");
    const auto stats = folder.path() / "stats.json";
    const Outcome outcome = call({"render", scene, "--frames", "0-4", "--stats", stats.string(), "--output",
                                  (folder.path() / "a.#.png").string(), "--progress", "never"});
    CHECK(outcome.code == 4);
    CHECK(outcome.err.find("a.2.png") != std::string::npos);
    CHECK(read_json(stats)["frames"].size() == 2);
    CHECK(std::filesystem::is_regular_file(folder.path() / "a.1.png"));
}

TEST_CASE("the table has a heading and a line per frame, and nothing else is on standard output")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const Outcome outcome = call({"render", scene, "--frames", "0-4:2", "--table", "--output",
                                  (folder.path() / "a.#.exr").string(), "--aov", "distance,tests,time"});
    CHECK(outcome.code == 0);
    CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') == 4);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.starts_with("firstray: 3 frames, mean update "));
}

TEST_CASE("answer line k belongs to ray k in every precision and by every strategy")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    // At frame 3 the square's centre is at x = 3. Group 0 is the still triangle.
    const std::string rays =
        folder
            .write("rays.csv",
                   "3.25,0.125,8,0,0,-2,0,inf\n100,0,8,0,0,-1,0,inf\n0,0,8,0,0,-1,0,inf\n0,0,8,0,0,-1,0,8.5\n")
            .string();
    for (const std::string strategy : {"list", "grid", "obb"})
        for (const std::string precision : {"fast", "robust", "double"}) {
            CAPTURE(strategy);
            CAPTURE(precision);
            const Outcome outcome = call({"trace", scene, "--frame", "3", "--rays", rays, "--precision", precision,
                                          "--strategy", strategy, "--threads", "1"});
            CHECK(outcome.code == 0);
            const auto lines = split(outcome.out, '\n');
            REQUIRE(lines.size() == 5);  // the last is what follows the last line end
            CHECK(lines[0].starts_with("4,1,"));
            CHECK(lines[1] == "inf,-1,-1,0,0");
            CHECK(lines[2].starts_with("9,0,0,"));
            CHECK(lines[3] == "inf,-1,-1,0,0");
        }
}

TEST_CASE("answers go to the file asked for and then not to standard output")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const std::string rays = folder.write("rays.csv", "0,0,8,0,0,-1,0,8.5\n").string();
    const auto answers = folder.path() / "hits.csv";
    const Outcome outcome = call({"trace", scene, "--frame", "4", "--rays", rays, "--output", answers.string()});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(std::filesystem::file_size(answers) == std::string_view("inf,-1,-1,0,0\n").size());
}

TEST_CASE("info counts what the scene holds")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto info = nlohmann::json::parse(call({"info", scene, "--json"}).out);
    CHECK(info["name"] == "square");
    CHECK(info["triangles"] == 3);
    CHECK(info["groups"]["static"] == 1);
    CHECK(info["groups"]["moving"] == 1);
    CHECK(info["transforms"] == 1);
    CHECK(info["lights"] == 1);
    CHECK(info["animation"]["frames"] == 5);
    CHECK(info["resolution"] == nlohmann::json{16, 12});
    CHECK(info["statements"]["p"] == 2);
    CHECK(info["bounds"]["lo"] == nlohmann::json{-5.0, -5.0, -1.0});
    CHECK(call({"info", scene}).out.find("triangles    3, 0 of them deforming") != std::string::npos);
}

TEST_CASE("info tells of the structure at a frame when asked, behind what it always tells")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const std::string plain = call({"info", scene}).out;
    const Outcome table = call({"info", scene, "--structure", "--frame", "4"});
    CHECK(table.code == 0);
    CHECK(table.err.empty());
    REQUIRE(table.out.starts_with(plain));
    const std::string added = table.out.substr(plain.size());
    CHECK(added.starts_with("structure    strategy grid, frame 4\nname "));
    CHECK(added.find("\ngrid ") != std::string::npos);
    CHECK(std::count(added.begin(), added.end(), '\n') == 3);

    auto json = nlohmann::json::parse(call({"info", scene, "--json", "--structure", "--frame", "4"}).out);
    CHECK(json["structure_of"] == nlohmann::json{{"strategy", "grid"}, {"precision", "robust"}, {"frame", 4}});
    REQUIRE(json["structure"].size() == 1);
    const auto& grid = json["structure"][0];
    CHECK(grid["primitives"] == 3);
    CHECK(grid["subgrids"]["count"] == 0);
    CHECK(grid["size"][0].get<double>() == doctest::Approx(10.0));  // the triangle's; frame 4's square ends at 4.5
    CHECK(grid["size"][2].get<double>() == doctest::Approx(1.0));
    json.erase("structure");
    json.erase("structure_of");
    CHECK(json == nlohmann::json::parse(call({"info", scene, "--json"}).out));
}

TEST_CASE("strategies without a structure say so")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const std::string out = call({"info", scene, "--structure", "--strategy", "list"}).out;
    CHECK(out.find("structure    strategy list has none to show\n") != std::string::npos);
    const auto json = nlohmann::json::parse(call({"info", scene, "--structure", "--strategy", "list", "--json"}).out);
    CHECK(json["structure"] == nlohmann::json::array());
    const std::string err = call({"render", scene, "--structure", "--strategy", "list", "--output",
                                  (folder.path() / "a.png").string(), "--frames", "2"})
                                .err;
    CHECK(err.find("strategy list has no structure to draw\n") != std::string::npos);
}

TEST_CASE("render draws the structure over what it writes, and hashes the picture without it")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto render = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render",   scene,
                                              "--frames", "4",
                                              "--stats",  (folder.path() / "stats.json").string(),
                                              "--output", (folder.path() / name).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        REQUIRE(call(arguments).code == 0);
        return read_json(folder.path() / "stats.json")["frames"][0]["image_hash"];
    };
    for (const std::string extension : {".png", ".exr"}) {
        CAPTURE(extension);
        const auto plain = render("plain" + extension, {}), drawn = render("drawn" + extension, {"--structure"});
        CHECK(plain == drawn);
        CHECK(channels(folder.path() / ("plain" + extension)) != channels(folder.path() / ("drawn" + extension)));
    }
    CHECK(read_json(folder.path() / "stats.json")["settings"]["structure"] == true);
}

TEST_CASE("frameless, a share of 1 is the ordinary picture, another traces that share of every frame but the first")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto render = [&](const std::vector<std::string>& more) {
        const auto stats = (folder.path() / "stats.json").string();
        std::vector<std::string> arguments = {
            "render", scene,     "--frames", "0-4",      "--aov",
            "age",    "--stats", stats,      "--output", (folder.path() / "a.#.exr").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        REQUIRE(call(arguments).code == 0);
        return read_json(stats);
    };
    const auto plain = render({}), whole = render({"--frameless", "1"}), part = render({"--frameless", "1/8"}),
               again = render({"--frameless", "1/8"}), other = render({"--frameless", "1/8", "--seed", "7"});
    CHECK(part["settings"]["frameless"] == "1/8");
    for (std::size_t i = 0; i < 5; ++i) {
        CAPTURE(i);
        CHECK(whole["frames"][i]["image_hash"] == plain["frames"][i]["image_hash"]);
        CHECK(again["frames"][i]["image_hash"] == part["frames"][i]["image_hash"]);
        CHECK(part["frames"][i]["rays"]["primary"] == (i == 0 ? 16 * 12 : 16 * 12 / 8));
    }
    CHECK(part["frames"][0]["image_hash"] == plain["frames"][0]["image_hash"]);
    CHECK(part["frames"][4]["image_hash"] != plain["frames"][4]["image_hash"]);
    CHECK(other["frames"][4]["image_hash"] != part["frames"][4]["image_hash"]);
}

}  // namespace
}  // namespace firstray::command
