#include "engine/primitive/triangle_box.h"

#include <doctest/doctest.h>

#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

TEST_CASE("a box that holds a point of the triangle is never denied, and most that hold none are")
{
    Random random(9);
    int denied = 0, empty = 0;
    for (int i = 0; i < 100000; ++i) {
        const bool thin = i % 5 == 0;
        const glm::dvec3 a = random.in_cube(1), b = random.in_cube(1);
        const glm::dvec3 c = thin ? glm::mix(a, b, random.unit()) + random.in_cube(1e-6) : random.in_cube(1);
        const double u = random.unit(), v = (1 - u) * random.unit();
        const glm::dvec3 inside = a * (1 - u - v) + b * u + c * v;
        const float size = static_cast<float>(random.between(0.01, 0.5)), pad = 1e-5f;
        const TriangleBoxOverlap overlap{glm::vec3(a), glm::vec3(b), glm::vec3(c), glm::vec3(size + 2 * pad)};
        const glm::vec3 corner = glm::vec3(inside) - size * glm::vec3(random.unit(), random.unit(), random.unit());
        REQUIRE(overlap.meets(corner - pad));
        // Moved away along the normal by more than the box reaches, it holds nothing.
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (thin || glm::length(normal) < 1e-3) continue;
        ++empty;
        denied += !overlap.meets(glm::vec3(inside + glm::normalize(normal) * (2.0 * size)) - size * 0.5f);
    }
    CHECK(denied == empty);
}

TEST_CASE("a triangle that stands upright, give or take a rounding, is found along its whole length")
{
    // Seen from above its area is a rounding error, and so is the sense in which its corners turn.
    Random random(10);
    for (int i = 0; i < 100000; ++i) {
        const auto ulps = [&] { return (random.unit() - 0.5) * 4e-7; };
        const int up = i % 3;
        glm::dvec3 a = random.in_cube(1), b = random.in_cube(1), c = a + glm::dvec3(ulps(), ulps(), ulps());
        c[up] = random.between(-1, 1);
        if (i % 2) std::swap(a, c);
        const glm::dvec3 corners[3] = {glm::vec3(a), glm::vec3(b), glm::vec3(c)};
        const double u = random.unit(), v = (1 - u) * random.unit();
        const glm::dvec3 inside = corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v;
        const float size = static_cast<float>(random.between(0.01, 0.5)), pad = 1e-5f;
        const TriangleBoxOverlap overlap{glm::vec3(a), glm::vec3(b), glm::vec3(c), glm::vec3(size + 2 * pad)};
        const glm::vec3 corner = glm::vec3(inside) - size * glm::vec3(random.unit(), random.unit(), random.unit());
        REQUIRE(overlap.meets(corner - pad));
    }
}
