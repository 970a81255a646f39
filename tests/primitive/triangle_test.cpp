#include "engine/primitive/triangle.h"

#include <doctest/doctest.h>

#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

template <typename Real>
RootTriangle<Real> make(const glm::vec<3, Real, glm::defaultp>& a, const glm::vec<3, Real, glm::defaultp>& b,
                        const glm::vec<3, Real, glm::defaultp>& c)
{
    return {{a, b, c}, longest_edge<Real>(a, b, c)};
}

/// How many triangles of a closed fan around the origin a ray meets; the fan lies nearly in z = 0.
int hits_of_fan(const std::vector<glm::vec3>& rim, const glm::vec3& hub, const glm::vec3& origin,
                const glm::vec3& direction)
{
    int hits = 0;
    for (std::size_t i = 0; i < rim.size(); ++i)
        hits += intersect(make(hub, rim[i], rim[(i + 1) % rim.size()]), origin, direction, true).hit;
    return hits;
}

}  // namespace

TEST_CASE("a ray meets a triangle where it should")
{
    const auto t = make<float>({0, 0, 5}, {4, 0, 5}, {0, 4, 5});
    const auto hit = intersect(t, glm::vec3(1, 1, 0), glm::vec3(0, 0, 2), true);
    REQUIRE(hit.hit);
    CHECK(hit.t == 2.5f);
    CHECK(hit.u == doctest::Approx(0.25));
    CHECK(hit.v == doctest::Approx(0.25));
    CHECK(intersect(t, glm::vec3(1, 1, 10), glm::vec3(0, 0, 2), true).t == -2.5f);
    CHECK_FALSE(intersect(t, glm::vec3(3, 3, 0), glm::vec3(0, 0, 1), true).hit);
    CHECK_FALSE(intersect(t, glm::vec3(1, 1, 5), glm::vec3(1, 0, 0), true).hit);  // in its plane
}

TEST_CASE("triangles without area are never met")
{
    Random random(4);
    int hits = 0;
    for (int i = 0; i < 100000; ++i) {
        const auto whole = [&] { return glm::vec3(glm::floor(random.in_cube(1000.0))); };
        const glm::vec3 a = whole(), along = whole(), origin(random.in_cube(3000.0));
        const glm::vec3 b = i % 3 ? a + along : a, c = i % 3 == 1 ? a : a + along * 3.0f;
        hits += intersect(make(a, b, c), origin, a + along * 0.4f - origin, true).hit;
    }
    CHECK(hits == 0);
}

TEST_CASE("no ray passes between triangles around a vertex, and few hit more than two of them")
{
    Random random(5);
    int misses = 0, rays = 0;
    for (int i = 0; i < 4000; ++i) {
        const float far = static_cast<float>(std::pow(10.0, random.between(-1.0, 4.0)));
        const glm::vec3 hub(random.in_cube(far));
        std::vector<glm::vec3> rim;
        const int corners = 3 + static_cast<int>(random.below(9));
        for (int k = 0; k < corners; ++k) {
            const double turn = 2 * M_PI * k / corners;
            rim.push_back(hub + glm::vec3(std::cos(turn), std::sin(turn), random.between(-0.2, 0.2)));
        }
        for (int k = 0; k < 50; ++k, ++rays) {
            const glm::vec3 origin = hub + glm::vec3(random.between(-1, 1), random.between(-1, 1), 3.0) * far;
            const glm::vec3 aim = k % 2 ? hub : hub + (rim[static_cast<std::size_t>(k) % rim.size()] - hub) * 0.3f;
            misses += hits_of_fan(rim, hub, origin, aim - origin) == 0;
        }
    }
    CHECK(rays == 200000);
    CHECK(misses == 0);
}

TEST_CASE("t agrees with double, for grazing rays and slivers too")
{
    Random random(6);
    double worst = 0.0;
    int hits = 0;
    for (int i = 0; i < 300000; ++i) {
        const glm::vec3 a(random.in_cube(1.0)), b(random.in_cube(1.0));
        const glm::vec3 c =
            i % 2 ? glm::vec3(random.in_cube(1.0)) : glm::mix(a, b, 0.3f) + glm::vec3(random.in_cube(1e-4));
        const double u = random.unit(), v = random.unit() * (1.0 - u);
        const glm::dvec3 inside = glm::dvec3(a) * (1.0 - u - v) + glm::dvec3(b) * u + glm::dvec3(c) * v;
        const glm::dvec3 along = glm::dvec3(b - a) + random.in_cube(i % 4 < 2 ? 1e-3 : 3.0);
        const glm::vec3 origin(inside - along * random.between(0.1, 10.0)), direction(inside - glm::dvec3(origin));
        const auto rounded = intersect(make(a, b, c), origin, direction, true);
        const auto exact = intersect(make<double>(a, b, c), glm::dvec3(origin), glm::dvec3(direction));
        REQUIRE(rounded.hit == exact.hit);
        if (!exact.hit) continue;
        ++hits;
        worst = std::max(worst, std::abs(static_cast<double>(rounded.t) - exact.t) / std::abs(exact.t));
    }
    CHECK(hits > 100000);
    MESSAGE("largest relative error of t over " << hits << " hits: " << worst);
    CHECK(worst < t_slack);
    CHECK(worst < 1e-4);
}

TEST_CASE("scaling everything by a power of two scales t and changes nothing else")
{
    Random random(7);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 a(random.in_cube(1.0)), b(random.in_cube(1.0)), c(random.in_cube(1.0)), o(random.in_cube(3.0));
        const glm::vec3 d = glm::mix(a, b, 0.4f) + glm::vec3(random.in_cube(0.5)) - o;
        const auto plain = intersect(make(a, b, c), o, d, true);
        for (const float scale : {0x1p-40f, 0x1p-13f, 0x1p13f, 0x1p40f}) {
            const auto scaled = intersect(make(a * scale, b * scale, c * scale), o * scale, d, true);
            REQUIRE(scaled.hit == plain.hit);
            if (!plain.hit) continue;
            // Near the end of float's range t comes from double, which rounds differently.
            REQUIRE(scaled.t / scale == doctest::Approx(plain.t).epsilon(1e-5));
            if (scale > 0x1p-30f && scale < 0x1p30f) REQUIRE(scaled.t == plain.t * scale);
        }
    }
}
