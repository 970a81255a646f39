#pragma once
#include "scenes/generator/aff_writer.h"
#include "scenes/generator/generate.h"

namespace firstray::scenes {

inline constexpr double plinth_height = 0.85;

/// A room of 11 x 11 x 4.8 m around the origin, the floor at y = 0: a plinth in the middle with ropes around it,
/// pictures on the walls, benches. Writes its textures beside the scene.
void write_gallery(AffWriter& out, const Request& request);

}  // namespace firstray::scenes
