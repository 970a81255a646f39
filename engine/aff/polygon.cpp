#include "engine/aff/polygon.h"

#include <cstdint>

namespace firstray::inline v0 {
namespace {

/// Twice the polygon's area along each axis (Newell); its direction is the polygon's normal.
glm::dvec3 area_vector(std::span<const glm::dvec3> corners)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return sum;
}

/// Twice the area of a triangle as seen against `normal`: positive when it is counter-clockwise.
double turn(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& normal)
{
    return glm::dot(glm::cross(b - a, c - a), normal);
}

using Loop = std::vector<std::uint32_t>;  // corners that are left, in order

bool is_ear(std::span<const glm::dvec3> corners, const Loop& loop, std::size_t at, const glm::dvec3& normal)
{
    const std::size_t n = loop.size(), before = (at + n - 1) % n, after = (at + 1) % n;
    const glm::dvec3 &a = corners[loop[before]], &b = corners[loop[at]], &c = corners[loop[after]];
    if (turn(a, b, c, normal) <= 0.0) return false;
    for (std::size_t i = 0; i < n; ++i) {
        if (i == before || i == at || i == after) continue;
        const glm::dvec3& p = corners[loop[i]];
        if (p == a || p == b || p == c) continue;  // a corner that is passed twice, as where holes are joined
        if (turn(a, b, p, normal) >= 0.0 && turn(b, c, p, normal) >= 0.0 && turn(c, a, p, normal) >= 0.0) return false;
    }
    return true;
}

/// The next ear from `start` on; without one (the polygon crosses itself or has no area) just the next corner.
std::size_t find_ear(std::span<const glm::dvec3> corners, const Loop& loop, std::size_t start, const glm::dvec3& normal)
{
    for (std::size_t step = 0; step < loop.size(); ++step) {
        const std::size_t at = (start + step) % loop.size();
        if (is_ear(corners, loop, at, normal)) return at;
    }
    return start % loop.size();
}

std::vector<glm::uvec3> cut_ears(std::span<const glm::dvec3> corners)
{
    std::vector<glm::uvec3> triangles;
    const glm::dvec3 normal = area_vector(corners);
    Loop loop;
    for (std::uint32_t i = 0; i < corners.size(); ++i) loop.push_back(i);
    for (std::size_t at = 1; loop.size() > 3;) {
        at = find_ear(corners, loop, at, normal);
        const std::size_t n = loop.size();
        triangles.emplace_back(loop[(at + n - 1) % n], loop[at], loop[(at + 1) % n]);
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(at));
    }
    triangles.emplace_back(loop[0], loop[1], loop[2]);
    return triangles;
}

}  // namespace

bool is_convex(std::span<const glm::dvec3> corners)
{
    const glm::dvec3 normal = area_vector(corners);
    const std::size_t n = corners.size();
    // Corners that are straight but for rounding are convex too.
    const double tolerance = 1e-12 * glm::dot(normal, normal);
    for (std::size_t i = 0; i < n; ++i)
        if (turn(corners[i], corners[(i + 1) % n], corners[(i + 2) % n], normal) < -tolerance) return false;
    return true;
}

std::vector<glm::uvec3> triangulate(std::span<const glm::dvec3> corners)
{
    if (!is_convex(corners)) return cut_ears(corners);
    std::vector<glm::uvec3> fan;
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) fan.emplace_back(0u, i, i + 1);
    return fan;
}

}  // namespace firstray::inline v0
