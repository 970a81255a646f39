#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

/// Inlined into kernels of every instruction set, where it is compiled for that set (but never contracted).
#define FIRSTRAY_INLINE [[gnu::always_inline]] inline

namespace firstray::inline v0 {

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
FIRSTRAY_INLINE Real longest_edge(const glm::vec<3, Real, glm::defaultp>& v0,
                                  const glm::vec<3, Real, glm::defaultp>& v1,
                                  const glm::vec<3, Real, glm::defaultp>& v2)
{
    Real longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Real a = std::abs(v1[axis] - v0[axis]), b = std::abs(v2[axis] - v1[axis]),
                   c = std::abs(v0[axis] - v2[axis]);
        longest = std::max(longest, std::max(std::max(a, b), c));
    }
    return longest;
}

/// Bound on the error of a side, as a multiple of edge * distance * direction (each a largest component): 92 roundings
/// counted one by one, and a little for those of the bound.
template <typename Real>
inline constexpr Real side_error = Real(100) * std::numeric_limits<Real>::epsilon() / 2;

/// A bound below this may hide underflow: nothing is certain then.
template <typename Real>
inline constexpr Real least_bound = std::numeric_limits<Real>::min() * Real(1 << 20);

/// t comes from float only where |Ng . d| is at least this much of span * direction, with span = |e1| |e2| of the edges
/// that make Ng: elsewhere, for needles and grazing rays, the quotient loses too much and is computed in double; below
/// double's own limit it is worth less than the distances of the corners.
template <typename Real>
inline constexpr Real least_slope = std::is_same_v<Real, float> ? Real(0x1p-6) : Real(0x1p-26);
/// ... and only where the hit is at least this part of the triangle's distance away: the numerator's error scales with
/// the distance of the vertices, not of the hit.
inline constexpr float least_distance = 1.0f / 8;

/// Precision::fast trusts float's sides up to this many edges of distance (farther triangles are smaller than a pixel):
/// then a ray that it takes for a hit misses the triangle by a hundredth of its size at most.
inline constexpr float farthest_fast = 1024.0f;

/// ... and where span * distance stays below this: beyond, products in the sides may overflow.
inline constexpr float largest_fast = 1e36f;

/// Bound on float's error of t where it is sloped enough: this part of t plus distance / direction (64 * 50 half ulps).
inline constexpr float quotient_error = 1.0f / 4096;

/// How far float's t can be off under these two rules, relative to t: 64 * 50 * 9 half ulps of worst case (in practice
/// a hundredth of it). Searches look this much beyond the nearest hit, so that they test whatever could beat it.
inline constexpr float t_slack = 1.0f / 512;

