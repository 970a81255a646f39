#include "bench/firstray/manual.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "bench/firstray/options.h"
#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::command;
using namespace firstray::test;

namespace {

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// What bash completes the last word to, after sourcing our completion; words in order, parted by blanks.
std::string completed(const std::string& words)
{
    const TempFolder folder;
    const std::string script = folder.write("firstray.bash", call({"manual", "bash"}).out).string(),
                      result = (folder.path() / "result").string();
    const std::string line = "bash -c 'source \"$0\"; COMP_WORDS=(" + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _firstray; echo \"${COMPREPLY[*]}\"' '" +
                             script + "' > '" + result + "'";
    REQUIRE(std::system(line.c_str()) == 0);
    std::ostringstream text;
    text << std::ifstream(result).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("the manual page tells of every command and option that help tells of")
{
    const Outcome man = call({"manual", "man"});
    CHECK(man.code == 0);
    Jobs jobs;
    const auto line = make_command_line(jobs, true);
    int options = 0;
    for (const std::string command : {"render", "compare", "info", "trace"}) {
        CHECK(contains(man.out, ".SH FIRSTRAY " + command));
        for (const CLI::Option* option : line->get_subcommand(command)->get_options()) {
            if (!option->nonpositional()) continue;
            std::string name = option->get_lnames()[0];
            for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2) name.insert(at, "\\");
            CHECK_MESSAGE(contains(man.out, "\\-\\-" + name), name);
            ++options;
        }
    }
    CHECK(options > 80);
    CHECK(contains(man.out, "firstray compare before/results.json after/results.json"));
}

TEST_CASE("bash completes commands, options and the words that options take")
{
    CHECK(completed("firstray \"\"") == "render compare info trace --version --help\n");
    CHECK(completed("firstray com") == "compare\n");
    CHECK(completed("firstray render --frame") == "--frames --frameless\n");
    CHECK(completed("firstray render a.aff --precision r") == "robust\n");
    CHECK(completed("firstray info a.aff --obb-top \"\"") == "grid list\n");
    CHECK(completed("firstray render a.aff --strategy l") == "list lazy\n");
    CHECK(completed("firstray render sce") == "\n");  // a file, which bash completes itself
}

TEST_CASE("zsh is told of every option with its words, and no quote is left open")
{
    const std::string zsh = call({"manual", "zsh"}).out;
    CHECK(zsh.starts_with("#compdef firstray\n"));
    CHECK(contains(zsh,
                   "'--obb-hits[root or local: decide hits in the root system, or the box'\\''s (the paper); "
                   "default root]:NAME:(root local)'"));
    CHECK(contains(zsh, "'--table[print a line of times per frame to standard output]'"));
    if (std::system("command -v zsh > /dev/null") != 0) {
        MESSAGE("zsh is not installed: its syntax is not checked");
        return;
    }
    const TempFolder folder;
    const std::string file = folder.write("_firstray", zsh).string();
    CHECK(std::system(("zsh -n '" + file + "'").c_str()) == 0);
}

TEST_CASE("a page that does not exist is a fault of use")
{
    CHECK(call({"manual", "tcsh"}).err.starts_with("firstray: manual: 'tcsh', expected man, bash or zsh"));
}
