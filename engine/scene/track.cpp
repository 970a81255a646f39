#include "engine/scene/track.h"

#include <algorithm>
#include <cmath>

namespace firstray::inline v0 {
namespace {

/// Where a time falls: segment i joins keys i + 1 and i + 2; s in [0, 1].
struct Where {
    std::size_t segment;
    double s;
};

/// The first segment in file order that ends after `time`. No binary search: BART has tracks whose times jump back, of
/// which only the run up to the jump counts.
Where find_segment(const std::vector<Key>& keys, double time)
{
    const std::size_t last = keys.size() - 4;
    if (time <= keys[1].time) return {0, 0.0};
    if (time < keys[last + 2].time)
        for (std::size_t i = 0; i <= last; ++i)
            if (time < keys[i + 2].time) return {i, (time - keys[i + 1].time) / (keys[i + 2].time - keys[i + 1].time)};
    return {last, 1.0};
}

/// A segment's share of the time between a key's neighbours: corrects tangents for unequal key distances. Keys that
/// share one time have no such share; their tangent vanishes.
double share(double segment, double neighbours)
{
    return neighbours != 0.0 ? segment / neighbours : 0.0;
}

/// Tangent at `key` as it leaves: from what was travelled before the key and what will be after it.
template <typename Value>
Value outgoing(const Key& key, const Value& before, const Value& after)
{
    return (1 - key.tension) * (1 + key.continuity) * (1 + key.bias) * before +
           (1 - key.tension) * (1 - key.continuity) * (1 - key.bias) * after;
}

template <typename Value>
Value incoming(const Key& key, const Value& before, const Value& after)
{
    return (1 - key.tension) * (1 - key.continuity) * (1 + key.bias) * before +
           (1 - key.tension) * (1 + key.continuity) * (1 - key.bias) * after;
}

/// Tangents at both ends of the segment that begins at k[1], by what lies between the keys (differences, logarithms).
template <typename Value>
struct Tangents {
    Value out, in;
    Tangents(const Key* k, const Value& d01, const Value& d12, const Value& d23)
    {
        const double length = k[2].time - k[1].time;
        out = share(length, k[2].time - k[0].time) * outgoing(k[1], d01, d12);
        in = share(length, k[3].time - k[1].time) * incoming(k[2], d12, d23);
    }
};

// Quaternions as (w, x, y, z). They need not be of unit length: axes are used as written.
using Quaternion = glm::dvec4;

constexpr double small_sine = 1e-3;  // BART's: below it the limits of sin(x)/x and of slerp are taken

glm::dvec3 vector_part(const Quaternion& q)
{
    return {q.y, q.z, q.w};
}

Quaternion conjugate(const Quaternion& q)
{
    return {q.x, -q.y, -q.z, -q.w};
}

Quaternion product(const Quaternion& a, const Quaternion& b)
{
    const glm::dvec3 av = vector_part(a), bv = vector_part(b);
    return {a.x * b.x - glm::dot(av, bv), a.x * bv + b.x * av + glm::cross(av, bv)};
}

/// Logarithm of a^-1 b; its real part is 0.
glm::dvec3 log_between(const Quaternion& a, const Quaternion& b)
{
    const Quaternion q = product(conjugate(a), b);
    if (std::abs(q.x) >= 1.0) return vector_part(q);
    const double angle = std::acos(q.x), sine = std::sin(angle);
    return std::abs(sine) >= small_sine ? vector_part(q) * (angle / sine) : vector_part(q);
}

Quaternion exp(const glm::dvec3& v)
{
    const double angle = glm::length(v), sine = std::sin(angle);
    return {std::cos(angle), std::abs(sine) >= small_sine ? v * (sine / angle) : v};
}

/// Never flips a sign: squad needs the way round that its control points describe.
Quaternion slerp(double s, const Quaternion& p, const Quaternion& q)
{
    const double angle = std::acos(std::clamp(glm::dot(p, q), -1.0, 1.0)), sine = std::sin(angle);
    if (sine < small_sine) return p;
    return p * (std::sin((1.0 - s) * angle) / sine) + q * (std::sin(s * angle) / sine);
}

Quaternion key_quaternion(const Key& key)
{
    const double half = glm::radians(key.angle) / 2.0;
    return {std::cos(half), std::sin(half) * key.value};
}

/// The quaternion after a round trip through angle and unit axis: the real part stays, the rest gets the length that
/// makes it a rotation.
Quaternion through_unit_axis(const Quaternion& q)
{
    const double length = glm::length(vector_part(q));
    if (!(length > 0.0)) return q;
    const double half = std::acos(std::clamp(q.x, -1.0, 1.0));
    return {std::cos(half), vector_part(q) * (std::sin(half) / length)};
}

glm::dmat3 rotation_matrix(const Quaternion& q)
{
    const double length = glm::length(vector_part(q));
    if (!(length > 0.0)) return glm::dmat3(1.0);
    // BART does not clamp; axes that are too long then make it lose objects in single frames (acos gives NaN).
    return rotation_about(vector_part(q) / length, 2.0 * std::acos(std::clamp(q.x, -1.0, 1.0)));
}

}  // namespace

glm::dvec3 VectorTrack::at(double time) const
{
    if (empty()) return glm::dvec3(0.0);
    const auto [segment, s] = find_segment(keys_, time);
    const Key* k = &keys_[segment];
    const glm::dvec3 d12 = k[2].value - k[1].value;
    const Tangents<glm::dvec3> tangents(k, k[1].value - k[0].value, d12, k[3].value - k[2].value);
    return k[1].value + s * tangents.out + s * s * (3.0 * d12 - 2.0 * tangents.out - tangents.in) +
           s * s * s * (tangents.out + tangents.in - 2.0 * d12);
}

RotationTrack::RotationTrack(std::vector<Key> keys) : keys_(std::move(keys))
{
    std::vector<Quaternion> q;
    for (const Key& key : keys_) q.push_back(key_quaternion(key));
    for (std::size_t i = 0; i + 3 < keys_.size(); ++i) {
        // Only q2 is turned to q1's side, q3 keeps the sign of the file until it is q2 itself: aligning all keys first
        // would leave the published camera path of Robots by up to 39 degrees.
        Quaternion q2 = q[i + 2];
        if (glm::dot(q[i + 1], q2) < 0.0) {
            q2 = -q2;
            q[i + 2] = through_unit_axis(q2);
        }
        const glm::dvec3 l12 = log_between(q[i + 1], q2);
        const Tangents<glm::dvec3> tangents(&keys_[i], log_between(q[i], q[i + 1]), l12, log_between(q2, q[i + 3]));
        segments_.push_back({q[i + 1], product(q[i + 1], exp(0.5 * (tangents.out - l12))),
                             product(q2, exp(0.5 * (l12 - tangents.in))), q2});
    }
}

glm::dmat3 RotationTrack::at(double time) const
{
    if (empty()) return glm::dmat3(1.0);
    const auto [index, s] = find_segment(keys_, time);
    const Segment& segment = segments_[index];
    return rotation_matrix(
        slerp(2.0 * s * (1.0 - s), slerp(s, segment.q1, segment.q2), slerp(s, segment.a, segment.b)));
}

Transform Animation::at(double time) const
{
    Transform parent_from_node{rotation.at(time), translation.at(time)};
    if (!scale.empty()) {
        const glm::dvec3 factors = scale.at(time);
        for (int axis = 0; axis < 3; ++axis) parent_from_node.linear[axis] *= factors[axis];
    }
    return parent_from_node;
}

bool Animation::visible_at(double time) const
{
    bool visible = true;
    for (const VisibilityKey& key : visibility)
        if (time >= key.time) visible = key.visible;
    return visible;
}

}  // namespace firstray::inline v0
