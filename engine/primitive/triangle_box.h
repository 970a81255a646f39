#pragma once
#include <glm/glm.hpp>

#include "engine/core/aabb.h"

namespace firstray::inline v0 {

/// The overlap of one triangle and many boxes of one size: what does not depend on the box is computed once.
/// Conservative: a box that the triangle touches is never denied, given boxes enlarged by more than 16 half ulps of the
/// largest coordinate.
/// source  M. Schwarz, H.-P. Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs", SIGGRAPH Asia 2010
class TriangleBoxOverlap {
public:
    /// size  of every box that will be asked about
    TriangleBoxOverlap(const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2, const glm::vec3& size);

    /// Whether the triangle's plane and its three projections meet the box with this lower corner; the caller has
    /// compared the triangle's bounds with the box already.
    bool meets(const glm::vec3& lo) const;

private:
    struct Edge {
        float a = 0.0f, b = 0.0f, c = 0.0f;  ///< inside where a * p + b * q + c >= 0, for the box's most inner corner
    };
    glm::vec3 normal_;
    float nearest_, farthest_;  ///< bounds on -normal . lo
    Edge edges_[3][3];          ///< by projection along axis, by edge
};

}  // namespace firstray::inline v0
