#include "engine/render/line_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace firstray {
namespace {

/// Room around the picture, in pixels, for lines whose middle is outside.
constexpr double margin = 4.0;

/// A line counts as visible up to this part of the distance behind a surface: boxes touch what they hold.
constexpr double depth_tolerance = 2e-3;

struct Interval {
    double lo = 0.0, hi = 1.0;

    /// Keeps what lies where a function is >= 0 that runs linearly from `at_lo` at 0 to `at_hi` at 1.
    void cut(double at_0, double at_1)
    {
        const double zero = at_0 / (at_0 - at_1);
        if (at_0 < 0.0) lo = at_1 > 0.0 ? std::max(lo, zero) : 2.0;
        if (at_1 < 0.0) hi = at_0 > 0.0 ? std::min(hi, zero) : -1.0;
    }
};

bool is_finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

/// What is left of a line in the picture.
struct LineLayer::Segment {
    glm::dvec2 a, b;                      ///< ends, pixels
    double a_inverse = 0, b_inverse = 0;  ///< 1 / depth there, which is linear in between

    /// The part from `a` to `b`, homogeneous places, that is beyond the near plane and in the picture.
    static std::optional<Segment> clipped(const glm::dvec3& a, const glm::dvec3& b, double hither, glm::dvec2 size)
    {
        if (!is_finite(a) || !is_finite(b)) return std::nullopt;
        const double nearest = std::max(hither, 1e-9);
        Interval part;
        part.cut(a.z - nearest, b.z - nearest);
        for (int axis = 0; axis < 2; ++axis) {
            part.cut(a[axis] + margin * a.z, b[axis] + margin * b.z);
            part.cut((size[axis] + margin) * a.z - a[axis], (size[axis] + margin) * b.z - b[axis]);
        }
        if (!(part.lo < part.hi)) return std::nullopt;
        const glm::dvec3 from = glm::mix(a, b, part.lo), to = glm::mix(a, b, part.hi);
        if (!(from.z > 0.0 && to.z > 0.0)) return std::nullopt;
        return Segment{glm::dvec2(from) / from.z, glm::dvec2(to) / to.z, 1.0 / from.z, 1.0 / to.z};
    }
};

LineLayer::LineLayer(const Frame& frame, const CameraRays& camera)
    : frame_(frame), camera_(camera), inks_(frame.pixel_count())
{
}

void LineLayer::draw(const glm::dvec3& a, const glm::dvec3& b, const Pen& pen)
{
    const auto segment = Segment::clipped(project(camera_, a), project(camera_, b), camera_.hither,
                                          glm::dvec2(frame_.width, frame_.height));
    if (!segment) return;
    const glm::dvec2 run = glm::abs(segment->b - segment->a);
    draw_across(*segment, run.x >= run.y ? 0 : 1, pen);
}

/// Steps along the axis on which the line is longer; at each step it covers a few pixels side by side.
void LineLayer::draw_across(const Segment& segment, int major, const Pen& pen)
{
    const int minor = 1 - major;
    const glm::ivec2 size(frame_.width, frame_.height);
    const glm::dvec2 run = segment.b - segment.a;
    const double length = std::abs(run[major]), cosine = length > 0.0 ? length / glm::length(run) : 1.0;
    const double reach = (0.5 * pen.width + 0.5) / cosine;
    const double first = std::floor(std::min(segment.a[major], segment.b[major])),
                 last = std::floor(std::max(segment.a[major], segment.b[major]));
    const int begin = std::max(static_cast<int>(first), 0), end = std::min(static_cast<int>(last), size[major] - 1);
    const double pixel = glm::length(camera_.next_column);
    for (int i = begin; i <= end; ++i) {
        const double s = length > 0.0 ? std::clamp((i + 0.5 - segment.a[major]) / run[major], 0.0, 1.0) : 0.0;
        const glm::dvec2 place = segment.a + s * run;
        const double inverse_depth = segment.a_inverse + s * (segment.b_inverse - segment.a_inverse);
        double strength = pen.strength;
        if (pen.spacing > 0.0)
            strength *= glm::smoothstep(faded_spacing, full_spacing, pen.spacing * inverse_depth / pixel);
        if (strength <= 0.0) continue;
        const int lo = std::max(static_cast<int>(std::ceil(place[minor] - reach - 0.5)), 0),
                  hi = std::min(static_cast<int>(std::floor(place[minor] + reach - 0.5)), size[minor] - 1);
        const auto index = [&](int j) {
            const int x = major == 0 ? i : j, y = major == 0 ? j : i;
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
        };
        float farthest = 0.0f;
        for (int j = lo; j <= hi; ++j) farthest = std::max(farthest, frame_.distance[index(j)]);
        const double distance =
            glm::length(camera_.corner + place.x * camera_.next_column + place.y * camera_.next_row) / inverse_depth;
        if (distance > farthest * (1.0 + depth_tolerance)) strength *= hidden_share;
        for (int j = lo; j <= hi; ++j) {
            const double off = std::abs(j + 0.5 - place[minor]) * cosine;
            const float covered = static_cast<float>(strength * std::clamp(0.5 * pen.width + 0.5 - off, 0.0, 1.0));
            Ink& ink = inks_[index(j)];
            if (covered > ink.strength) ink = {pen.colour, covered};
        }
    }
}

void LineLayer::cover(std::vector<glm::vec3>& colour) const
{
    for (std::size_t i = 0; i < inks_.size(); ++i) colour[i] = glm::mix(colour[i], inks_[i].colour, inks_[i].strength);
}

}  // namespace firstray
