#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>

#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

namespace firstray::command {
namespace {

using test::call;
using test::Outcome;

TEST_CASE("compare prints a table, or the results it writes, and leaves a report")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", test::moving_square).string();
    const std::filesystem::path report = folder.path() / "report";
    const std::vector<std::string> common = {"compare",  scene, "--strategies", "grid,obb+obb-top=list,lazy",
                                             "--repeat", "1",   "--report",     report.string()};
    const Outcome table = call(common);
    CHECK(table.code == 0);
    CHECK(table.out.find("5 frames of square, 16x12, depth 4, 1 sample, robust") == 0);
    CHECK(table.out.find("obb+obb-top=list") != std::string::npos);
    CHECK(table.err.find("report in " + (report / "index.html").string()) != std::string::npos);
    for (const char* name : {"index.html", "results.json", "results.csv"})
        CHECK(std::filesystem::file_size(report / name) > 100);
    CHECK(std::distance(std::filesystem::directory_iterator(report), {}) == 3);

    std::vector<std::string> as_json = common;
    as_json.insert(as_json.end(), {"--json", "--frames", "0,4", "--progress", "never"});
    const Outcome json = call(as_json);
    CHECK(nlohmann::json::parse(json.out) == test::read_json(report / "results.json"));
    CHECK(nlohmann::json::parse(json.out)["frames"].size() == 2);
}

TEST_CASE("Ctrl-C ends a comparison with a report of what was finished")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", test::moving_square).string();
    const std::filesystem::path report = folder.path() / "report";
    // The signal comes with the first line of progress: the buffer it is written to raises it.
    class Raising : public std::stringbuf {
        int sync() override
        {
            if (!raised_) std::raise(SIGINT);
            raised_ = true;
            return 0;
        }
        bool raised_ = false;
    } buffer;
    std::ostream err(&buffer);
    std::ostringstream out;
    const std::vector<std::string> arguments = {"compare", scene,      "--strategies",  "grid",   "--repeat",
                                                "1000",    "--report", report.string(), "--size", "16x12"};
    CHECK(run(arguments, {out, err}) == 1);
    CHECK(buffer.str().find("interrupted; the report has what was finished") != std::string::npos);
    CHECK(test::read_json(report / "results.json")["interrupted"] == true);
    CHECK(out.str().find("(interrupted)") != std::string::npos);
}

TEST_CASE("a report's folder that cannot be written is refused before anything is measured")
{
    const test::TempFolder folder;
    const std::string scene = folder.write("square.aff", test::moving_square).string();
    const std::string file = folder.write("taken", "").string();
    const Outcome outcome = call({"compare", scene, "--report", file + "/report"});
    CHECK(outcome.code == 4);
    CHECK(outcome.out.empty());
}

}  // namespace
}  // namespace firstray::command
