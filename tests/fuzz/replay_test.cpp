#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/targets.h"

using namespace firstray;

namespace {

/// Files below a folder of the project, in order; tests run in its root.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

void run(const fuzz::Target& target, const std::filesystem::path& file)
{
    CAPTURE(target.name);
    CAPTURE(file.string());
    std::ifstream in(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
    CHECK_NOTHROW(target.run(bytes));
}

}  // namespace

TEST_CASE("whatever fuzzing has found, and its seeds, do no harm any more")
{
    for (const fuzz::Target& target : fuzz::targets) {
        const auto folder = std::filesystem::path("tests/fuzz/corpus") / target.name;
        const std::vector<std::filesystem::path> files = files_in(folder);
        CHECK(!files.empty());
        for (const std::filesystem::path& file : files) run(target, file);
    }
}

TEST_CASE("bad input, and good, does no harm to the fuzz targets of scenes and pictures")
{
    for (const char* folder : {"tests/bad_input", "scenes"})
        for (const std::filesystem::path& file : files_in(folder)) {
            run(fuzz::targets[0], file);
            run(fuzz::targets[3], file);
        }
}
