#pragma once
#include <vector>

#include "engine/scene/scene.h"
#include "scenes/generator/mesh.h"
#include "scenes/generator/walker.h"

namespace firstray::scenes {

struct PaintedMesh {
    Material material;
    Mesh mesh;
};

/// The rigid parts of a walker, each in the system of its joint: limbs hang down from it, the front is +z.
struct WalkerParts {
    std::vector<PaintedMesh> hips, torso, head, antenna, upper_arm, forearm, hand, thigh, shin, foot, toe;
};

WalkerParts walker_parts(const Paint& paint);

}  // namespace firstray::scenes
