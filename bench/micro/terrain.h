#pragma once
#include "engine/scene/scene.h"

namespace firstray {

/// Hills with boulders on them, seen from above: a made scene of any size for measurements.
/// triangles  about how many, >= 2
/// deforms    every triangle has two keys, one second apart; otherwise all of it is static
Scene make_terrain(std::size_t triangles, bool deforms);

}  // namespace firstray
