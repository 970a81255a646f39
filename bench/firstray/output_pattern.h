#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/image/image.h"

namespace firstray::command {

/// Reads "distance,primitive,...", each at most once; an empty text is no layer.
/// throws  UsageError
std::vector<image::Aov> parse_aovs(std::string_view text);

/// Whether any of the layers is a cost, which rendering counts only when asked.
bool any_cost(std::span<const image::Aov> aovs);

/// Refuses a pattern that the pictures to come do not fit: one file for several frames, layers in a PNG, another
/// format.
/// throws  UsageError
void check_pattern(const std::string& pattern, std::size_t frames, bool layers);

/// The pattern with its run of # replaced by the frame's number, padded with zeros to the run's length.
std::filesystem::path frame_file(const std::string& pattern, int frame);

}  // namespace firstray::command
