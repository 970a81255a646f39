#include "engine/primitive/exact.h"

#include <doctest/doctest.h>

#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

TEST_CASE("the exact side is the sign of an integer determinant")
{
    Random random(1);
    int zeros = 0;
    for (int i = 0; i < 20000; ++i) {
        // Numbers up to 2^20, so that products of three fit into 64 bits; many determinants are zero or nearly so.
        const auto whole = [&] { return std::floor(random.between(-0x1p20, 0x1p20)); };
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
