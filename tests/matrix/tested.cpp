// Rows that test cases of tests/ show: T13's mutants, and what is run at length here and short in every test run.
#include <fmt/format.h>

#include <cstdio>
#include <sstream>

#include "tests/matrix/matrix.h"
#include "tests/matrix/processes.h"

namespace firstray::matrix {
namespace {

/// A test case and what it shows.
struct TestedRow {
    std::string id, tried, test;  ///< test: its name, or a pattern
    std::uint64_t n;
    std::string target, program = "firstray_tests";
};

const TestedRow tested[] = {
    {"T3", "--obb-hits local against root: t p99.9; hit or miss differs, per million; at offsets 0 and 1e6",
     "hits decided*at length", 14'336'000, "<= 2e-5; <= 10"},
    {"T9",
     "random sets of points that are flat, straight, one point or nearly so: points outside of their box, boxes not "
     "right-handed and orthonormal",
     "100*random degenerate sets get*", 100'000, "0"},
    {"T12", "scenes whose voxels up to 64 threads enter at once: built once each, hits of one thread, bytes left",
     "threads that meet*in ten thousand scenes", 10'000, "each; same; 0"},
    {"T12", "engines in one process, a render that fails in the middle: same pictures afterwards",
     "two engines*,a render that*", 2, "same"},
    {"T14", "lazy: whichever allocation fails while rays fly, the hits are the same", "lazy: whichever*", 2844, "same"},
    {"T14", "whichever allocation of a run fails: a clean end or the same pictures", "whichever allocation of a run*",
     2724, "one of them", "firstray_command_tests"},
    {"T14", "killed at any moment: whole frames only; resumed, the same as undisturbed", "killed at any moment*", 59,
     "same", "firstray_command_tests"},
    {"T16", "files of bad input: message with file:line:column and exit code", "every file of bad input*", 246, "exact",
     "firstray_command_tests"},
    {"T16", "ways out of the scene's folder: nothing read outside", "files outside*,a link that*", 2, "none"},
    {"T17", "inputs that fuzzing found or began with, replayed on every target",
     "whatever fuzzing*,bad input, and good*", 5, "no harm", "firstray_command_tests"},
};

/// What a test run said with MESSAGE, in one line.
std::string messages(const std::string& out)
{
    std::istringstream in(out);
    std::string all;
    for (std::string line; std::getline(in, line);) {
        const auto at = line.find("MESSAGE: ");
        if (at != std::string::npos) all += (all.empty() ? "" : "; ") + line.substr(at + 9);
    }
    return all;
}

}  // namespace

void tested_rows(Matrix& matrix)
{
    if (matrix.part() < 1.0) {
        std::fputs("T3, T9, T12, T14, T16, T17: test cases, left out but where --part is 1\n", stderr);
        return;
    }
    for (const TestedRow& row : tested) {
        const Ended ended = run_program(fmt::format("'{}' -nc -ns -s=false '-tc={}'",
                                                    (matrix.programs() / "tests" / row.program).string(), row.test));
        const bool ran =
            ended.out.find("test cases: 0") == std::string::npos && ended.out.find("| 0 passed") == std::string::npos;
        const std::string said = messages(ended.out);
        matrix.add({.id = row.id,
                    .tried = row.tried,
                    .n = row.n,
                    .result = ended.code == 0 && ran ? (said.empty() ? "held" : said) : "test failed",
                    .target = row.target,
                    .met = ended.code == 0 && ran,
                    .known_miss = {}});
    }
}

void mutant_rows(Matrix& matrix)
{
    const auto run = [&](int mutant) {
        const auto program = matrix.programs() / fmt::format("tests/made_once_mutant_{}", mutant);
        return run_program(fmt::format("TSAN_OPTIONS=halt_on_error=1 timeout 120 '{}'", program.string())).code;
    };
    const bool has_them = std::filesystem::exists(matrix.programs() / "tests/made_once_mutant_0");
    const bool is_clean = has_them && run(0) == 0;
    int caught = 0;
    for (int mutant = 1; mutant <= 3 && has_them; ++mutant) caught += run(mutant) != 0;
    matrix.add({.id = "T13",
                .tried = "the word by which threads agree who builds, under ThreadSanitizer: reports as it is; faults "
                         "caught of three put in on purpose",
                .n = 640'000,
                .result = has_them ? fmt::format("{}; {} of 3", is_clean ? "0" : "some", caught) : "not built",
                .target = "0; 3 of 3",
                .met = is_clean && caught == 3,
                .known_miss = has_them ? "" : "this build has no ThreadSanitizer"});
}

}  // namespace firstray::matrix
