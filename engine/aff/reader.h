#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/scene/scene.h"

namespace firstray::inline v0 {

/// Bounds on what a scene file may ask for; a file that asks for more is refused with LimitError, which names the field.
struct ReadLimits {
    std::uint64_t include_depth = 32;           ///< files inside each other
    std::uint64_t transform_depth = 1024;       ///< transforms inside each other
    std::uint64_t files = 4096;                 ///< executed includes may repeat files; this counts distinct ones
    std::uint64_t file_bytes = 1u << 30;        ///< of one file
    std::uint64_t expanded_bytes = 1ull << 32;  ///< of text, counting a file each time it is included
    std::uint64_t primitives = 1u << 30;        ///< of the scene
    std::uint64_t vertices = 1u << 30;          ///< normals and texture coordinates are bounded by it too, each
    std::uint64_t transforms = 1u << 24;        ///< of the scene
    std::uint64_t lights = 65'536;              ///< of the scene
    std::uint64_t textures = 65'536;            ///< distinct names
    std::uint64_t keys = 1'000'000;             ///< of one track
    std::uint64_t resolution = 16'384;          ///< of the view, per axis
    bool allow_outside = false;                 ///< includes and textures may lie outside the main file's folder
};

/// Reads an AFF scene (Animated File Format, BART 2000) with everything it includes.
/// main_file  includes and textures are found in its folder
/// throws     FileError when a file cannot be read, SceneError for what is wrong in one, LimitError
Scene read_aff(const std::filesystem::path& main_file, const ReadLimits& limits = {});

}  // namespace firstray::inline v0