template <typename Real>
FIRSTRAY_INLINE glm::vec<3, Real, glm::defaultp> cross_as_written(const glm::vec<3, Real, glm::defaultp>& a,
                                                                  const glm::vec<3, Real, glm::defaultp>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename Real>
FIRSTRAY_INLINE Real dot_as_written(const glm::vec<3, Real, glm::defaultp>& a,
                                    const glm::vec<3, Real, glm::defaultp>& b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// The power of two that makes a triangle's longest edge lie in [1, 2), where it is no denormal. Planes are made from
/// edges times this: then products of edges stay in float's range, and t is the same in whatever unit a scene is.
FIRSTRAY_INLINE float edge_unit(float edge)
{
    return std::bit_cast<float>((254u << 23) - (std::bit_cast<std::uint32_t>(edge) & (255u << 23)));
}

/// Whether float's sides are good enough for Precision::fast, as far as the triangle tells.
/// span  of its edges times edge_unit(edge): what underflows or overflows does so in the triangle's own lengths
FIRSTRAY_INLINE bool is_fast_enough(float span, float edge, float distance)
{
    const float unit = edge_unit(edge), volume = span * distance / unit / unit;
    return distance <= farthest_fast * edge && volume > least_bound<float> && volume < largest_fast;
}

template <typename Real>
FIRSTRAY_INLINE Real largest_component(const glm::vec<3, Real, glm::defaultp>& v)
{
    return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

FIRSTRAY_INLINE RootTriangle<double> widened(const RootTriangle<float>& t)
{
    return {{glm::dvec3(t.v[0]), glm::dvec3(t.v[1]), glm::dvec3(t.v[2])}, static_cast<double>(t.edge)};
}

/// The quotient that gives t: height / slope = Ng . a_0 / Ng . d, with Ng from the edges at corner 0, times a unit.
template <typename Real>
struct TrianglePlane {
    Real slope, height;
    Real span;  ///< product of the largest components of those edges

    /// Whether the quotient is worth anything.
    /// length  largest component of the direction
    FIRSTRAY_INLINE bool is_sloped(Real length) const { return std::abs(slope) > least_slope<Real> * (span * length); }
};

template <typename Real>
FIRSTRAY_INLINE TrianglePlane<Real> triangle_plane(const glm::vec<3, Real, glm::defaultp> (&v)[3],
                                                   const glm::vec<3, Real, glm::defaultp>& origin,
                                                   const glm::vec<3, Real, glm::defaultp>& direction, Real unit)
{
    const auto e1 = (v[0] - v[2]) * unit, e2 = (v[1] - v[0]) * unit, normal = cross_as_written<Real>(e1, e2);
    return {dot_as_written<Real>(normal, direction), dot_as_written<Real>(normal, v[0] - origin),
            largest_component<Real>(e1) * largest_component<Real>(e2)};
}

/// The sides on which a ray passes the edges opposite to corners 0, 1, 2.
template <typename Real>
struct TriangleSides {
    Real u, v, w;
    Real least() const { return std::min(std::min(u, v), w); }
    Real most() const { return std::max(std::max(u, v), w); }
};

template <typename Real>
FIRSTRAY_INLINE TriangleSides<Real> triangle_sides(const glm::vec<3, Real, glm::defaultp> (&v)[3],
                                                   const glm::vec<3, Real, glm::defaultp>& origin,
                                                   const glm::vec<3, Real, glm::defaultp>& direction)
{
    const auto a0 = v[0] - origin, a1 = v[1] - origin, a2 = v[2] - origin;
    return {dot_as_written<Real>(cross_as_written<Real>(v[2] - v[1], a1 + a2), direction),
            dot_as_written<Real>(cross_as_written<Real>(v[0] - v[2], a2 + a0), direction),
            dot_as_written<Real>(cross_as_written<Real>(v[1] - v[0], a0 + a1), direction)};
}

/// What a hit is; u and v are the weights of corners 1 and 2.
template <typename Real>
struct TriangleHit {
    bool hit = false;
    Real t = 0, u = 0, v = 0;
};

/// Where hits count: t_min < t <= t_last. (Searches decide themselves what a hit at t_last is worth.)
template <typename Real>
struct HitRange {
    Real t_min = -std::numeric_limits<Real>::infinity(), t_last = std::numeric_limits<Real>::infinity();
    bool contains(Real t) const { return t > t_min && t <= t_last; }
};

/// The test in double with exact signs: for Precision::double_, and for the signs that float cannot tell.
TriangleHit<double> intersect(const RootTriangle<double>& triangle, const glm::dvec3& origin,
                              const glm::dvec3& direction, const HitRange<double>& range = {});

/// t of the plane's hit in double, rounded: for slivers and grazing rays. It lies between the corners' own distances
/// along the ray, however the ray grazes the triangle.
float plane_t_in_double(const RootTriangle<float>& triangle, const glm::vec3& origin, const glm::vec3& direction);

/// Whether the ray passes inside, decided in double or exactly; the weights of corners 1 and 2 if so.
bool passes_inside_exactly(const RootTriangle<float>& triangle, const glm::vec3& origin, const glm::vec3& direction,
                           float& u, float& v);

/// The test in float, for Precision::fast and robust.
FIRSTRAY_INLINE TriangleHit<float> intersect(const RootTriangle<float>& triangle, const glm::vec3& origin,
                                             const glm::vec3& direction, bool exact_signs,
                                             const HitRange<float>& range = {})
{
    const float distance = largest_component<float>(triangle.v[0] - origin) + triangle.edge;
    const float length = largest_component<float>(direction);
    const TrianglePlane<float> plane = triangle_plane(triangle.v, origin, direction, edge_unit(triangle.edge));
    const bool is_sloped = (int{plane.is_sloped(length)} & int{plane.span * distance > least_bound<float>}) != 0;
    // Near large triangles and along grazing rays float cannot place the hit. Both quotients are computed at once:
    // which of them counts is hard to foretell, and guessing wrong takes longer than a second one.
    const float t_in_float = plane.height / plane.slope;
    const TrianglePlane<double> fine =
        triangle_plane(widened(triangle).v, glm::dvec3(origin), glm::dvec3(direction), 1.0);
    const bool is_good = (int{is_sloped} & int{std::abs(t_in_float) * length >= least_distance * distance}) != 0;
    float t = is_good ? t_in_float : static_cast<float>(fine.height / fine.slope);
    if (!is_good && !fine.is_sloped(static_cast<double>(length))) [[unlikely]]
        t = plane_t_in_double(triangle, origin, direction);
    if (!range.contains(t)) return {};

    const TriangleSides<float> s = triangle_sides(triangle.v, origin, direction);
    const float least = s.least(), most = s.most();
    const float error = side_error<float> * (triangle.edge * distance * length);
    bool is_certain = error >= least_bound<float> && (least > error || most < -error);
    if (!exact_signs) {
        if (!(least >= 0.0f || most <= 0.0f)) return {};
        // Rounding alone would let rays meet needles far beyond their ends, and what is tiny from afar almost anywhere.
        is_certain = is_sloped && is_fast_enough(plane.span, triangle.edge, distance);
    } else if (error >= least_bound<float> && least < -error && most > error) {
        return {};
    }
    if (is_certain) {
        const float scale = 1.0f / ((s.u + s.v) + s.w);
        return {true, t, s.v * scale, s.w * scale};
    }
    TriangleHit<float> hit{false, t};
    hit.hit = passes_inside_exactly(triangle, origin, direction, hit.u, hit.v);
    return hit;
}

}  // namespace firstray::inline v0
