#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/firstray/jobs.h"
#include "engine/render/texture.h"

namespace firstray::command {

/// Name and value of what a frame's file records of where it came from.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// What all frames of a run record: the version, a digest of all text and texture pixels that were read, and settings.
/// settings  every one that the picture may depend on, so neither threads nor places of files
Attributes run_attributes(const Scene& scene, std::span<const Texture> textures, const std::string& settings);

/// Which frames of a run are still to be rendered.
struct Resumption {
    std::vector<int> missing;    ///< in the order they were asked for, those whose files are of another run included
    std::size_t kept = 0;        ///< whole, and of the same scene and settings
    std::size_t of_another = 0;  ///< there, but not that
};

/// Looks at the files that are there; removes what runs that were killed have left beside them.
/// pattern  of the files, as --output gives it
/// run      as run_attributes tells; the frame's own attribute is added here
Resumption resume(std::span<const int> frames, const std::string& pattern, const Attributes& run);

/// A run's attributes and the frame's own.
Attributes frame_attributes(const Attributes& run, int frame);

}  // namespace firstray::command
