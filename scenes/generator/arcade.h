#pragma once
#include "scenes/generator/aff_writer.h"
#include "scenes/generator/generate.h"

namespace firstray::scenes {

inline constexpr double bay_length = 5.0;  // metres along the street between columns

/// A shopping street under a glass roof: 12 m wide, along z from 0 to -bays * bay_length, the floor at y = 0. Shop
/// windows mirror, the roof lets light through. Writes its textures beside the scene.
void write_arcade(AffWriter& out, const Request& request, int bays);

}  // namespace firstray::scenes
