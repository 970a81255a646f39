#include "engine/primitive/quadric.h"

#include <doctest/doctest.h>

#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Quadric sphere(const glm::dvec3& centre, double radius)
{
    Quadric q;
    q.group_from_quadric = {glm::dmat3(radius), centre};
    return q;
}

Quadric cone(double r0, double r1, double height)
{
    Quadric q{Quadric::Kind::cone, false, r0, r1, {}};
    q.group_from_quadric.linear[2][2] = height;
    return q;
}

}  // namespace

TEST_CASE("a sphere is met where the formula says, from outside, inside and far away")
{
    const RootQuadric ball = place_quadric(sphere({0, 0, 10}, 2), {}, 0, false);
    CHECK(intersect(ball, {0, 0, 0}, {0, 0, 1}, 0, infinity) == doctest::Approx(8));
    CHECK(intersect(ball, {0, 0, 10}, {0, 0, 0.5}, 0, infinity) == doctest::Approx(4));
    CHECK(intersect(ball, {0, 0, 0}, {0, 0, 1}, 9, infinity) == doctest::Approx(12));
    CHECK(intersect(ball, {0, 0, 0}, {0, 0, 1}, 0, 7.9) == infinity);
    CHECK(intersect(ball, {0, 2.001, 0}, {0, 0, 1}, 0, infinity) == infinity);
    CHECK(intersect(ball, {0, 0, -1e9}, {0, 0, 1}, 0, infinity) == doctest::Approx(1e9 + 8).epsilon(1e-14));
}

TEST_CASE("a sphere with a negative radius is seen from inside only")
{
    Quadric shell = sphere({0, 0, 10}, 2);
    shell.inside_only = true;
    const RootQuadric placed = place_quadric(shell, {}, 0, false);
    CHECK(intersect(placed, {0, 0, 0}, {0, 0, 1}, 0, infinity) == doctest::Approx(12));
}

TEST_CASE("cones and cylinders have no caps and end where they end")
{
    const RootQuadric tube = place_quadric(cone(1, 1, 4), {}, 0, false);
    CHECK(intersect(tube, {-5, 0, 2}, {1, 0, 0}, 0, infinity) == doctest::Approx(4));
    CHECK(intersect(tube, {-5, 0, 4.001}, {1, 0, 0}, 0, infinity) == infinity);
    CHECK(intersect(tube, {0.5, 0, -5}, {0, 0, 1}, 0, infinity) == infinity);  // through both open ends
    CHECK(intersect(tube, {0, 0, -1}, {1, 0, 2}, 0, infinity) == doctest::Approx(1));
    const RootQuadric tip = place_quadric(cone(2, 0, 2), {}, 0, false);
    CHECK(intersect(tip, {-5, 0, 1}, {1, 0, 0}, 0, infinity) == doctest::Approx(4));
    CHECK(intersect(tip, {-1, 0, -1}, {0, 0, 1}, 0, infinity) == doctest::Approx(2));  // parallel to its axis
}

TEST_CASE("points that rays find lie on the surface and in the bounds, however it is placed")
{
    Random random(8);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Quadric shape = i % 2 ? sphere(random.in_cube(2), random.between(0.1, 2))
                                    : cone(random.between(0, 2), random.between(0, 2), random.between(0.1, 3));
        const Transform place{glm::dmat3(random.in_cube(1), random.in_cube(1), random.in_cube(1)), random.in_cube(50)};
        if (is_singular(place)) continue;
        const RootQuadric placed = place_quadric(shape, place, 0, false);
        const glm::dvec3 middle = (placed.bounds.lo + placed.bounds.hi) * 0.5, size = placed.bounds.size();
        const glm::dvec3 origin = middle + random.in_cube(3) * size, aim = middle + random.in_cube(0.4) * size;
        const double t = intersect(placed, origin, aim - origin, 0, infinity);
        if (!std::isfinite(t)) continue;
        ++hits;
        const glm::dvec3 p = origin + t * (aim - origin), local = placed.quadric_from_root.point(p);
        const double r = shape.r0 + (shape.r1 - shape.r0) * local.z;
        const double off =
            shape.kind == Quadric::Kind::sphere ? glm::length(local) - 1 : std::hypot(local.x, local.y) - std::abs(r);
        REQUIRE(std::abs(off) < 1e-8);
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(p[axis] >= placed.bounds.lo[axis] - 1e-9 * size[axis]);
            REQUIRE(p[axis] <= placed.bounds.hi[axis] + 1e-9 * size[axis]);
        }
    }
    CHECK(hits > 3000);
}
