#pragma once
#include <glm/glm.hpp>

#include <vector>

#include "obb/fit/point_set.h"

namespace firstray::inline v0::obb {

/// How wide a set of points is in any direction, to about 1 %, at a price that does not depend on their number. Widths
/// on a grid over three faces of a cube are tabulated, in a space where the points' box along `axes` is a cube.
class WidthTable {
public:
    WidthTable(const PointSet& points, const glm::dmat3& axes);

    /// direction  unit length, in the system of `axes`
    double width(const glm::dvec3& direction) const
    {
        const glm::dvec3 v = direction * stretch_;
        const glm::dvec3 size = glm::abs(v);
        const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        const double half = 0.5 * cells;
        const double along = v[axis];
        if (along == 0.0) return 0.0;
        const double s = (v[next(axis)] / along + 1.0) * half, t = (v[next(next(axis))] / along + 1.0) * half;
        const int i = s < cells - 1 ? static_cast<int>(s) : cells - 1,
                  k = t < cells - 1 ? static_cast<int>(t) : cells - 1;
        const float* node = &widths_[static_cast<std::size_t>((axis * nodes + k) * nodes + i)];
        const double a = s - i, b = t - k;
        const double near = node[0] + a * (node[1] - node[0]);
        const double far = node[nodes] + a * (node[nodes + 1] - node[nodes]);
        return size[axis] * (near + b * (far - near));
    }

private:
    static constexpr int cells = 24, nodes = cells + 1;  ///< along a side of the cube
    static constexpr int next(int axis) { return axis == 2 ? 0 : axis + 1; }

    glm::dvec3 stretch_;  ///< the box's size
    std::vector<float> widths_;
};

}  // namespace firstray::inline v0::obb
