#include "obb/placing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/strategy/group_bounds.h"
#include "obb/smallest_obb.h"

namespace firstray::inline v0::obb {
namespace {

/// Columns made orthonormal, the first keeping its direction; right-handed.
glm::dmat3 orthonormal(const glm::dmat3& axes)
{
    const glm::dvec3 x = glm::normalize(axes[0]), y = glm::normalize(axes[1] - glm::dot(axes[1], x) * x);
    const glm::dmat3 result(x, y, glm::cross(x, y));
    const bool is_sane = std::isfinite(x.x + x.y + x.z + y.x + y.y + y.z);
    return is_sane ? result : glm::dmat3(1.0);
}

}  // namespace

BoxPlace place_box(const BoxSystem& box, const Transform& root_from_node, const Transform& node_from_root)
{
    BoxPlace place{.is_there = !box.bounds.empty(), .bounds = box.bounds};
    if (!place.is_there) return place;
    place.local_from_root = box.local_from_node * node_from_root;
    place.root_from_local = root_from_node * box.node_from_local;
    place.largest = largest_coordinate(transformed(place.bounds, place.root_from_local));
    const double size = size_of(place.root_from_local.linear);
    place.loose = static_cast<float>(
        std::min(size * size * size / std::abs(glm::determinant(place.root_from_local.linear)), 1e30));
    return place;
}

Fit fit_of(const BoxPlace& place, float blur)
{
    // With factors of more than 1024 the floats of rays in the box would leave the range where they are fine.
    constexpr int scale_step = 20;
    constexpr double most_distorted = 1024.0;
    const double grown = size_of(place.root_from_local.linear), shrunk = size_of(place.local_from_root.linear);
    if (!(grown * shrunk < most_distorted)) return {.is_distorted = true};
    Fit fit{.scale = scale_step * static_cast<int>(std::lround(std::log2(grown) / scale_step))};
    const double needed = std::ldexp(blur_of(place.local_from_root.linear, place.largest), fit.scale),
                 made = std::max(static_cast<double>(blur), 1e-37);
    if (needed > made) fit.blur = static_cast<int>(std::ceil(std::log2(needed / made) / 2.0));
    return fit;
}

BoxPlace place_in_root(const Box& box)
{
    BoxPlace place{.is_there = !box.bounds.empty(), .bounds = box.bounds};
    if (place.is_there) place.largest = largest_coordinate(place.bounds);
    return place;
}

glm::dmat3 choose_axes(std::span<const BoxPlace> places, const glm::dmat3& node_from_root)
{
    std::vector<glm::dvec3> corners;
    for (const BoxPlace& place : places) {
        if (!place.is_there) continue;
        for (int corner = 0; corner < 8; ++corner)
            corners.push_back(place.root_from_local.point({corner & 1 ? place.bounds.hi.x : place.bounds.lo.x,
                                                           corner & 2 ? place.bounds.hi.y : place.bounds.lo.y,
                                                           corner & 4 ? place.bounds.hi.z : place.bounds.lo.z}));
    }
    return node_from_root * smallest_obb(corners).axes;
}

ClusterBox fit_cluster(const glm::dmat3& axes, std::span<const BoxPlace> places)
{
    ClusterBox box{orthonormal(axes), {}};
    for (const BoxPlace& place : places) {
        if (!place.is_there) continue;
        const glm::dvec3 centre = place.root_from_local.point((place.bounds.lo + place.bounds.hi) * 0.5),
                         half = place.bounds.size() * 0.5;
        for (int i = 0; i < 3; ++i) {
            const double middle = glm::dot(box.axes[i], centre);
            double reach = 0.0;
            for (int j = 0; j < 3; ++j)
                reach += std::abs(glm::dot(box.axes[i], place.root_from_local.linear[j])) * half[j];
            box.bounds.lo[i] = std::min(box.bounds.lo[i], middle - reach);
            box.bounds.hi[i] = std::max(box.bounds.hi[i], middle + reach);
        }
    }
    return box;
}

}  // namespace firstray::inline v0::obb
