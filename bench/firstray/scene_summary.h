#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace firstray::command {

/// How a group moves in the course of its animation.
struct GroupMotion {
    std::string name;  ///< its transform's; "deforming" where it has none
    std::uint64_t primitives = 0;
    bool deforms = false;
    double reach = 0.0;  ///< farthest that its middle gets from where it was first seen, world units; 0: stays
};

/// What moves in a scene.
struct SceneMotion {
    std::vector<GroupMotion> movers;                    ///< all groups but the scenery, most primitives first
    std::uint64_t still = 0, rigid = 0, deforming = 0;  ///< primitives: of groups that do not move, do, deform
    std::uint64_t total() const { return still + rigid + deforming; }
};

/// Looks at poses spread over the animation.
SceneMotion motion_of(const Scene& scene);

/// A strategy for a scene, and why.
struct Recommendation {
    std::string strategy, reason;
};

/// The rule of README's table of strategies.
/// rays  primary rays a frame
Recommendation recommend(const SceneMotion& motion, std::uint64_t rays);

}  // namespace firstray::command
