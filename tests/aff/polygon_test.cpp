#include "engine/aff/polygon.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace firstray {
namespace {

double area(std::span<const glm::dvec3> corners, const glm::uvec3& t)
{
    return 0.5 * glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]).z;
}

double area(std::span<const glm::dvec3> corners)
{
    double sum = 0.0;
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) sum += area(corners, {0, i, i + 1});
    return sum;
}

/// Triangles that all wind as the polygon and whose areas add up to its own cover it exactly once.
void check_covers(const std::vector<glm::dvec3>& corners)
{
    const auto triangles = triangulate(corners);
    CHECK(triangles.size() == corners.size() - 2);
    double sum = 0.0;
    for (const glm::uvec3& t : triangles) {
        CHECK(area(corners, t) >= -1e-12);
        sum += area(corners, t);
    }
    CHECK(sum == doctest::Approx(area(corners)));
}

}  // namespace

TEST_CASE("a convex polygon becomes a fan from its first corner")
{
    const std::vector<glm::dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    CHECK(triangulate(square) == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("straight corners do not make a polygon concave")
{
    CHECK(is_convex(std::vector<glm::dvec3>{{0, 0, 0}, {0.1, 0, 0}, {0.3, 0, 0}, {0.3, 0.3, 0}, {0, 0.3, 0}}));
}

TEST_CASE("concave polygons are covered exactly")
{
    check_covers({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
    check_covers({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
    check_covers({{2, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}});  // first corner is the reflex one
    std::vector<glm::dvec3> comb{{0, 0, 0}, {20, 0, 0}};
    for (int x = 20; x > 0; --x) comb.emplace_back(x - 0.5, x % 2 ? 1.0 : 5.0, 0.0);
    check_covers(comb);
}

TEST_CASE("random stars are covered exactly")
{
    for (unsigned seed = 1; seed <= 50; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> radius(0.2, 3.0);
        std::vector<glm::dvec3> star;
        for (int i = 0; i < 40; ++i) {
            const double r = radius(random), angle = i * 6.283185307179586 / 40;
            star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
        }
        check_covers(star);
    }
}

TEST_CASE("polygons that are a point, a line, crossed or not planar still give corners - 2 triangles")
{
    const std::vector<std::vector<glm::dvec3>> odd{
        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0.5, 0, 0}},
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
        {{0, 0, 0}, {1, 0, 3}, {1, 1, -2}, {0.2, 0.2, 9}, {0, 1, 5}},
    };
    for (const auto& corners : odd) CHECK(triangulate(corners).size() == corners.size() - 2);
}

}  // namespace firstray
