#pragma once
#include <glm/glm.hpp>

#include <string>
#include <vector>

#include "engine/core/transform.h"

namespace firstray::inline v0 {

/// One key of a spline as the file gives it: Kochanek-Bartels tension, continuity, bias.
struct Key {
    double time = 0.0;      ///< seconds
    glm::dvec3 value{0.0};  ///< translation, scale or rotation axis (as written, perhaps not of unit length)
    double angle = 0.0;     ///< rotations: degrees
    double tension = 0.0, continuity = 0.0, bias = 0.0;  ///< 0: Catmull-Rom
};

/// A spline through keys 1 to n-2; the first and last key only shape the tangents. Outside it the end value is held.
/// Keys are searched in file order, as BART does: times may repeat or jump back.
class VectorTrack {
public:
    VectorTrack() = default;
    /// keys  none, or at least 4
    explicit VectorTrack(std::vector<Key> keys) : keys_(std::move(keys)) {}
    bool empty() const { return keys_.empty(); }            ///< without keys
    const std::vector<Key>& keys() const { return keys_; }  ///< as given
    glm::dvec3 at(double time) const;                       ///< held outside the keys

private:
    std::vector<Key> keys_;
};

/// Rotations joined by squad with TCB tangents, to the published paths of BART (sign rule of q3 included).
class RotationTrack {
public:
    RotationTrack() = default;
    explicit RotationTrack(std::vector<Key> keys);          ///< none, or at least 4
    bool empty() const { return keys_.empty(); }            ///< without keys
    const std::vector<Key>& keys() const { return keys_; }  ///< as given
    glm::dmat3 at(double time) const;                       ///< held outside the keys

private:
    struct Segment {
        glm::dvec4 q1, a, b, q2;  // quaternions (w, x, y, z)
    };
    std::vector<Key> keys_;
    std::vector<Segment> segments_;
};

/// From `time` on, something is visible or not.
struct VisibilityKey {
    double time = 0.0;    ///< seconds
    bool visible = true;  ///< from then on
};

/// What a `k` block says of one name. Missing tracks are the identity.
struct Animation {
    std::string name;                       ///< the transform's, light's or camera's
    VectorTrack translation, scale;         ///< parent from node
    RotationTrack rotation;                 ///< parent from node
    std::vector<VisibilityKey> visibility;  ///< ascending

    /// parent_from_node at `time`: translation * rotation * scale.
    Transform at(double time) const;
    /// Visible before the first key; from each key on, as that key says.
    bool visible_at(double time) const;
};

}  // namespace firstray::inline v0
