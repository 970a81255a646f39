#include "engine/primitive/triangle_box.h"

#include <algorithm>

#include "engine/primitive/triangle.h"

namespace firstray::inline v0 {

TriangleBoxOverlap::TriangleBoxOverlap(const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2,
                                       const glm::vec3& size)
{
    const glm::vec3 v[3] = {v0, v1, v2};
    const glm::vec3 e[3] = {v1 - v0, v2 - v1, v0 - v2};
    normal_ = glm::cross(e[0], e[1]);

    const glm::vec3 reach = normal_ * size;
    const float plane = glm::dot(normal_, v0);
    // A sliver's normal is mostly rounding: each component is off by up to 6 half ulps of edge^2, which tilts the
    // plane.
    const float longest = longest_edge<float>(v0, v1, v2);
    const float tilt = 0x1p-19f * longest * longest * (longest + std::max(std::max(size.x, size.y), size.z));
    nearest_ = plane - (std::max(reach.x, 0.0f) + std::max(reach.y, 0.0f) + std::max(reach.z, 0.0f)) - tilt;
    farthest_ = plane - (std::min(reach.x, 0.0f) + std::min(reach.y, 0.0f) + std::min(reach.z, 0.0f)) + tilt;

    const float uncertain = 0x1p-21f * longest * longest;
    for (int axis = 0; axis < 3; ++axis) {
        const int p = (axis + 1) % 3, q = (axis + 2) % 3;
        // Along an axis from which the triangle is seen edge-on, its corners may turn either way; its plane says as much.
        if (std::abs(normal_[axis]) <= uncertain) continue;
        const float turn = normal_[axis] < 0.0f ? -1.0f : 1.0f;
        for (int i = 0; i < 3; ++i) {
            Edge& edge = edges_[axis][i];
            edge.a = -e[i][q] * turn;
            edge.b = e[i][p] * turn;
            edge.c = -(edge.a * v[i][p] + edge.b * v[i][q]) + std::max(0.0f, size[p] * edge.a) +
                     std::max(0.0f, size[q] * edge.b);
        }
    }
}

bool TriangleBoxOverlap::meets(const glm::vec3& lo) const
{
    const float at = glm::dot(normal_, lo);
    if (at < nearest_ || at > farthest_) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const float p = lo[(axis + 1) % 3], q = lo[(axis + 2) % 3];
        for (const Edge& edge : edges_[axis])
            if (edge.a * p + edge.b * q + edge.c < 0.0f) return false;
    }
    return true;
}

}  // namespace firstray::inline v0
