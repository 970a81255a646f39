#include "scenes/generator/mesh.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/scene.h"

namespace firstray::scenes {
namespace {

std::uint32_t size_of(const auto& list)
{
    return static_cast<std::uint32_t>(list.size());
}

double snapped(double value, double step)
{
    return std::round(value / step) * step;
}

/// Two triangles over four corners given by equal indices into positions and normals.
void add_smooth_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
    mesh.triangles.push_back({{a, b, c}, {a, b, c}, {a, b, c}});
    mesh.triangles.push_back({{a, c, d}, {a, c, d}, {a, c, d}});
}

/// Places along one edge of a rounded box's face: towards which end, and the slant there.
struct EdgePoint {
    double end = 1.0, slant = 0.0;
};

std::vector<EdgePoint> edge_points(int steps)
{
    std::vector<EdgePoint> points;
    for (int i = 0; i <= steps; ++i) points.push_back({-1.0, -std::tan(M_PI_4 * (steps - i) / steps)});
    for (int i = 0; i <= steps; ++i) points.push_back({1.0, std::tan(M_PI_4 * i / steps)});
    return points;
}

/// One face of a rounded box, across axis `w`.
void add_face(Mesh& mesh, const glm::dvec3& inner, double radius, int steps, int w, double sign)
{
    const std::vector<EdgePoint> edge = edge_points(steps);
    const std::uint32_t first = size_of(mesh.positions), row = size_of(edge);
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    for (const EdgePoint& q : edge)
        for (const EdgePoint& p : edge) {
            glm::dvec3 corner, slope;
            corner[u] = p.end * sign, corner[v] = q.end, corner[w] = sign;
            slope[u] = p.slant * sign, slope[v] = q.slant, slope[w] = sign;
            mesh.normals.push_back(glm::normalize(slope));
            mesh.positions.push_back(inner * corner + radius * mesh.normals.back());
        }
    for (std::uint32_t j = 0; j + 1 < row; ++j)
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t a = first + j * row + i;
            add_smooth_quad(mesh, a, a + 1, a + row + 1, a + row);
        }
}

/// The outward normal (radius, height) of a step of a profile that goes up.
glm::dvec2 step_normal(const glm::dvec2& from, const glm::dvec2& to)
{
    const glm::dvec2 along = glm::normalize(to - from);
    return {along.y, -along.x};
}

/// Appends a ring of points or normals around y; returns where it begins.
std::uint32_t add_ring(std::vector<glm::dvec3>& list, const glm::dvec2& p, int around)
{
    for (int i = 0; i < around; ++i) {
        const double angle = 2.0 * M_PI * i / around;
        list.emplace_back(p.x * std::cos(angle), p.y, p.x * std::sin(angle));
    }
    return size_of(list) - static_cast<std::uint32_t>(around);
}

/// Triangles between two rings.
/// vertex, normal  where the lower and the upper ring begin
/// open            whether the lower and the upper ring are more than a point
void add_belt(Mesh& mesh, const glm::uvec2& vertex, const glm::uvec2& normal, int around, const glm::bvec2& open)
{
    const auto n = static_cast<std::uint32_t>(around);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        if (open.x)
            mesh.triangles.push_back(
                {{vertex.x + i, vertex.y + j, vertex.x + j}, {normal.x + i, normal.y + j, normal.x + j}, {}});
        if (open.y)
            mesh.triangles.push_back(
                {{vertex.x + i, vertex.y + i, vertex.y + j}, {normal.x + i, normal.y + i, normal.y + j}, {}});
    }
}

/// A unit vector at right angles to a unit vector.
glm::dvec3 across(const glm::dvec3& along)
{
    return glm::normalize(glm::cross(along, std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
}

}  // namespace

void append(Mesh& mesh, const Mesh& part, const Transform& mesh_from_part)
{
    const glm::uvec3 vertex(size_of(mesh.positions)), normal(size_of(mesh.normals)), uv(size_of(mesh.uvs));
    const glm::dmat3 normals = normal_matrix(mesh_from_part);
    for (const glm::dvec3& p : part.positions) mesh.positions.push_back(mesh_from_part.point(p));
    for (const glm::dvec3& n : part.normals) mesh.normals.push_back(glm::normalize(normals * n));
    mesh.uvs.insert(mesh.uvs.end(), part.uvs.begin(), part.uvs.end());
    for (const Mesh::Triangle& t : part.triangles)
        mesh.triangles.push_back({t.vertex + vertex, t.normal + normal, t.uv + uv});
}

void snap(Mesh& mesh, double step)
{
    for (glm::dvec3& p : mesh.positions)
        for (int i = 0; i < 3; ++i) p[i] = snapped(p[i], step);
    for (glm::dvec3& n : mesh.normals)
        for (int i = 0; i < 3; ++i) n[i] = snapped(n[i], 1e-2);
    for (glm::dvec2& uv : mesh.uvs) uv = {snapped(uv.x, 1e-2), snapped(uv.y, 1e-2)};
}

Mesh part_of(const Mesh& mesh, const std::function<bool(const glm::dvec3&)>& keep)
{
    Mesh part;
    std::vector<std::uint32_t> vertices(mesh.positions.size(), none), normals(mesh.normals.size(), none),
        uvs(mesh.uvs.size(), none);
    const auto moved = [](std::uint32_t& index, std::vector<std::uint32_t>& places, const auto& from, auto& to) {
        if (from.empty()) return;
        if (places[index] == none) places[index] = size_of(to), to.push_back(from[index]);
        index = places[index];
    };
    for (Mesh::Triangle t : mesh.triangles) {
        const auto& p = mesh.positions;
        if (!keep((p[t.vertex.x] + p[t.vertex.y] + p[t.vertex.z]) / 3.0)) continue;
        for (int i = 0; i < 3; ++i) {
            moved(t.vertex[i], vertices, mesh.positions, part.positions);
            moved(t.normal[i], normals, mesh.normals, part.normals);
            moved(t.uv[i], uvs, mesh.uvs, part.uvs);
        }
        part.triangles.push_back(t);
    }
    return part;
}

void add_quad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
              const glm::dvec2& size)
{
    const std::uint32_t v = size_of(mesh.positions), t = size_of(mesh.uvs);
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    if (t > 0 || size != glm::dvec2(0.0))
        mesh.uvs.insert(mesh.uvs.end(), {{0.0, size.y}, {size.x, size.y}, {size.x, 0.0}, {0.0, 0.0}});
    mesh.triangles.push_back({{v, v + 1, v + 2}, {}, {t, t + 1, t + 2}});
    mesh.triangles.push_back({{v, v + 2, v + 3}, {}, {t, t + 2, t + 3}});
}

