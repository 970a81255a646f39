#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace firstray {

// The one test of a ray and a triangle. Whatever finds hits, a lane of a wide kernel or the loop over everything,
// computes these expressions in this order, without contraction, in the root system; so all of them get the same bits.
//
// With a_i = v_i - O and the edge e = v_j - v_i, the side on which the ray passes the edge is the sign of
// (e x (a_i + a_j)) . d, twice the determinant of (a_j, a_i, d). Exchanging i and j flips the sign of e and leaves the
// sum: the two triangles at an edge get exactly opposite values, so no ray passes between them. What float cannot
// decide is decided in double, what double cannot decide exactly: then no ray passes between triangles at a vertex
// either.
//
// (e comes from the vertices, not from the a_i: its error is relative to the edge and not to the distance, which makes
// `side_error` below a bound that holds for every ray.)

/// A triangle's corners in the root system, and what its error bounds need.
template <typename Real>
struct RootTriangle {
    using Vec = glm::vec<3, Real, glm::defaultp>;
    Vec v[3];
    Real edge;  ///< longest_edge(v)
};

/// The largest component of the three edges, in magnitude.
template <typename Real>
Real longest_edge(const glm::vec<3, Real, glm::defaultp>& v0, const glm::vec<3, Real, glm::defaultp>& v1,
                  const glm::vec<3, Real, glm::defaultp>& v2)
{
    const auto longest = glm::max(glm::max(glm::abs(v1 - v0), glm::abs(v2 - v1)), glm::abs(v0 - v2));
    return std::max(std::max(longest.x, longest.y), longest.z);
}

/// Bound on the error of a side, as a multiple of edge * distance * direction (each a largest component): 92 roundings
/// counted one by one, and a little for those of the bound.
template <typename Real>
inline constexpr Real side_error = Real(100) * std::numeric_limits<Real>::epsilon() / 2;

/// A bound below this may hide underflow: nothing is certain then.
template <typename Real>
inline constexpr Real least_bound = std::numeric_limits<Real>::min() * Real(1 << 20);

/// t comes from float only where |Ng . d| is at least this much of edge^2 * direction: elsewhere, for slivers and
/// grazing rays, the quotient loses too much and is computed in double.
inline constexpr float least_slope = 1.0f / 64;
/// ... and only where the hit is at least this part of the triangle's distance away: the numerator's error scales with
/// the distance of the vertices, not of the hit.
inline constexpr float least_distance = 1.0f / 8;

/// Precision::fast trusts float's sides up to this many edges of distance (farther triangles are smaller than a pixel):
/// then a ray that it takes for a hit misses the triangle by a hundredth of its size at most.
inline constexpr float farthest_fast = 1024.0f;

/// How far float's t can be off under these two rules, relative to t: 64 * 50 * 9 half ulps of worst case (in practice
/// a hundredth of it). Searches look this much beyond the nearest hit, so that they test whatever could beat it.
inline constexpr float t_slack = 1.0f / 512;

/// The sides of a ray and a triangle's edges, and the quotient that gives t.
template <typename Real>
struct TriangleSides {
    Real u, v, w;  ///< side of the edge opposite to corner 0, 1, 2
    Real slope;    ///< Ng . d
    Real height;   ///< Ng . a_0
};

template <typename Real>
TriangleSides<Real> triangle_sides(const glm::vec<3, Real, glm::defaultp> (&v)[3],
                                   const glm::vec<3, Real, glm::defaultp>& origin,
                                   const glm::vec<3, Real, glm::defaultp>& direction)
{
    const auto cross = [](const auto& a, const auto& b) {
        return glm::vec<3, Real, glm::defaultp>(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    };
    const auto dot = [](const auto& a, const auto& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; };
    const auto a0 = v[0] - origin, a1 = v[1] - origin, a2 = v[2] - origin;
    const auto e0 = v[2] - v[1], e1 = v[0] - v[2], e2 = v[1] - v[0];
    const auto normal = cross(e1, e2);
    return {dot(cross(e0, a1 + a2), direction), dot(cross(e1, a2 + a0), direction), dot(cross(e2, a0 + a1), direction),
            dot(normal, direction), dot(normal, a0)};
}

/// What a hit is; u and v are the weights of corners 1 and 2.
template <typename Real>
struct TriangleHit {
    bool hit = false;
    Real t = 0, u = 0, v = 0;
};

/// The test in double with exact signs: the answer for Precision::robust where float cannot tell, and for double_.
/// t lies between the vertices' own distances along the ray, however the ray grazes the triangle.
TriangleHit<double> intersect(const RootTriangle<double>& triangle, const glm::dvec3& origin,
                              const glm::dvec3& direction);

/// The same for a triangle and a ray in float. inside_known: the sides are already decided, only t and weights are
/// wanted.
TriangleHit<float> intersect_in_double(const RootTriangle<float>& triangle, const glm::vec3& origin,
                                       const glm::vec3& direction, bool inside_known);

/// The test in float, for Precision::fast and robust. Any t; callers compare it with their interval.
inline TriangleHit<float> intersect(const RootTriangle<float>& triangle, const glm::vec3& origin,
                                    const glm::vec3& direction, bool exact_signs)
{
    const TriangleSides<float> s = triangle_sides(triangle.v, origin, direction);
    const glm::vec3 apart = glm::abs(triangle.v[0] - origin), along = glm::abs(direction);
    const float distance = std::max(std::max(apart.x, apart.y), apart.z) + triangle.edge;
    const float length = std::max(std::max(along.x, along.y), along.z);
    const float least = std::min(std::min(s.u, s.v), s.w), most = std::max(std::max(s.u, s.v), s.w);
    const bool is_sloped = std::abs(s.slope) > least_slope * (triangle.edge * triangle.edge * length);
    if (exact_signs) {
        const float error = side_error<float> * (triangle.edge * distance * length);
        const bool is_certain = error >= least_bound<float> && (least > error || most < -error);
        if (error >= least_bound<float> && least < -error && most > error) return {};
        if (!is_certain) return intersect_in_double(triangle, origin, direction, false);
    } else {
        if (!(least >= 0.0f || most <= 0.0f)) return {};
        // Rounding alone would let rays meet needles far beyond their ends, and what is tiny from afar almost anywhere.
        if (!is_sloped || distance > farthest_fast * triangle.edge)
            return intersect_in_double(triangle, origin, direction, false);
    }
    const float t = s.height / s.slope;
    if (!is_sloped || !(std::abs(t) * length >= least_distance * distance))
        return intersect_in_double(triangle, origin, direction, true);
    const float scale = 1.0f / ((s.u + s.v) + s.w);
    return {true, t, s.v * scale, s.w * scale};
}

}  // namespace firstray
