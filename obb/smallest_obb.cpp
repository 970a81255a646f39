#include "obb/smallest_obb.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obb/fit/descent.h"
#include "obb/fit/flush_frames.h"
#include "obb/fit/slide.h"
#include "obb/fit/start_frames.h"

namespace firstray::inline v0::obb {
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

glm::dvec3 range_about(const PointSet& points, const Frame& frame)
{
    return turn_range(bounds_along(points, frame.axes).size());
}

constexpr double reach = 4.0;  ///< how many steps a search may go from its start

Frame descended(const PointSet& points, const Frame& start, const Descent& how)
{
    return descend(NearPoints(points, start.axes, glm::abs(how.step) * reach), start, how);
}

Frame slid(const PointSet& points, const Frame& start, const Descent& how)
{
    const NearPoints near(points, start.axes, glm::abs(how.step) * reach);
    return slide(near, descend(near, start, how));
}

/// Axes that suit the points' overall shape, found from few of them.
Frame rough_frame(const PointSet& all)
{
    Frame frame = frame_along(all, glm::dmat3(1.0));
    // the first pass sees a needle's length only, and the second, in a space stretched to suit, its width
    for (int pass = 0; pass < 2; ++pass) {
        const PointSet few = extreme_points(all, frame.axes, 16);
        frame.cost = frame_along(few, frame.axes).cost;
        for (const Frame& candidate : triangle_frames(few)) frame = std::min(frame, candidate, cheaper);
        frame = descended(few, frame, {0.25 * range_about(few, frame), 60, 1e-3});
    }
    return frame;
}

/// Axes to descend from: many, as there are many valleys.
std::vector<Frame> start_frames(const PointSet& some, const Frame& rough, const glm::dvec3& range)
{
    constexpr std::size_t few = 12;
    const bool is_flat = std::min({range.x, range.y, range.z}) < 1e-7;
    std::vector<Frame> frames =
        some.size() <= few && !is_flat ? flush_frames(some, rough.axes, 64) : sweep(some, rough, range, 40);
    frames.push_back(frame_along(some, rough.axes));
    frames.push_back(frame_along(some, glm::dmat3(1.0)));
    return frames;
}

/// Sorts by cost and keeps the best, of those that cost the same only one.
void keep_best(std::vector<Frame>& frames, std::size_t count)
{
    std::sort(frames.begin(), frames.end(), cheaper);
    const auto same = [](const Frame& a, const Frame& b) { return b.cost <= a.cost * (1.0 + 1e-5); };
    frames.erase(std::unique(frames.begin(), frames.end(), same), frames.end());
    if (frames.size() > count) frames.resize(count);
}

/// Adds to `some` those of `all` that stick out of its box along `axes` the most.
/// returns  whether there were any
bool add_missing(PointSet& some, const PointSet& all, const glm::dmat3& axes)
{
    constexpr double rounding = 1e-14;  // of points that are about 1 large
    const DAabb box = bounds_along(some, axes);
    const std::size_t before = some.size();
    for (int i = 0; i < 3; ++i) {
        const ExtremePair pair = extreme_pair(all, axes[i]);
        const glm::dvec3 least = all[pair.least], most = all[pair.most];
        if (glm::dot(least, axes[i]) < box.lo[i] - rounding) some.push_back(least);
        if (glm::dot(most, axes[i]) > box.hi[i] + rounding) some.push_back(most);
    }
    return some.size() > before;
}

/// Finds starts, then refines ever fewer ever further, on a few points that become as good as all.
Frame smallest_frame(const PointSet& all)
{
    const Frame rough = rough_frame(all);
    const PointSet outer = outer_points(all, rough.axes);
    PointSet some = extreme_points(outer, rough.axes, 128);
    const glm::dvec3 range = range_about(some, rough);

    std::vector<Frame> frames = start_frames(some, rough, range);
    for (Frame& frame : frames) frame = descended(some, frame, {0.15 * range, 50, 1e-3});
    keep_best(frames, 8);
    for (const Frame& frame : frames) add_missing(some, outer, frame.axes);
    for (Frame& frame : frames) frame = descended(some, frame_along(some, frame.axes), {0.06 * range, 60, 1e-6});
    keep_best(frames, 4);
    for (const double step : {0.04, -0.02}) {
        for (const Frame& frame : frames) add_missing(some, all, frame.axes);
        for (Frame& frame : frames) frame = slid(some, frame_along(some, frame.axes), {step * range, 60, 1e-6});
    }
    keep_best(frames, 2);
    for (Frame& frame : frames) {
        for (int round = 0; round < 6 && add_missing(some, all, frame.axes); ++round)
            frame = slid(some, frame_along(some, frame.axes), {0.01 * range, 60, 1e-9});
        frame = frame_along(all, frame.axes);
    }

    // boxes that could stand straight do
    const Frame straight = frame_along(all, glm::dmat3(1.0)), best = std::min(frames.front(), frames.back(), cheaper);
    if (straight.cost <= best.cost * (1.0 + 1e-12)) return straight;
    return {axes_along(best.axes[0], best.axes[1]), best.cost};
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
            const double error = rounding * (terms.x + terms.y + terms.z);
            box.half[i] = std::max(box.half[i], std::abs(glm::dot(d, axes[i])) + error);
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

}  // namespace firstray::inline v0::obb