void add_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high)
{
    const std::uint32_t first = size_of(mesh.positions);
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    constexpr glm::uvec4 sides[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const glm::uvec4& s : sides) {
        mesh.triangles.push_back({glm::uvec3(s.x, s.y, s.z) + first, {}, {}});
        mesh.triangles.push_back({glm::uvec3(s.x, s.z, s.w) + first, {}, {}});
    }
}

Mesh rounded_box(const glm::dvec3& half, double radius, int steps)
{
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) add_face(mesh, half - radius, radius, steps, axis, sign);
    return mesh;
}

Mesh lathe(std::span<const glm::dvec2> profile, int around)
{
    constexpr double sharp = 0.766;  // cosine of 40 degrees
    Mesh mesh;
    const std::uint32_t steps = size_of(profile) - 1;
    std::uint32_t vertex = add_ring(mesh.positions, profile[0], around);
    std::uint32_t normal =
        add_ring(mesh.normals, step_normal(profile[0], profile[1]), around);  // at a step's lower end
    for (std::uint32_t k = 0; k < steps; ++k) {
        const glm::dvec2 own = step_normal(profile[k], profile[k + 1]);
        const glm::dvec2 next = k + 1 < steps ? step_normal(profile[k + 1], profile[k + 2]) : own;
        const bool smooth = glm::dot(own, next) > sharp;
        const std::uint32_t high_vertex = add_ring(mesh.positions, profile[k + 1], around);
        const std::uint32_t high_normal = add_ring(mesh.normals, smooth ? glm::normalize(own + next) : own, around);
        const glm::bvec2 open(profile[k].x > 0.0, profile[k + 1].x > 0.0);
        add_belt(mesh, {vertex, high_vertex}, {normal, high_normal}, around, open);
        vertex = high_vertex;
        normal = smooth ? high_normal : add_ring(mesh.normals, next, around);
    }
    return mesh;
}

Mesh ball(double radius, int rings, int around)
{
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= rings; ++i) {
        const double angle = M_PI * i / rings;
        profile.emplace_back(i % rings == 0 ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
    }
    return lathe(profile, around);
}

Mesh tube(std::span<const glm::dvec3> path, std::span<const double> radius, int around)
{
    Mesh mesh;
    const auto n = static_cast<std::uint32_t>(around);
    glm::dvec3 side = across(glm::normalize(path[1] - path[0]));
    for (std::size_t k = 0; k < path.size(); ++k) {
        const glm::dvec3 along = glm::normalize(path[std::min(k + 1, path.size() - 1)] - path[k > 0 ? k - 1 : 0]);
        side = glm::normalize(side - glm::dot(side, along) * along);  // carried along without twist
        const glm::dvec3 up = glm::cross(along, side);
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * M_PI * i / around;
            mesh.normals.push_back(std::cos(angle) * side + std::sin(angle) * up);
            mesh.positions.push_back(path[k] + radius[k] * mesh.normals.back());
        }
    }
    for (std::uint32_t k = 0; k + 1 < path.size(); ++k)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = k * n + i, b = k * n + (i + 1) % n;
            add_smooth_quad(mesh, a, b, b + n, a + n);
        }
    return mesh;
}

Mesh surface(int nu, int nv, const std::function<glm::dvec3(double, double)>& position, const glm::dvec2& uv_scale)
{
    Mesh mesh;
    for (int j = 0; j <= nv; ++j)
        for (int i = 0; i <= nu; ++i) {
            const double u = static_cast<double>(i) / nu, v = static_cast<double>(j) / nv, e = 1e-4;
            mesh.positions.push_back(position(u, v));
            mesh.normals.push_back(glm::normalize(
                glm::cross(position(u + e, v) - position(u - e, v), position(u, v + e) - position(u, v - e))));
            if (uv_scale != glm::dvec2(0.0)) mesh.uvs.push_back(glm::dvec2(u, v) * uv_scale);
        }
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (nu + 1) + i), row = static_cast<std::uint32_t>(nu + 1);
            add_smooth_quad(mesh, a, a + 1, a + row + 1, a + row);
        }
    return mesh;
}

Transform shift(const glm::dvec3& offset)
{
    return {glm::dmat3(1.0), offset};
}

Transform turn(const glm::dvec3& axis, double degrees)
{
    return {rotation_about(glm::normalize(axis), glm::radians(degrees)), glm::dvec3(0.0)};
}

Transform size(const glm::dvec3& factors)
{
    return {{{factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}}, glm::dvec3(0.0)};
}

}  // namespace firstray::scenes
