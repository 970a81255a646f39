#include "engine/grid/resolution.h"

#include <algorithm>
#include <cmath>

namespace firstray::inline v0 {

glm::ivec3 choose_grid_dims(const glm::vec3& size, std::size_t prim_count, float density)
{
    const glm::dvec3 length(size);
    const double longest = std::max({length.x, length.y, length.z});
    if (!(longest > 0.0) || !std::isfinite(length.x + length.y + length.z)) return glm::ivec3(1);
    // An axis that comes out below one cell is pinned to one, and the others share what it does not use.
    bool pinned[3] = {};
    const double cells = std::max(1.0, static_cast<double>(density) * static_cast<double>(prim_count));
    glm::dvec3 dims(1.0);
    for (bool changed = true; changed;) {
        changed = false;
        int open = 0;
        double product = 1.0;  // of lengths relative to the longest, which keeps it in range
        for (int axis = 0; axis < 3; ++axis)
            if (!pinned[axis]) {
                ++open;
                product *= std::max(length[axis] / longest, 1e-30);
            }
        for (int axis = 0; axis < 3 && open > 0; ++axis) {
            if (pinned[axis]) continue;
            dims[axis] = length[axis] / longest * std::pow(cells / product, 1.0 / open);
            if (dims[axis] < 1.0 && open > 1) {
                dims[axis] = 1.0;
                pinned[axis] = changed = true;
                break;
            }
        }
    }
    glm::ivec3 rounded;
    for (int axis = 0; axis < 3; ++axis)
        rounded[axis] = static_cast<int>(std::clamp(std::round(dims[axis]), 1.0, static_cast<double>(max_grid_dim)));
    return rounded;
}

}  // namespace firstray::inline v0
