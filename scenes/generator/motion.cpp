#include "scenes/generator/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace firstray::scenes {
namespace {

double time_of(const Beat& beat, int step)
{
    return beat.start + (beat.end - beat.start) * step / beat.steps;
}

VectorTrack vectors(const Beat& beat, const std::function<glm::dvec3(double)>& value)
{
    std::vector<Key> keys;
    for (int i = -1; value && i <= beat.steps + 1; ++i) {
        const double time = time_of(beat, i);
        keys.push_back({.time = time, .value = value(time)});
    }
    return VectorTrack(std::move(keys));
}

/// Quaternions of neighbouring keys lie in one hemisphere, so that no segment takes the long way round.
RotationTrack rotations(const Beat& beat, const std::function<glm::dmat3(double)>& turn)
{
    std::vector<Key> keys;
    glm::dquat last(1.0, 0.0, 0.0, 0.0);
    for (int i = -1; turn && i <= beat.steps + 1; ++i) {
        const double time = time_of(beat, i);
        glm::dquat q = glm::normalize(glm::quat_cast(turn(time)));
        if (glm::dot(last, q) < 0.0) q = -q;
        last = q;
        const glm::dvec3 v(q.x, q.y, q.z);
        const double length = glm::length(v);
        const glm::dvec3 axis = length > 1e-9 ? v / length : glm::dvec3(0.0, 1.0, 0.0);
        keys.push_back({.time = time, .value = axis, .angle = glm::degrees(2.0 * std::atan2(length, q.w))});
    }
    return RotationTrack(std::move(keys));
}

}  // namespace

Animation motion(const std::string& name, const Beat& beat, const std::function<glm::dvec3(double)>& place,
                 const std::function<glm::dmat3(double)>& turn, const std::function<glm::dvec3(double)>& scale)
{
    return {name, vectors(beat, place), vectors(beat, scale), rotations(beat, turn), {}};
}

glm::dmat3 looking(const glm::dvec3& from, const glm::dvec3& at)
{
    const glm::dvec3 back = glm::normalize(from - at);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
    return {right, glm::cross(back, right), back};
}

double ease(double low, double high, double x)
{
    const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
}

}  // namespace firstray::scenes
