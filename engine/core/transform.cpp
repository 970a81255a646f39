#include "engine/core/transform.h"

#include <algorithm>
#include <cmath>

namespace firstray::inline v0 {
namespace {

double largest_entry(const glm::dmat3& m)
{
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
    return largest;
}

/// Columns of the cofactor matrix: det(m) times the inverse transpose, computed without a division.
glm::dmat3 cofactors(const glm::dmat3& m)
{
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

}  // namespace

glm::dmat3 rotation_about(const glm::dvec3& axis, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dvec3 a = axis, b = (1.0 - c) * axis;
    return {{c + a.x * b.x, a.x * b.y + s * a.z, a.x * b.z - s * a.y},
            {a.y * b.x - s * a.z, c + a.y * b.y, a.y * b.z + s * a.x},
            {a.z * b.x + s * a.y, a.z * b.y - s * a.x, c + a.z * b.z}};
}

bool is_singular(const Transform& t)
{
    const double scale = largest_entry(t.linear);
    if (!(scale > 0.0) || !std::isfinite(scale)) return true;
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(t.offset[axis])) return true;
    // Scaled so that the largest entry is 1: the test then does not depend on the unit of length.
    return std::abs(glm::determinant(t.linear / scale)) < 1e-14;
}

Transform inverse(const Transform& t)
{
    const double scale = largest_entry(t.linear);
    const glm::dmat3 unit = t.linear / scale;  // keeps the determinant away from overflow and underflow
    const glm::dmat3 linear = glm::transpose(cofactors(unit)) / (glm::determinant(unit) * scale);
    return {linear, -(linear * t.offset)};
}

glm::dmat3 normal_matrix(const Transform& t)
{
    const double sign = glm::determinant(t.linear) < 0.0 ? -1.0 : 1.0;
    return cofactors(t.linear) * sign;
}

}  // namespace firstray::inline v0
