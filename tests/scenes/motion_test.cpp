#include "scenes/generator/motion.h"

#include <doctest/doctest.h>

#include <cmath>

#include "scenes/generator/gait.h"

using namespace firstray;
using namespace firstray::scenes;

TEST_CASE("keys of a motion follow it between them")
{
    const auto place = [](double t) { return glm::dvec3(std::sin(t), t, std::cos(2.0 * t)); };
    const auto turn = [](double t) {
        return rotation_about({0, 1, 0}, 2.5 * t) * rotation_about({1, 0, 0}, std::sin(t));
    };
    const Animation track = motion("m", {0.0, 8.0, 80}, place, turn);
    CHECK(track.translation.keys().size() == 83);
    CHECK(track.scale.empty());
    for (int i = 0; i <= 1000; ++i) {
        const double t = 8.0 * i / 1000.0;
        const Transform now = track.at(t);
        REQUIRE(glm::length(now.offset - place(t)) < 2e-3);
        for (int axis = 0; axis < 3; ++axis) REQUIRE(glm::length(now.linear[axis] - turn(t)[axis]) < 5e-3);
    }
}

TEST_CASE("what looks at a point has it straight ahead")
{
    const glm::dvec3 from(1, 2, 3), at(-4, 0, 7);
    const glm::dmat3 m = looking(from, at);
    CHECK(glm::dot(-m[2], glm::normalize(at - from)) == doctest::Approx(1.0));
    CHECK(glm::determinant(m) == doctest::Approx(1.0));
    CHECK(m[1].y > 0.0);
}

TEST_CASE("a walker's standing foot stays where it is")
{
    // the ankle's place, from the bends of hip and knee
    const auto ankle = [](double metres) {
        const double p = phase_after(metres);
        const LegBend bend = leg_bend(p, p);
        const glm::dmat3 hip = rotation_about({1, 0, 0}, bend.hip), knee = rotation_about({1, 0, 0}, bend.knee);
        const glm::dvec3 below = hip * (glm::dvec3(0, -thigh_length, 0) + knee * glm::dvec3(0, -shin_length, 0));
        return below + glm::dvec3(0.0, hip_height(p), metres);
    };
    const glm::dvec3 start = ankle(0.0);
    CHECK(start.y == doctest::Approx(ankle_height).epsilon(0.02));
    for (double metres = 0.0; metres < step_length; metres += 0.02) CHECK(glm::length(ankle(metres) - start) < 0.01);
    CHECK(ankle(1.5 * step_length).y > ankle_height + 0.1);  // swings
}
