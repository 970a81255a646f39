#include "obb/fit/near_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace firstray::inline v0::obb {
namespace {

glm::dmat3 largest_coordinates(const glm::dvec3& limit)
{
    glm::dmat3 most;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        most[i][i] = std::max(0.0, 1.0 - 2.0 * (limit[j] * limit[j] + limit[k] * limit[k]));
        most[i][j] = 2.0 * (limit[k] + limit[i] * limit[j]);
        most[i][k] = 2.0 * (limit[j] + limit[i] * limit[k]);
    }
    return most;
}

}  // namespace

NearPoints::NearPoints(const PointSet& points, const glm::dmat3& axes, const glm::dvec3& limit)
    : start_(axes), most_(largest_coordinates(limit))
{
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const ExtremePair pair = extreme_pair(points, axes[i]);
        const glm::dvec3 ends[] = {points[pair.least], points[pair.most]};
        const auto may_pass = [&](const glm::dvec3& p, const glm::dvec3& end) {
            const glm::dvec3 d = p - end;
            return most_[i][i] * std::abs(glm::dot(d, axes[i])) <=
                   most_[i][j] * std::abs(glm::dot(d, axes[j])) + most_[i][k] * std::abs(glm::dot(d, axes[k]));
        };
        for (std::size_t n = 0; n < points.size(); ++n)
            if (const glm::dvec3 p = points[n]; may_pass(p, ends[0]) || may_pass(p, ends[1]))
                points_[static_cast<std::size_t>(i)].push_back(p);
    }
}

double NearPoints::cost_along(const glm::dmat3& axes) const
{
    const glm::dmat3 turn = glm::transpose(start_) * axes;
    glm::dvec3 size;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const bool is_near =
            turn[i][i] >= most_[i][i] && std::abs(turn[i][j]) <= most_[i][j] && std::abs(turn[i][k]) <= most_[i][k];
        if (!is_near) return std::numeric_limits<double>::infinity();  // and where axes are not numbers
        size[i] = width_along(along(i), axes[i]);
    }
    return cost_of(size);
}

}  // namespace firstray::inline v0::obb
