#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/frame.h"
#include "engine/render/texture.h"
#include "engine/scene/scene.h"

namespace firstray::inline v0::image {

/// Bounds on pictures read; larger ones are refused by their header, before a pixel is read.
struct ImageLimits {
    std::uint64_t resolution = 16'384;  ///< per axis
    std::uint64_t bytes = 1ull << 32;   ///< decoded, all textures of a scene together
    std::uint64_t ratio = 2048;         ///< decoded bytes per byte of the file; the formats that are read stay below it
    bool allow_outside = false;         ///< textures may lie outside the scene's folder
};

/// Reads a picture as 8-bit RGB (grey is spread, alpha dropped): PNM, PNG, JPEG, TIFF, TGA, BMP or OpenEXR.
/// throws  FileError, LimitError; the message names the file
Texture read_texture(const std::filesystem::path& file, const ImageLimits& limits = {});

/// Reads all textures of a scene from its folder, in order of Scene::textures. Messages begin with the place in the scene
/// file that names the picture.
std::vector<Texture> read_textures(const Scene& scene, const ImageLimits& limits = {});

/// A layer that write_frame can add to an EXR file.
enum class Aov { distance, primitive, group, cells, tests, time, age };

/// Writes a frame: ".exr" (R G B as float and a channel per AOV, under the AOVs' names) or ".png" (8-bit R G B, no
/// gamma; AOVs are refused). The file appears by rename, complete or not at all. Folders that do not exist are made.
/// attributes  text stored in the file's header, name and value (e.g. "firstray:frame", "12")
/// throws      FileError
void write_frame(const std::filesystem::path& file, const Frame& frame, std::span<const Aov> aovs,
                 std::span<const std::pair<std::string, std::string>> attributes = {});

/// Whether a file holds a picture that can be read to its end and has all these attributes in its header.
bool is_whole_frame(const std::filesystem::path& file,
                    std::span<const std::pair<std::string, std::string>> attributes);

/// The bytes of the file that write_frame would write as ".png".
std::string png_of(const Frame& frame);

}  // namespace firstray::inline v0::image
