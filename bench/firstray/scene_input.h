#pragma once
#include <string>
#include <vector>

#include "bench/firstray/jobs.h"
#include "engine/aff/reader.h"
#include "engine/image/image.h"

namespace firstray::command {

/// Bounds on what a scene and its textures may ask for.
struct InputLimits {
    ReadLimits scene;
    image::ImageLimits textures;
};

/// The defaults, and what --limit and --allow-outside change.
/// throws  UsageError
InputLimits limits_of(const SceneChoice& choice);

/// throws  UsageError, FileError, SceneError, LimitError
Scene read_scene(const SceneChoice& choice);
std::vector<Texture> read_textures(const Scene& scene, const SceneChoice& choice);

}  // namespace firstray::command
