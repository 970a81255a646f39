#include "scenes/generator/gait.h"

#include <algorithm>
#include <cmath>

#include "engine/core/transform.h"

namespace firstray::scenes {
namespace {

glm::dmat3 about_x(double degrees)
{
    return rotation_about({1, 0, 0}, glm::radians(degrees));
}
glm::dmat3 about_y(double degrees)
{
    return rotation_about({0, 1, 0}, glm::radians(degrees));
}
glm::dmat3 about_z(double degrees)
{
    return rotation_about({0, 0, 1}, glm::radians(degrees));
}

/// The ankle in the plane of the leg, seen from the hip: how far forward, and how far up from the ground it is lifted.
struct Ankle {
    double forward = 0.0, lift = 0.0;
};

Ankle ankle_at(double phase)
{
    const double p = std::fmod(std::fmod(phase, 2.0 * M_PI) + 2.0 * M_PI, 2.0 * M_PI) / M_PI;
    if (p < 1.0) return {step_length * (0.5 - p), 0.0};  // stands: moves back as fast as the body goes forward
    const double s = p - 1.0, eased = s * s * (3.0 - 2.0 * s);
    return {step_length * (eased - 0.5), 0.15 * std::sin(M_PI * s)};
}

}  // namespace

double phase_after(double metres)
{
    return M_PI * metres / step_length;
}

double hip_height(double phase)
{
    return thigh_length + shin_length + ankle_height - 0.06 - 0.02 * std::cos(2.0 * phase);
}

glm::dmat3 hips_turn(double phase)
{
    return about_y(5.0 * std::cos(phase)) * about_z(2.0 * std::sin(phase));
}

glm::dmat3 torso_turn(double phase)
{
    return about_y(-11.0 * std::cos(phase)) * about_x(5.0) * about_z(-3.0 * std::sin(phase));
}

glm::dmat3 antenna_turn(double phase)
{
    return about_x(9.0 * std::sin(2.0 * phase + 0.6)) * about_z(5.0 * std::sin(phase));
}

glm::dmat3 head_turn(double time)
{
    return about_y(22.0 * std::sin(0.9 * time)) * about_x(-3.0 + 3.0 * std::sin(1.7 * time));
}

glm::dmat3 upper_arm_turn(double phase, bool left)
{
    return about_z(left ? 9.0 : -9.0) * about_x(-32.0 * std::cos(phase));
}

glm::dmat3 forearm_turn(double phase)
{
    return about_x(-38.0 - 18.0 * std::cos(phase));
}

glm::dmat3 hand_turn(double phase, bool left)
{
    return about_y(left ? 70.0 : -70.0) * about_x(10.0 * std::sin(phase));
}

LegBend leg_bend(double phase, double body)
{
    const Ankle ankle = ankle_at(phase);
    const double down = hip_height(body) - ankle_height - ankle.lift;
    const double reach = std::min(std::hypot(down, ankle.forward), 0.999 * (thigh_length + shin_length));
    const double a = thigh_length, b = shin_length;
    const double at_hip = std::acos((a * a + reach * reach - b * b) / (2.0 * a * reach));
    const double at_knee = std::acos((a * a + b * b - reach * reach) / (2.0 * a * b));
    LegBend bend;
    bend.hip = -(std::atan2(ankle.forward, down) + at_hip);
    bend.knee = M_PI - at_knee;
    const double tilt = glm::radians(80.0) * ankle.lift;  // the toes hang a little while the foot swings
    bend.ankle = -(bend.hip + bend.knee) + tilt;
    bend.toe = -1.5 * tilt;
    return bend;
}

}  // namespace firstray::scenes
