#pragma once
#include <functional>
#include <string>

#include "scenes/generator/aff_writer.h"
#include "scenes/generator/motion.h"

namespace firstray::scenes {

/// How a walker gets about: functions of time.
struct Walk {
    Beat beat;                                ///< a key every tenth of a second or so: a step takes half a second
    std::function<glm::dvec3(double)> place;  ///< on the ground, between the feet
    std::function<double(double)> heading;    ///< degrees about y; 0 is towards +z
    std::function<double(double)> travelled;  ///< metres; the feet follow it
};

/// Colours of a walker.
struct Paint {
    glm::vec3 body{0.75f, 0.16f, 0.12f}, trim{0.92f, 0.86f, 0.72f};
};

/// A tin robot, 1.9 high, of 18 rigid parts, each in a moving transform of its own, nested as limbs are:
/// walker > hips > torso > (head > antenna, upper arm > forearm > hand), hips > thigh > shin > foot > toe.
/// name   begins the names of its transforms
/// returns  triangles written
std::uint64_t write_walker(AffWriter& out, const std::string& name, const Walk& walk, const Paint& paint);

/// A walk at constant speed on a circle, counter-clockwise seen from above, starting at angle `from` (degrees).
Walk circle_walk(const Beat& beat, double radius, double speed, double from);

}  // namespace firstray::scenes
