#include "scenes/generator/command.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "scenes/generator/generate.h"
#include "tests/support/temp_folder.h"

using namespace firstray;

namespace {

struct Said {
    int code = 0;
    std::string out, err;
};

Said generate(const std::vector<std::string>& arguments)
{
    std::ostringstream out, err;
    const int code = scenes::run(arguments, out, err);
    return {code, out.str(), err.str()};
}

}  // namespace

TEST_CASE("generate's help fits a screen, and so does each scene's")
{
    std::vector<std::vector<std::string>> calls = {{"--help"}};
    for (const scenes::SceneEntry& entry : scenes::scene_entries())
        calls.push_back({std::string(entry.name), "--help"});
    for (const auto& call : calls) {
        const Said said = generate(call);
        CHECK(said.code == 0);
        CHECK(std::count(said.out.begin(), said.out.end(), '\n') <= 24);
        CHECK(said.out.find("Examples:") != std::string::npos);
        std::istringstream lines(said.out);
        for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);
    }
}

TEST_CASE("generate says what it takes where it is given something else")
{
    const auto error = [](const std::vector<std::string>& arguments) {
        const Said said = generate(arguments);
        CHECK(said.code == 2);
        CHECK(said.out.empty());
        CHECK(std::count(said.err.begin(), said.err.end(), '\n') == 1);
        return said.err;
    };
    CHECK(error({}) ==
          "generate: no scene, expected robot, robots, art, stadium, crowd, explode; see generate --help\n");
    CHECK(error({"croud"}).starts_with("generate: 'croud', expected robot, "));
    CHECK(error({"crowd", "--triangle", "5"}) ==
          "generate: '--triangle' of crowd, expected --help, --triangles, --seed, --output\n");
    CHECK(error({"crowd", "--triangles", "5"}) ==
          "generate: --triangles is 5, expected a whole number from 1e5 to 1e8\n");
    CHECK(error({"robots", "--count", "2.5"}) == "generate: --count is 2.5, expected a whole number from 1 to 500\n");
    CHECK(error({"robots", "--count", "many"}).find("many") != std::string::npos);
    CHECK(error({"robot", "--seed", "-1"}) == "generate: --seed is -1, expected 0 or more\n");
}

TEST_CASE("generate names the file it wrote, and the trouble where it could not")
{
    const test::TempFolder folder;
    const std::string file = (folder.path() / "a" / "r.aff").string();
    const Said said = generate({"robot", "--output", file});
    CHECK(said.code == 0);
    CHECK(said.out.starts_with(file + ": 60"));
    CHECK(std::filesystem::exists(file));
    folder.write("plain", "");
    const std::string spaces = (folder.path() / "a b" / "r.aff").string();
    CHECK(generate({"robot", "--output", spaces}).code == 0);
    CHECK(generate({"robot", "--output", (folder.path() / "a b.aff").string()}).code == 2);
    const Said trouble = generate({"robot", "--output", (folder.path() / "plain" / "r.aff").string()});
    CHECK(trouble.code == 4);
    CHECK(trouble.err.find("plain") != std::string::npos);
}
