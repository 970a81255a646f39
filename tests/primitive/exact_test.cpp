#include "engine/primitive/exact.h"

#include <doctest/doctest.h>

#include <utility>

#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

TEST_CASE("the exact side is the sign of an integer determinant")
{
    Random random(1);
    int zeros = 0;
    for (int i = 0; i < 20000; ++i) {
        // Numbers up to 2^20 or 2^38, so that products of three fit into 128 bits; many determinants are zero or nearly
        // so.
        const double most = i % 2 ? 0x1p20 : 0x1p38;
        const auto whole = [&] { return std::floor(random.between(-most, most)); };
        const glm::dvec3 a(whole(), whole(), whole()), o(whole(), whole(), whole()), d(whole(), whole(), whole());
        glm::dvec3 b = o + (a - o) * std::floor(random.between(-2, 3)) + d * std::floor(random.between(-2, 3));
        b.x += std::floor(random.between(-1, 2));
        const glm::dvec3 p = a - o, q = b - o;
        const auto whole_product = [](double x, double y, double z) {
            return static_cast<__int128>(x) * static_cast<__int128>(y) * static_cast<__int128>(z);
        };
        const __int128 det = whole_product(p.y, q.z, d.x) - whole_product(p.z, q.y, d.x) +
                             whole_product(p.z, q.x, d.y) - whole_product(p.x, q.z, d.y) +
                             whole_product(p.x, q.y, d.z) - whole_product(p.y, q.x, d.z);
        const int sign = det > 0 ? 1 : det < 0 ? -1 : 0;
        zeros += sign == 0;
        REQUIRE(exact_side(a, b, o, d) == sign);
        REQUIRE(exact_side(b, a, o, d) == -sign);
    }
    CHECK(zeros > 1000);
}

TEST_CASE("the exact side is that of the smallest determinants that large numbers have")
{
    // Of Fibonacci numbers: F(k) F(k+2) - F(k+1)^2 is 1 and -1 in turn.
    double before = 1.0, middle = 1.0, after = 2.0;
    for (int k = 0; k < 70; ++k) {  // up to 2^49
        const glm::dvec3 a(before, middle, 0.0), b(middle, after, 0.0);
        const int expected = k % 2 ? -1 : 1;
        for (const double scale : {0x1p-30, 1.0, 0x1p40}) {
            CAPTURE(k);
            CHECK(exact_side(a * scale, b * scale, glm::dvec3(0.0), {0.0, 0.0, scale}) == expected);
            CHECK(exact_side(b * scale, a * scale, glm::dvec3(0.0), {0.0, 0.0, scale}) == -expected);
            // From far away along a line through 0: what is added cancels.
            const glm::dvec3 far(0x1p70 * scale, 0.0, 0x1p60 * scale);
            CHECK(exact_side(a * scale, b * scale, -far, far) == expected);
        }
        before = std::exchange(middle, after);
        after = before + middle;
    }
}

TEST_CASE("the exact side tells what double cannot")
{
    // b is a plus a multiple of the direction, but for one unit in the last place.
    const glm::dvec3 origin(0.1, 0.2, 0.3), direction(1.0, 1.0, 1.0), a(1e8, 0.0, 1.0);
    const glm::dvec3 on_line = origin + direction;
    CHECK(exact_side(on_line, on_line, origin, direction) == 0);
    const glm::dvec3 above(a.x, std::nextafter(a.y, 1.0), a.z);
    CHECK(exact_side(a, above, origin, direction) == -exact_side(above, a, origin, direction));
    CHECK(exact_side(a, above, origin, direction) != 0);
}
