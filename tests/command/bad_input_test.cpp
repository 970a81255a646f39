#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "tests/support/call_command.h"

using namespace firstray;
using namespace firstray::test;

namespace {

const std::string folder = "tests/bad_input/";  // tests run in the project's root

/// A line of expected.txt: exit code, scene file, options, message; parted by tabs. In the message `\n` is a line's
/// end, and a `*` at its end stands for the words of a decoder, which are not ours.
struct Case {
    int code = 0;
    std::string file, options, message;
};

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

std::vector<Case> cases()
{
    std::vector<Case> result;
    std::ifstream in(folder + "expected.txt");
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("#")) continue;
        const auto parts = command::split(line, '\t');
        REQUIRE(parts.size() == 4);
        result.push_back({std::stoi(std::string(parts[0])), std::string(parts[1]), std::string(parts[2]),
                          replaced(std::string(parts[3]), "\\n", "\n")});
    }
    return result;
}

Outcome run(const Case& bad)
{
    std::vector<std::string> arguments = {"info", folder + bad.file};
    if (!bad.options.empty())
        for (const std::string_view word : command::split(bad.options, ' ')) arguments.emplace_back(word);
    return call(arguments);
}

/// What the command said, without its name, the folder and the line's end.
std::string message_of(const Outcome& outcome)
{
    const std::string said = replaced(outcome.err, folder, "");
    REQUIRE(said.starts_with("firstray: "));
    REQUIRE(said.ends_with("\n"));
    return said.substr(10, said.size() - 11);
}

bool fits(const std::string& message, const std::string& expected)
{
    if (!expected.ends_with("*")) return message == expected;
    return message.starts_with(expected.substr(0, expected.size() - 1)) && message.size() >= expected.size();
}

}  // namespace

TEST_CASE("every file of bad input is refused with its message and its exit code")
{
    const std::vector<Case> all = cases();
    CHECK(all.size() >= 120);
    for (const Case& bad : all) {
        CAPTURE(bad.file);
        const Outcome outcome = run(bad);
        CHECK(outcome.code == bad.code);
        CHECK(outcome.out == "");
        const std::string message = message_of(outcome);
        CHECK_MESSAGE(fits(message, bad.message), "said: " << message << "\nexpected: " << bad.message);
    }
    MESSAGE(all.size() << " cases");
}

TEST_CASE("every scene of bad input is a case or a part of one")
{
    std::set<std::string> known;
    std::string messages;
    for (const Case& bad : cases()) known.insert(bad.file);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".aff") || known.contains(name)) continue;
        CAPTURE(name);
        bool is_part = false;
        for (const std::string& main : known) {
            std::ifstream in(folder + main, std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(in), {}};
            is_part = is_part || text.find("i 0 " + name) != std::string::npos;
        }
        CHECK(is_part);
    }
}
