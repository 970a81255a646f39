#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace firstray::test {

/// How hard slow_obb_area() looks.
struct SlowSearch {
    int rotations = 4000;   ///< of the sweep over all of them: 5 degrees apart
    int refined = 40;       ///< of those, the best
    int steps = 400;        ///< of a refinement
    int directions = 1000;  ///< along which extreme points are looked for
};

namespace slow {

using Points = std::vector<glm::dvec3>;

inline glm::dvec3 size_along(const Points& points, const glm::dmat3& axes)
{
    glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 at(glm::dot(p, axes[0]), glm::dot(p, axes[1]), glm::dot(p, axes[2]));
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }
    return hi - lo;
}

inline double area(const glm::dvec3& size)
{
    return 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

struct Turned {
    glm::dmat3 axes{1.0};
    double area = 0.0;
};

inline Turned turned(const Points& points, const glm::dmat3& axes)
{
    return {axes, area(size_along(points, axes))};
}

/// The i-th of a sequence of rotations that fills the space of all of them evenly.
inline glm::dmat3 spread_rotation(int i)
{
    const double g = 1.2207440846057596;  // the plastic constant's like in three dimensions: x^4 = x + 1
    const auto part = [&](double step) { return std::fmod(0.5 + i * step, 1.0); };
    const double u = part(1.0 / g), a = 2.0 * std::numbers::pi * part(1.0 / (g * g));
    const double b = 2.0 * std::numbers::pi * part(1.0 / (g * g * g));
    return glm::mat3_cast(glm::dquat(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                                     std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b)));
}

/// Random turns of `width` radians about the three axes, smaller where they would thicken a thin box.
inline glm::dmat3 jittered(const glm::dmat3& axes, const glm::dvec3& size, double width, std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const auto along = [&](double a, double b) {
        return normal(random) * width * std::min(a, b) / std::max({a, b, 1e-300});
    };
    const glm::dvec3 turn(along(size.y, size.z), along(size.z, size.x), along(size.x, size.y));
    return axes * glm::mat3_cast(glm::normalize(glm::dquat(1.0, turn * 0.5)));
}

/// Keeps random turns that make the box smaller; their width follows the success.
inline Turned refined(const Points& points, Turned best, double width, int steps, std::mt19937& random)
{
    for (int step = 0; step < steps && width > 1e-9; ++step) {
        const Turned next = turned(points, jittered(best.axes, size_along(points, best.axes), width, random));
        if (next.area < best.area) {
            best = next;
            width *= 1.6;
        } else {
            width *= 0.88;
        }
    }
    return best;
}

inline Turned best_refined(const Points& points, std::vector<Turned>& starts, double width, const SlowSearch& search,
                           std::mt19937& random)
{
    const auto smaller = [](const Turned& a, const Turned& b) { return a.area < b.area; };
    std::sort(starts.begin(), starts.end(), smaller);
    Turned best = starts[0];
    for (std::size_t i = 0; i < std::min(starts.size(), static_cast<std::size_t>(search.refined)); ++i)
        best = std::min(best, refined(points, starts[i], width, search.steps, random), smaller);
    return best;
}

/// Sweeps all rotations, refines the best, then does so again about the best, with turns that suit its shape.
inline Turned searched(const Points& points, const SlowSearch& search, std::mt19937& random)
{
    std::vector<Turned> starts{turned(points, glm::dmat3(1.0))};
    for (int i = 0; i < search.rotations; ++i) starts.push_back(turned(points, spread_rotation(i)));
    const Turned first = best_refined(points, starts, 0.05, search, random);
    starts = {first};
    const glm::dvec3 size = size_along(points, first.axes);
    for (int i = 0; i < search.rotations / 2; ++i)
        starts.push_back(turned(points, jittered(first.axes, size, 0.7, random)));
    return best_refined(points, starts, 0.05, search, random);
}

/// Points that are extreme along directions spread in the space where the box of `axes` is a cube, and beside `axes`.
inline Points extremes(const Points& points, const glm::dmat3& axes, int directions)
{
    if (points.size() <= 60) return points;
    const glm::dvec3 size = glm::max(size_along(points, axes), glm::dvec3(1e-300));
    Points result;
    const auto keep_extremes = [&](const glm::dvec3& direction) {
        const auto [least, most] = std::minmax_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
            return glm::dot(a, direction) < glm::dot(b, direction);
        });
        result.insert(result.end(), {*least, *most});
    };
    for (int i = 0; i < directions; ++i) keep_extremes(axes * (spread_rotation(i)[0] / size));
    for (int i = 0; i < 3; ++i) keep_extremes(axes[i]);
    const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
    };
    std::sort(result.begin(), result.end(), before);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace slow

/// The least surface area of a box around the points that a long search finds. Shares no code with what it judges.
/// points  finite, of moderate size and offset, at least one
inline double slow_obb_area(std::span<const glm::dvec3> points, const SlowSearch& search = {})
{
    const slow::Points all(points.begin(), points.end());
    std::mt19937 random(1);
    glm::dmat3 axes(1.0);
    for (const int directions : {search.directions / 4, search.directions / 4})
        axes = slow::searched(slow::extremes(all, axes, directions), {400, 4, 200, 0}, random).axes;
    const slow::Points few = slow::extremes(all, axes, search.directions);
    slow::Turned best = slow::searched(few, search, random);
    best = slow::turned(all, best.axes);
    return std::min(best.area, slow::turned(all, axes).area);
}

}  // namespace firstray::test
