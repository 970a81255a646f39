#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/scene/scene.h"
#include "engine/strategy/strategy.h"

namespace firstray {

/// A kind of scene that can be made in any size.
struct MadeScene {
    std::string_view name;
    /// triangles  about how many, >= 2
    /// deforms    every triangle has two keys, one second apart; otherwise all of it is static
    Scene (*make)(std::size_t triangles, bool deforms);
};

/// `terrain`: hills with boulders on them, a surface whose triangles share their corners. `cloud`: triangles on their
/// own, spread evenly through a cube.
std::span<const MadeScene> made_scenes();

/// 256 rays from a pose's camera, in blocks of 4 x 4.
/// common_apex  a beam; otherwise they go one by one
std::unique_ptr<RayTile<float>> small_picture(const Pose& now, bool common_apex = true);

/// Makes rays that were searched for fit to be searched for again.
void reset(RayTile<float>& tile);

/// Throws Error unless rays hit what they should, or as far away, give or take the peers' rounding.
void check_hits(const RayTile<float>& found, const RayTile<float>& right, const std::string& name);

}  // namespace firstray
