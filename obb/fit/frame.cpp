#include "obb/fit/frame.h"

#include <algorithm>

namespace firstray::inline v0::obb {

glm::dvec3 any_perpendicular(const glm::dvec3& v)
{
    const glm::dvec3 size = glm::abs(v);
    glm::dvec3 other(0.0);
    other[size.x <= size.y ? (size.x <= size.z ? 0 : 2) : (size.y <= size.z ? 1 : 2)] = 1.0;
    return glm::normalize(glm::cross(v, other));
}

glm::dmat3 axes_along(const glm::dvec3& edge, const glm::dvec3& across)
{
    const double length = glm::length(edge);
    const glm::dvec3 first = length > 0.0 ? glm::normalize(edge / length) : glm::dvec3(1.0, 0.0, 0.0);
    glm::dvec3 second = across - glm::dot(across, first) * first;
    const double rest = glm::length(second);
    if (rest > 0.0) {  // what is left may be rounding: then it is not at right angles until the second time
        second /= rest;
        second -= glm::dot(second, first) * first;
    }
    second = glm::length(second) > 0.5 ? glm::normalize(second) : any_perpendicular(first);
    return {first, second, glm::cross(first, second)};
}

glm::dmat3 turned(const glm::dmat3& axes, const glm::dvec3& turn)
{
    const double scale = 2.0 / (1.0 + glm::dot(turn, turn));
    glm::dmat3 result;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[i] = 1.0;
        result[i] = unit + scale * glm::cross(turn, unit + glm::cross(turn, unit));
    }
    return axes * result;
}

glm::dvec3 turn_range(const glm::dvec3& size)
{
    static constexpr double eighth = 0.41421356237309503;  // tan(45 degrees / 2)
    const auto range = [](double a, double b) {
        const double longer = std::max(a, b);
        return longer > 0.0 ? std::min(eighth, 0.75 * std::min(a, b) / longer) : 0.0;
    };
    return {range(size.y, size.z), range(size.z, size.x), range(size.x, size.y)};
}

}  // namespace firstray::inline v0::obb
