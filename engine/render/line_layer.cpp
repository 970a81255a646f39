#include "engine/render/line_layer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace firstray::inline v0 {
namespace {

/// Room around the picture, in pixels, for lines whose middle is outside.
constexpr double margin = 4.0;

/// A line counts as visible up to this part of the distance behind a surface: boxes touch what they hold.
constexpr double depth_tolerance = 2e-3;

/// The part of a line that is left, from 0 at one end to 1 at the other.
struct Interval {
    double lo = 0.0, hi = 1.0;

    /// Keeps the part where a linear function is >= 0, given by its values at the ends.
    void cut(double at_0, double at_1)
    {
        if (at_0 < 0.0 && at_1 < 0.0) hi = -1.0;
        if (at_0 < 0.0 && at_1 >= 0.0) lo = std::max(lo, at_0 / (at_0 - at_1));
        if (at_0 >= 0.0 && at_1 < 0.0) hi = std::min(hi, at_0 / (at_0 - at_1));
    }
};

bool is_finite(const glm::dvec2& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y);
}

}  // namespace

/// What is left of a line in the picture.
struct LineLayer::Segment {
    glm::dvec2 a, b;              ///< ends, pixels
    double a_inverse, b_inverse;  ///< 1 / depth there, which is linear in between

    /// The part from `a` to `b`, homogeneous places, that is beyond the near plane and in the picture.
    static std::optional<Segment> clipped(const glm::dvec3& a, const glm::dvec3& b, double hither, glm::dvec2 size)
    {
        const glm::dvec2 far_corner = size + margin;
        Interval part;
        part.cut(a.z - hither, b.z - hither);
        for (int axis = 0; axis < 2; ++axis) {
            part.cut(a[axis] + margin * a.z, b[axis] + margin * b.z);
            part.cut(far_corner[axis] * a.z - a[axis], far_corner[axis] * b.z - b[axis]);
        }
        if (!(part.lo < part.hi)) return std::nullopt;
        const glm::dvec3 from = glm::mix(a, b, part.lo), to = glm::mix(a, b, part.hi);
        const glm::dvec2 from_place = glm::dvec2(from) / from.z, to_place = glm::dvec2(to) / to.z;
        if (!is_finite(from_place) || !is_finite(to_place) || !(from.z > 0.0 && to.z > 0.0)) return std::nullopt;
        // The ends of huge lines are rounded by more than the margin.
        return Segment{glm::clamp(from_place, glm::dvec2(-margin), far_corner),
                       glm::clamp(to_place, glm::dvec2(-margin), far_corner), 1.0 / from.z, 1.0 / to.z};
    }
};

/// The pixels beside one place on a line, along the axis on which the line is shorter.
struct LineLayer::Stroke {
    glm::dvec2 place{0.0};       ///< on the line
    double inverse_depth = 1.0;  ///< there
    double slant = 1.0;          ///< distance from the line per pixel of distance from the place
    int axis = 0;                ///< along which the pixels lie side by side, 0 or 1
    glm::ivec2 first{0};         ///< of the pixels
    int count = 0;
};

LineLayer::LineLayer(const Frame& frame, const CameraRays& camera)
    : frame_(frame), camera_(camera), pixel_(glm::length(camera.next_column)), inks_(frame.pixel_count())
{
}

void LineLayer::draw(const glm::dvec3& a, const glm::dvec3& b, const Pen& pen)
{
    const glm::ivec2 size(frame_.width, frame_.height);
    const auto clipped = Segment::clipped(project(camera_, a), project(camera_, b), camera_.hither, size);
    if (!clipped) return;
    const glm::dvec2 run = clipped->b - clipped->a;
    const int along = std::abs(run.x) >= std::abs(run.y) ? 0 : 1, across = 1 - along;
    const bool is_point = run[along] == 0.0;
    Stroke stroke{.axis = across};
    if (!is_point) stroke.slant = std::abs(run[along]) / glm::length(run);
    const double reach = (0.5 * pen.width + 0.5) / stroke.slant;
    const auto [first, last] = std::minmax(clipped->a[along], clipped->b[along]);
    const int end = std::min(static_cast<int>(std::floor(last)), size[along] - 1);
    for (int i = std::max(static_cast<int>(std::floor(first)), 0); i <= end; ++i) {
        const double s = is_point ? 0.0 : std::clamp((i + 0.5 - clipped->a[along]) / run[along], 0.0, 1.0);
        stroke.place = clipped->a + s * run;
        stroke.inverse_depth = glm::mix(clipped->a_inverse, clipped->b_inverse, s);
        const double middle = stroke.place[across] - 0.5;  // in pixels from the first one's centre
        stroke.first[along] = i;
        stroke.first[across] = std::max(static_cast<int>(std::ceil(middle - reach)), 0);
        stroke.count =
            std::min(static_cast<int>(std::floor(middle + reach)), size[across] - 1) - stroke.first[across] + 1;
        draw(stroke, pen);
    }
}

void LineLayer::draw(const Stroke& stroke, const Pen& pen)
{
    double strength = pen.strength;
    if (pen.spacing > 0.0)
        strength *= glm::smoothstep(faded_spacing, full_spacing, pen.spacing * stroke.inverse_depth / pixel_);
    if (strength <= 0.0) return;
    if (is_hidden(stroke)) strength *= hidden_share;
    for (int k = 0; k < stroke.count; ++k) {
        const double off = std::abs(stroke.first[stroke.axis] + k + 0.5 - stroke.place[stroke.axis]) * stroke.slant;
        const auto covered = static_cast<float>(strength * std::clamp(0.5 * pen.width + 0.5 - off, 0.0, 1.0));
        Ink& ink = inks_[pixel_of(stroke, k)];
        if (covered > ink.strength) ink = {pen.colour, covered};
    }
}

/// Decided for all pixels together: a line along a slanted surface would otherwise be half hidden.
bool LineLayer::is_hidden(const Stroke& stroke) const
{
    float farthest = 0.0f;
    for (int k = 0; k < stroke.count; ++k) farthest = std::max(farthest, frame_.distance[pixel_of(stroke, k)]);
    const glm::dvec3 at_depth_1 =
        camera_.corner + stroke.place.x * camera_.next_column + stroke.place.y * camera_.next_row;
    return glm::length(at_depth_1) / stroke.inverse_depth > farthest * (1.0 + depth_tolerance);
}

std::size_t LineLayer::pixel_of(const Stroke& stroke, int k) const
{
    glm::ivec2 pixel = stroke.first;
    pixel[stroke.axis] += k;
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(frame_.width) +
           static_cast<std::size_t>(pixel.x);
}

void LineLayer::cover(std::vector<glm::vec3>& colour) const
{
    for (std::size_t i = 0; i < inks_.size(); ++i) colour[i] = glm::mix(colour[i], inks_[i].colour, inks_[i].strength);
}

}  // namespace firstray::inline v0
