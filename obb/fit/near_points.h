#pragma once
#include <glm/glm.hpp>

#include <array>

#include "obb/fit/frame.h"

namespace firstray::inline v0::obb {

/// Those of a set of points that may touch the sides of its box when it is turned a little: few, so costs come quickly.
class NearPoints {
public:
    /// limit  how far from `axes` to turn about each of them, as turned()
    NearPoints(const PointSet& points, const glm::dmat3& axes, const glm::dvec3& limit);

    /// Infinite for axes that are turned too far.
    double cost_along(const glm::dmat3& axes) const;

    /// The points that may be farthest along or against an axis.
    const PointSet& along(int axis) const { return points_[static_cast<std::size_t>(axis)]; }

private:
    glm::dmat3 start_;
    glm::dmat3 most_;  ///< sizes of a turned axis' coordinates in the system of `start_`; on the diagonal the least
    std::array<PointSet, 3> points_;
};

}  // namespace firstray::inline v0::obb
