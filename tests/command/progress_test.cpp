#include "bench/firstray/progress.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

TEST_CASE("progress is one rewritten line on a terminal, lines elsewhere, nothing when never")
{
    struct Case {
        std::string mode;
        bool terminal;
        int lines, returns;
    };
    for (const auto& [mode, terminal, lines, returns] : {Case{"auto", true, 0, 3}, Case{"auto", false, 2, 0},
                                                         Case{"always", false, 2, 0}, Case{"never", true, 0, 0}}) {
        const auto mode_now = mode;  // clang 14 captures no structured bindings
        CAPTURE(mode_now);
        const auto terminal_now = terminal;  // clang 14 captures no structured bindings
        CAPTURE(terminal_now);
        std::ostringstream err;
        {
            Progress progress(err, progress_style(mode, terminal), 2);
            progress.frame_done(0);
            progress.frame_done(10);
        }
        const std::string text = err.str();
        CHECK(std::count(text.begin(), text.end(), '\n') == lines);
        CHECK(std::count(text.begin(), text.end(), '\r') == returns);  // the last one clears the line
        CHECK((text.find("frame 10 (2/2, 100 %, 0:00 left)") != std::string::npos) == (lines + returns > 0));
    }
    CHECK_THROWS_AS(progress_style("sometimes", true), UsageError);
}

TEST_CASE("steps that begin tell what share of the work has ended, on one line or on lines that are rare")
{
    std::ostringstream terminal, log;
    {
        Progress rewritten(terminal, ProgressStyle::rewritten, 0), lines(log, ProgressStyle::lines, 0);
        for (Progress* progress : {&rewritten, &lines}) {
            progress->expect(10.0);
            progress->step("a", 1.0);
            progress->step("b", 6.0);
            progress->step("c", 2.0);
            progress->step("d", 4.0);  // more than was thought
            progress->step("e", 1.0);
        }
    }
    CHECK(terminal.str().find("a\r") != std::string::npos);
    CHECK(terminal.str().find("b (10 %, 0:00 left)") != std::string::npos);
    CHECK(terminal.str().find("c (70 %, 0:00 left)") != std::string::npos);
    CHECK(terminal.str().find("d (69 %, 0:00 left)") != std::string::npos);
    CHECK(terminal.str().find("e (92 %, 0:00 left)") != std::string::npos);
    CHECK(terminal.str().find('\n') == std::string::npos);
    CHECK(log.str() == "firstray: a\n");
}

TEST_CASE("time left is told in hours, minutes and seconds")
{
    CHECK(format_duration(0.4) == "0:00");
    CHECK(format_duration(59.6) == "1:00");
    CHECK(format_duration(3725.0) == "1:02:05");
}

}  // namespace
}  // namespace firstray::command
