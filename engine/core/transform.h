#pragma once
#include <glm/glm.hpp>

namespace firstray::inline v0 {

/// An affine map p -> linear * p + offset, in double: poses and ray transforms never run in float.
struct Transform {
    glm::dmat3 linear{1.0};  ///< columns: where the axes go
    glm::dvec3 offset{0.0};  ///< where the origin goes

    glm::dvec3 point(const glm::dvec3& p) const { return linear * p + offset; }  ///< where a point goes
    glm::dvec3 vector(const glm::dvec3& v) const { return linear * v; }          ///< where a difference of points goes
};

/// a_from_b * b_from_c = a_from_c.
inline Transform operator*(const Transform& a, const Transform& b)
{
    return {a.linear * b.linear, a.linear * b.offset + a.offset};
}

/// Turns counter-clockwise about an axis of unit length; angle in radians.
glm::dmat3 rotation_about(const glm::dvec3& axis, double angle);

/// Whether the map squeezes space into a plane, a line or a point (or is not finite), so that it has no usable inverse.
bool is_singular(const Transform& t);

/// The inverse map. Only for maps that are not singular.
Transform inverse(const Transform& t);

/// Maps normals: the inverse transpose of `linear`, up to a positive factor; defined for singular maps too.
glm::dmat3 normal_matrix(const Transform& t);

}  // namespace firstray::inline v0
