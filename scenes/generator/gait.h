#pragma once
#include <glm/glm.hpp>

namespace firstray::scenes {

// How a walker's joints turn as it walks: functions of the phase of its gait, 2 pi for two steps. A leg of phase p
// stands while p is in [0, pi) and swings forward in [pi, 2 pi).

inline constexpr double thigh_length = 0.42, shin_length = 0.42, ankle_height = 0.13;  // metres
inline constexpr double step_length = 0.56;

double phase_after(double metres);

double hip_height(double phase);
glm::dmat3 hips_turn(double phase);
glm::dmat3 torso_turn(double phase);
glm::dmat3 antenna_turn(double phase);
glm::dmat3 head_turn(double time);
glm::dmat3 upper_arm_turn(double phase, bool left);
glm::dmat3 forearm_turn(double phase);
glm::dmat3 hand_turn(double phase, bool left);

/// Turns of a leg's joints about x, radians; positive moves a foot backwards.
struct LegBend {
    double hip = 0.0, knee = 0.0, ankle = 0.0, toe = 0.0;
};

/// What puts the foot where it stands on the ground, or swings over it.
/// phase  of this leg; body  of the walker: what lifts the hips
LegBend leg_bend(double phase, double body);

}  // namespace firstray::scenes
