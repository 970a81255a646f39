#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/core/transform.h"

namespace firstray::scenes {

/// Triangles with indices of their own into positions, normals and texture coordinates, as AFF has them. Outsides are
/// wound counter-clockwise. Normals and uvs are there for all triangles or for none.
struct Mesh {
    struct Triangle {
        glm::uvec3 vertex{0}, normal{0}, uv{0};
    };
    std::vector<glm::dvec3> positions, normals;  ///< normals: unit length
    std::vector<glm::dvec2> uvs;
    std::vector<Triangle> triangles;
};

/// Adds a copy of `part` (with as many lists filled as `mesh`), moved.
void append(Mesh& mesh, const Mesh& part, const Transform& mesh_from_part = {});
/// Rounds positions to multiples of `step`, normals and uvs to 1/100: short to write.
void snap(Mesh& mesh, double step);

/// The triangles whose middle `keep` accepts, without what they do not use.
Mesh part_of(const Mesh& mesh, const std::function<bool(const glm::dvec3&)>& keep);

/// A flat quadrilateral a, b, c, d, counter-clockwise; with texture coordinates 0 ... size if `mesh` has any, or if
/// `size` is not 0 and it is empty.
void add_quad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
              const glm::dvec2& size = glm::dvec2(0.0));
/// The six sides of a box, flat, no texture coordinates.
void add_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high);

/// A smooth box of the given half sizes whose edges are rounded with `radius` in `steps` >= 1 steps;
/// 12 (2 steps + 1)^2 triangles.
Mesh rounded_box(const glm::dvec3& half, double radius, int steps);

/// A profile (radius, height), going up, turned about y in `around` steps. Bends of more than 40 degrees stay sharp;
/// ends of radius 0 close it. No texture coordinates.
Mesh lathe(std::span<const glm::dvec2> profile, int around);
Mesh ball(double radius, int rings, int around);

/// A round tube along a path; smooth, open at its ends.
/// radius  at each point of the path
Mesh tube(std::span<const glm::dvec3> path, std::span<const double> radius, int around);

/// A smooth surface over [0, 1]^2 in nu x nv cells, triangles counter-clockwise where u points right and v up; normals
/// by differences. With texture coordinates u, v times `uv_scale`, or none where that is 0.
Mesh surface(int nu, int nv, const std::function<glm::dvec3(double, double)>& position,
             const glm::dvec2& uv_scale = glm::dvec2(0.0));

/// Moves things: a shift; a turn about an axis (degrees); a size.
Transform shift(const glm::dvec3& offset);
Transform turn(const glm::dvec3& axis, double degrees);
Transform size(const glm::dvec3& factors);

}  // namespace firstray::scenes
