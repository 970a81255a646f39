#include "obb/fit/width_table.h"

#include <array>
#include <limits>

namespace firstray::inline v0::obb {

WidthTable::WidthTable(const PointSet& points, const glm::dmat3& axes)
{
    const DAabb box = bounds_along(points, axes);
    stretch_ = box.size();
    glm::dvec3 unit(0.0);
    for (int i = 0; i < 3; ++i) unit[i] = stretch_[i] > 0.0 ? 1.0 / stretch_[i] : 0.0;
    std::vector<glm::vec3> cube;
    cube.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        cube.emplace_back(
            (glm::dvec3(glm::dot(points[i], axes[0]), glm::dot(points[i], axes[1]), glm::dot(points[i], axes[2])) -
             (box.lo + box.hi) * 0.5) *
            unit);
    widths_.reserve(3 * nodes * nodes);
    std::array<float, nodes> steps, least, most;
    for (int i = 0; i < nodes; ++i) steps[static_cast<std::size_t>(i)] = 2.0f * static_cast<float>(i) / cells - 1.0f;
    for (int axis = 0; axis < 3; ++axis)
        for (const float t : steps) {
            least.fill(std::numeric_limits<float>::max());
            most.fill(-std::numeric_limits<float>::max());
            for (const glm::vec3& p : cube) {
                const float at = p[axis] + t * p[next(next(axis))], slope = p[next(axis)];
                for (std::size_t i = 0; i < nodes; ++i) {
                    const float v = at + slope * steps[i];
                    least[i] = v < least[i] ? v : least[i];
                    most[i] = v > most[i] ? v : most[i];
                }
            }
            for (std::size_t i = 0; i < nodes; ++i) widths_.push_back(most[i] - least[i]);
        }
}

}  // namespace firstray::inline v0::obb
