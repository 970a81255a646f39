#include "bench/firstray/output_pattern.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

constexpr std::string_view aov_names[] = {"distance", "primitive", "group", "cells", "tests", "time", "age"};
constexpr image::Aov aovs_by_name[] = {image::Aov::distance, image::Aov::primitive, image::Aov::group,
                                       image::Aov::cells,    image::Aov::tests,     image::Aov::time,
                                       image::Aov::age};

}  // namespace

std::vector<image::Aov> parse_aovs(std::string_view text)
{
    std::vector<image::Aov> aovs;
    if (text.empty()) return aovs;
    for (const std::string_view name : split(text, ',')) {
        const image::Aov aov = aovs_by_name[find_word("--aov", name, aov_names)];
        if (std::find(aovs.begin(), aovs.end(), aov) != aovs.end())
            throw UsageError(fmt::format("--aov: {} is listed twice", name));
        aovs.push_back(aov);
    }
    return aovs;
}

bool any_cost(std::span<const image::Aov> aovs)
{
    return std::any_of(aovs.begin(), aovs.end(), [](image::Aov aov) {
        return aov == image::Aov::cells || aov == image::Aov::tests || aov == image::Aov::time;
    });
}

void check_pattern(const std::string& pattern, std::size_t frames, bool layers)
{
    const auto extension = std::filesystem::path(pattern).extension();
    if (extension != ".exr" && extension != ".png")
        throw UsageError(fmt::format("--output: '{}', expected a name that ends in .exr or .png", pattern));
    if (layers && extension == ".png")
        throw UsageError(fmt::format("--output: '{}' cannot hold the layers of --aov, expected .exr", pattern));
    const std::size_t first = pattern.find('#');
    if (first == std::string::npos) {
        if (frames > 1)
            throw UsageError(
                fmt::format("--output: '{}' names one file for {} frames, expected a run of #", pattern, frames));
        return;
    }
    const std::size_t end = pattern.find_first_not_of('#', first);
    if (pattern.find('#', end) != std::string::npos)
        throw UsageError(fmt::format("--output: '{}', expected a single run of #", pattern));
}

std::filesystem::path frame_file(const std::string& pattern, int frame)
{
    const std::size_t first = pattern.find('#');
    if (first == std::string::npos) return pattern;
    const std::size_t end = std::min(pattern.find_first_not_of('#', first), pattern.size());
    return pattern.substr(0, first) + fmt::format("{:0{}}", frame, end - first) + pattern.substr(end);
}

}  // namespace firstray::command
