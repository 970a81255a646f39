#include <algorithm>
#include <cmath>

#include "engine/aff/polygon.h"
#include "engine/aff/statements.h"

namespace firstray::inline v0 {
namespace {

/// Two vectors at right angles to a unit vector and to each other, right-handed: x, y, z.
/// source  T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017
glm::dmat3 basis_around(const glm::dvec3& z)
{
    const double sign = std::copysign(1.0, z.z);
    const double a = -1.0 / (sign + z.z), b = z.x * z.y * a;
    return {{1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

std::uint32_t read_texture(Reading& r)
{
    const std::string name = r.in.word("a texture's file name");
    r.folder.check(name, r.in);
    return r.builder.texture(name, r.in);
}

void read_polygon_corners(Reading& r, bool with_normals)
{
    const std::size_t count = r.in.count(3, "a number of corners of at least 3");
    r.builder.check_room(count - 2, r.in);
    TriangleList list;
    for (std::size_t i = 0; i < count; ++i) {
        list.positions.push_back(r.in.point());
        if (with_normals) list.normals.push_back(r.in.point());
    }
    if (count > max_concave_corners && !is_convex(list.positions))
        r.in.statement_fault("concave polygon of " + std::to_string(count) + " corners",
                             "at most " + std::to_string(max_concave_corners));
    for (const glm::uvec3& corners : triangulate(list.positions))
        list.triangles.push_back({corners, with_normals ? corners : glm::uvec3(none), glm::uvec3(none)});
    r.builder.add(std::move(list), r.in);
}

void read_textured_corners(Reading& r, bool with_normals)
{
    TriangleList list;
    list.texture = read_texture(r);
    for (int k = 0; k < 3; ++k) {
        list.positions.push_back(r.in.point());
        if (with_normals) list.normals.push_back(r.in.point());
        list.uvs.push_back(r.in.vec2());
    }
    const glm::uvec3 corners(0, 1, 2);
    list.triangles.push_back({corners, with_normals ? corners : glm::uvec3(none), corners});
    r.builder.add(std::move(list), r.in);
}

/// "vertices 8", "normals 12" ...: the count, with room made for as many as the file can still hold.
template <typename Value>
std::size_t read_list_count(Lexer& in, std::vector<Value>& list)
{
    const std::size_t count = in.count(0, "a count of at least 0");
    list.reserve(std::min(count, in.remaining() / 4));  // at least two numbers each
    return count;
}

template <typename Value>
std::size_t read_vertex_count(Reading& r, std::vector<Value>& list)
{
    const std::size_t count = read_list_count(r.in, list);
    r.builder.check_vertices(count, 0, r.in);
    return count;
}

void read_points(Reading& r, std::vector<glm::dvec3>& points)
{
    for (std::size_t left = read_vertex_count(r, points); left > 0; --left) points.push_back(r.in.point());
}

glm::uvec3 read_indices(Lexer& in, std::size_t size, const char* what)
{
    const std::uint32_t a = in.index_below(size, what), b = in.index_below(size, what), c = in.index_below(size, what);
    return {a, b, c};
}

}  // namespace

Transform read_transform(Lexer& in)
{
    const glm::dvec3 scale = in.point();
    if (scale.x * scale.y * scale.z == 0.0) in.statement_fault("scale factor 0", "three factors other than 0");
    const glm::dvec3 axis = in.point();
    const double angle = in.number();
    Transform result;
    if (glm::length(axis) > 0.0)
        result.linear = rotation_about(glm::normalize(axis), glm::radians(angle));
    else if (angle != 0.0)
        in.statement_fault("rotation about the axis 0 0 0", "an axis other than zero");
    result.offset = in.point();
    for (int i = 0; i < 3; ++i) result.linear[i] *= scale[i];
    return result;
}

/// Base and apex, no caps. A negative base radius turns both signs and leaves only the inside visible.
void read_cone(Reading& r)
{
    const glm::dvec3 base = r.in.point();
    double r0 = r.in.number();
    const glm::dvec3 apex = r.in.point();
    double r1 = r.in.number();
    Quadric cone;
    cone.kind = Quadric::Kind::cone;
    cone.inside_only = r0 < 0.0 || (r0 == 0.0 && r1 < 0.0);
    if (cone.inside_only) r0 = -r0, r1 = -r1;
    if (r1 < 0.0) r.in.statement_fault("cone with radii of different sign", "radii of the same sign");
    const double widest = std::max(r0, r1), length = glm::length(apex - base);
    if (!(widest > 0.0)) r.in.statement_fault("cone with two radii of 0", "a radius other than 0");
    if (!(length > 0.0)) r.in.statement_fault("cone whose ends are one point", "two different points");
    cone.r0 = r0 / widest;
    cone.r1 = r1 / widest;
    const glm::dmat3 basis = basis_around((apex - base) / length);
    cone.group_from_quadric = {{basis[0] * widest, basis[1] * widest, apex - base}, base};
    r.builder.add(cone, r.in);
}

void read_sphere(Reading& r)
{
    Quadric sphere;
    sphere.group_from_quadric.offset = r.in.point();
    const double radius = r.in.number();
    if (radius == 0.0) r.in.fault("a radius other than 0");
    sphere.inside_only = radius < 0.0;
    sphere.group_from_quadric.linear = glm::dmat3(std::abs(radius));
    r.builder.add(sphere, r.in);
}

void read_polygon(Reading& r)
{
    read_polygon_corners(r, false);
}

void read_polygon_with_normals(Reading& r)
{
    read_polygon_corners(r, true);
}

void read_textured_triangle(Reading& r)
{
    read_textured_corners(r, false);
}

void read_textured_triangle_with_normals(Reading& r)
{
    read_textured_corners(r, true);
}

void read_deforming_triangle(Reading& r)
{
    const std::size_t count = r.in.count(1, "a number of keys of at least 1");
    if (count > r.limits.keys) r.in.over_limit("keys in one track", r.limits.keys, "keys");
    std::vector<DeformingKey> keys;
    keys.reserve(std::min(count, r.in.remaining() / 38));  // 19 numbers each
    std::vector<DeformingNormals> normals;
    normals.reserve(keys.capacity());
    for (std::size_t i = 0; i < count; ++i) {
        DeformingKey key;
        DeformingNormals& at_key = normals.emplace_back();
        key.time = r.in.number();
        if (!keys.empty() && key.time < keys.back().time) r.in.fault("a time not before the last key's");
        for (int k = 0; k < 3; ++k) {
            key.position[k] = r.in.point();
            at_key.corner[k] = r.in.vec3();
        }
        keys.push_back(key);
    }
    r.builder.add(std::move(keys), std::move(normals), r.in);
}

/// An index line holds three vertex indices, then three normal indices if there are normals, then three of the texture
/// coordinates if there are any; each list counts on its own.
void read_mesh(Reading& r)
{
    TriangleList list;
    r.in.keyword("vertices");
    read_points(r, list.positions);
    const bool with_normals = r.in.accept("normals");
    if (with_normals) read_points(r, list.normals);
    const bool with_uvs = r.in.accept("texturecoords");
    if (with_uvs) {
        const std::size_t count = read_vertex_count(r, list.uvs);
        list.texture = read_texture(r);
        for (std::size_t i = 0; i < count; ++i) list.uvs.push_back(r.in.vec2());
    }
    r.in.keyword("triangles");
    const std::size_t count = read_list_count(r.in, list.triangles);
    r.builder.check_room(count, r.in);
    for (std::size_t i = 0; i < count; ++i) {
        TriangleIndices triangle;
        triangle.vertex = read_indices(r.in, list.positions.size(), "vertex");
        if (with_normals) triangle.normal = read_indices(r.in, list.normals.size(), "normal");
        if (with_uvs) triangle.uv = read_indices(r.in, list.uvs.size(), "texture coordinate");
        list.triangles.push_back(triangle);
    }
    r.builder.add(std::move(list), r.in);
}

}  // namespace firstray::inline v0
