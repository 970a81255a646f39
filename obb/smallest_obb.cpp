#include "obb/smallest_obb.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obb/frame_search.h"
#include "obb/point_set.h"

namespace firstray::obb {
namespace {

bool is_finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

DAabb finite_bounds(std::span<const glm::dvec3> points)
{
    DAabb box;
    for (const glm::dvec3& p : points)
        if (is_finite(p)) box.grow(p);
    return box;
}

/// The finite points about the middle of their bounds, in units (a power of two) in which they are about 1 large.
PointSet normalised(std::span<const glm::dvec3> points, const glm::dvec3& middle, int exponent)
{
    PointSet set;
    set.reserve(points.size());
    const double scale = std::ldexp(1.0, -exponent);
    for (const glm::dvec3& p : points)
        if (is_finite(p)) set.push_back((p - middle) * scale);
    return set;
}

bool cheaper(const Frame& a, const Frame& b)
{
    return a.cost < b.cost;
}

glm::dvec3 range_about(const PointSet& points, const Frame& frame)
{
    return turn_range(bounds_along(points, frame.axes).size());
}

/// Axes that suit the points' overall shape, found from few of them.
Frame rough_frame(const PointSet& all)
{
    Frame frame = frame_along(all, glm::dmat3(1.0));
    // the first pass sees a needle's length only, and the second, in a space stretched to suit, its width
    for (int pass = 0; pass < 2; ++pass) {
        const PointSet few = extreme_points(all, frame.axes, 16);
        for (const Frame& candidate : triangle_frames(few)) {
            if (candidate.cost < frame_along(few, frame.axes).cost) frame = candidate;
        }
        frame.cost = frame_along(few, frame.axes).cost;
        frame = descend(few, frame, {0.25 * range_about(few, frame), 60, 1e-3});
    }
    return frame;
}

/// Refines a frame of some extreme points until it holds for all, adding to `some` what sticks out.
Frame settle(const PointSet& all, PointSet& some, Frame frame)
{
    Frame best = frame_along(all, frame.axes);
    for (int round = 0; round < 8; ++round) {
        const Frame full = frame_along(all, frame.axes);
        if (full.cost <= best.cost) best = full;
        if (full.cost <= frame.cost * (1.0 + 1e-9)) break;
        for (int i = 0; i < 3; ++i) {
            const ExtremePair pair = extreme_pair(all, frame.axes[i]);
            some.push_back(all[pair.least]);
            some.push_back(all[pair.most]);
        }
        frame = descend(some, frame_along(some, frame.axes), {0.02 * range_about(some, frame), 150, 1e-7});
    }
    return best;
}

Frame smallest_frame(const PointSet& all)
{
    const Frame rough = rough_frame(all);
    PointSet some = extreme_points(outer_points(all, rough.axes), rough.axes, 128);
    const glm::dvec3 range = range_about(some, rough);
    std::vector<Frame> starts = sweep(some, rough, range);
    if (starts.size() > 16) starts.resize(16);
    starts.push_back(frame_along(some, rough.axes));
    starts.push_back(frame_along(some, glm::dmat3(1.0)));
    for (Frame& start : starts) start = descend(some, start, {0.15 * range, 60, 1e-3});
    std::sort(starts.begin(), starts.end(), cheaper);
    if (starts.size() > 4) starts.resize(4);

    Frame best = frame_along(all, glm::dmat3(1.0));
    for (const Frame& start : starts) {
        const Frame finer = descend(some, start, {0.03 * range, 200, 1e-9});
        best = std::min(best, settle(all, some, finer), cheaper);
    }
    return best;
}

/// The box with these axes and this centre.
Obb box_around(std::span<const glm::dvec3> points, const glm::dmat3& axes, const glm::dvec3& centre)
{
    // A dot product is off by three half ulps of its terms' sizes, in whatever order it is summed; whoever checks may
    // sum in another, so twice that and some.
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    Obb box{axes, centre, glm::dvec3(0.0)};
    for (const glm::dvec3& p : points) {
        if (!is_finite(p)) continue;
        const glm::dvec3 d = p - centre;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 terms = glm::abs(d * axes[i]);
            const double reach = std::abs(glm::dot(d, axes[i])) + rounding * (terms.x + terms.y + terms.z);
            box.half[i] = std::max(box.half[i], reach);
        }
    }
    return box;
}

}  // namespace

Obb smallest_obb(std::span<const glm::dvec3> points)
{
    const DAabb bounds = finite_bounds(points);
    if (bounds.empty()) return {};
    const glm::dvec3 middle = bounds.lo * 0.5 + bounds.hi * 0.5;
    const glm::dvec3 half = bounds.hi * 0.5 - bounds.lo * 0.5;
    const double longest = std::max({half.x, half.y, half.z});
    if (!(longest > 0.0)) return box_around(points, glm::dmat3(1.0), middle);
    const int exponent = std::clamp(std::ilogb(longest) + 1, -1000, 1000);
    const PointSet local = normalised(points, middle, exponent);
    const glm::dmat3 axes = smallest_frame(local).axes;
    const DAabb box = bounds_along(local, axes);
    return box_around(points, axes, middle + axes * ((box.lo + box.hi) * 0.5) * std::ldexp(1.0, exponent));
}

}  // namespace firstray::obb
