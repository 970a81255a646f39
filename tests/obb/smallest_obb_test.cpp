#include "obb/smallest_obb.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "engine/aff/reader.h"
#include "tests/obb/slow_obb.h"
#include "tests/support/bart.h"

namespace firstray {
namespace {

using obb::Obb;
using Points = std::vector<glm::dvec3>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Random numbers, points and rotations from one seed.
class Dice {
public:
    explicit Dice(unsigned seed) : random_(seed) {}
    double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
    double normal() { return std::normal_distribution<double>()(random_); }
    int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random_); }
    glm::dvec3 in_cube() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
    glm::dvec3 gaussian() { return {normal(), normal(), normal()}; }
    glm::dmat3 rotation() { return glm::mat3_cast(glm::normalize(glm::dquat(normal(), normal(), normal(), normal()))); }
    /// Sides from 1 to 1/thinnest.
    glm::dvec3 stretch(double thinnest)
    {
        const auto side = [&] { return std::pow(thinnest, -uniform(0, 1)); };
        return {side(), side(), side()};
    }

private:
    std::mt19937 random_;
};

template <typename Make>
Points repeat(int count, Make&& make)
{
    Points points;
    for (int i = 0; i < count; ++i) points.push_back(make());
    return points;
}

constexpr int kinds = 8;

Points random_shape(Dice& dice, int kind)
{
    const int count = dice.integer(20, 300);
    const auto in_box = [&](const glm::dvec3& lo, const glm::dvec3& hi) {
        return lo + (dice.in_cube() * 0.5 + 0.5) * (hi - lo);
    };
    switch (kind) {
        case 0:
            return repeat(count, [&] { return dice.gaussian(); });
        case 1:
            return repeat(count, [&] {  // a box's surface
                glm::dvec3 p = dice.in_cube();
                p[dice.integer(0, 2)] = dice.integer(0, 1) ? 1.0 : -1.0;
                return p;
            });
        case 2:
            return repeat(dice.integer(4, 12), [&] { return dice.in_cube(); });
        case 3:
            return repeat(count, [&] { return glm::normalize(dice.gaussian()); });
        case 4:
            return repeat(count, [&] { return dice.in_cube() * glm::dvec3(1, 1, 0.01); });
        case 5: {  // a slanted prism over a polygon
            const Points base = repeat(dice.integer(3, 9), [&] { return dice.in_cube() * glm::dvec3(1, 1, 0); });
            Points points = base;
            const glm::dvec3 slant = dice.in_cube() + glm::dvec3(0, 0, 1.5);
            for (const glm::dvec3& p : base) points.push_back(p + slant);
            return points;
        }
        case 6: {  // an L
            const double across = dice.uniform(0.05, 0.5), along = dice.uniform(0.3, 1.0);
            return repeat(count, [&] {
                return dice.integer(0, 1) ? in_box({0, 0, 0}, {1, across, across})
                                          : in_box({0, 0, 0}, {across, along, across});
            });
        }
        default: {  // two spheres
            const glm::dvec3 apart = dice.in_cube() * 3.0;
            const double ratio = dice.uniform(0.2, 1.0);
            return repeat(count, [&] {
                const glm::dvec3 p = glm::normalize(dice.gaussian());
                return dice.integer(0, 1) ? p : apart + ratio * p;
            });
        }
    }
}

Points random_set(unsigned seed)
{
    Dice dice(seed);
    Points points = random_shape(dice, static_cast<int>(seed % kinds));
    const glm::dvec3 stretch = dice.integer(0, 1) ? glm::dvec3(1.0) : dice.stretch(100.0);
    const glm::dmat3 rotation = dice.rotation();
    const glm::dvec3 offset = dice.gaussian() * 10.0;
    for (glm::dvec3& p : points) p = rotation * (stretch * p) + offset;
    return points;
}

bool is_right_handed_orthonormal(const glm::dmat3& axes)
{
    const glm::dmat3 product = glm::transpose(axes) * axes;
    double error = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) error = std::max(error, std::abs(product[i][k] - (i == k ? 1.0 : 0.0)));
    return error <= 1e-12 && glm::determinant(axes) > 0.0;
}

/// However the dot product is summed.
bool is_outside(const Obb& box, const glm::dvec3& p)
{
    const glm::dvec3 d = p - box.centre;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 a = box.axes[i];
        const double sums[] = {glm::dot(d, a), d.x * a.x + (d.y * a.y + d.z * a.z),
                               std::fma(d.z, a.z, std::fma(d.y, a.y, d.x * a.x))};
        for (const double sum : sums)
            if (!(std::abs(sum) <= box.half[i])) return true;
    }
    return false;
}

/// returns  what is wrong with a box around these points; nothing if all is well
std::string fault(const Obb& box, const Points& points)
{
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(box.centre[i]) || !std::isfinite(box.half[i]) || box.half[i] < 0.0) return "not finite";
    if (!is_right_handed_orthonormal(box.axes)) return "axes";
    for (const glm::dvec3& p : points)
        if (std::isfinite(p.x + p.y + p.z) && is_outside(box, p)) return "a point is outside";
    return {};
}

/// Ratios of surface areas, ours by the slow search's.
struct Ratios {
    double least = infinity, most = 0.0;
    int count = 0, above = 0;  ///< those over 1.0001

    void add(double ratio)
    {
        least = std::min(least, ratio);
        most = std::max(most, ratio);
        above += ratio > 1.0001;
        ++count;
    }
    void print(const char* what) const
    {
        MESSAGE(std::string(what) << ": " << count << " sets, area by the slow search's from " << least << " to "
                                  << most << ", " << above << " above 1.0001");
    }
};

void compare_random_sets(unsigned first, unsigned last)
{
    Ratios ratios;
    for (unsigned seed = first; seed < last; ++seed) {
        const Points points = random_set(seed);
        const Obb box = obb::smallest_obb(points);
        const double ratio = obb::surface_area(box) / test::slow_obb_area(points);
        ratios.add(ratio);
        CAPTURE(seed);
        CHECK(fault(box, points).empty());
        CHECK(ratio <= 1.01);
    }
    ratios.print("random sets");
}

/// Few points on a point, a line, a plane, nearly so, or on a lattice, of any size and offset.
Points degenerate_set(unsigned seed)
{
    Dice dice(seed);
    const int shape = dice.integer(0, 5);
    const glm::dmat3 rotation = dice.integer(0, 2) ? dice.rotation() : glm::dmat3(1.0);
    const double noise = dice.integer(0, 2) ? 0.0 : std::pow(10.0, dice.uniform(-18, -3));
    const double size = std::pow(10.0, dice.uniform(-20, 15));
    const glm::dvec3 offset = dice.integer(0, 1) ? dice.gaussian() * 1e8 : glm::dvec3(0.0);
    const glm::dvec3 equal = dice.gaussian();
    const auto point = [&]() -> glm::dvec3 {
        switch (shape) {
            case 0:
                return equal;
            case 1:
                return {dice.normal(), 0, 0};
            case 2:
                return {dice.integer(-1, 1), 0, 0};
            case 3:
                return {dice.normal(), dice.normal(), 0};
            case 4:
                return {dice.integer(-1, 1), dice.integer(-1, 1), 0};
            default:
                return {dice.integer(-1, 1), dice.integer(-1, 1), dice.integer(-1, 1)};
        }
    };
    const int count = dice.integer(1, dice.integer(0, 9) ? 12 : 100);
    return repeat(count, [&] { return rotation * (point() + dice.gaussian() * noise) * size + offset; });
}

void check_degenerate_sets(unsigned first, unsigned last)
{
    int violations = 0;
    for (unsigned seed = first; seed < last; ++seed) {
        const Points points = degenerate_set(seed);
        const std::string wrong = fault(obb::smallest_obb(points), points);
        if (wrong.empty()) continue;
        ++violations;
        CAPTURE(seed);
        CHECK(wrong == "");
    }
    CHECK(violations == 0);
}

}  // namespace

TEST_CASE("a box around 200 random sets is within 1 % of the smallest that a slow search finds")
{
    compare_random_sets(0, 200);
}

TEST_CASE("a box around 10,000 random sets is within 1 % of the smallest that a slow search finds" * doctest::skip())
{
    compare_random_sets(1000, 11'000);
}

TEST_CASE("a box around every group of Robots and Kitchen is within 1 % of the smallest that a slow search finds")
{
    for (const char* name : {"robots/Robot.aff", "kitchen/kitchen.aff"}) {
        const auto file = test::bart_file(name);
        if (!file) return;
        const Scene scene = read_aff(*file);
        Ratios ratios;
        std::map<std::vector<double>, double> slow_areas;  // the ten robots are alike
        for (const Group& group : scene.groups) {
            const auto first = scene.positions.begin() + group.first_vertex;
            const Points points(first, first + group.vertices);
            if (points.empty()) continue;
            const auto [place, is_new] = slow_areas.try_emplace({&points[0].x, &points[0].x + 3 * points.size()});
            if (is_new) place->second = test::slow_obb_area(points);
            const Obb box = obb::smallest_obb(points);
            const double ratio = obb::surface_area(box) / place->second;
            ratios.add(ratio);
            CAPTURE(name);
            CAPTURE(&group - scene.groups.data());
            CHECK(fault(box, points).empty());
            CHECK(ratio <= 1.01);
        }
        ratios.print(name);
    }
}

TEST_CASE("boxes whose smallest box is known are found")
{
    const auto tetrahedron = Points{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (unsigned seed = 0; seed < 50; ++seed) {
        CAPTURE(seed);
        Dice dice(seed);
        const glm::dmat3 rotation = dice.rotation();
        const glm::dvec3 half = dice.stretch(1000.0), offset = dice.gaussian();
        Points corners, four;
        for (int i = 0; i < 8; ++i)
            corners.push_back(rotation * (half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)) + offset);
        const double expected = 8.0 * (half.x * half.y + half.y * half.z + half.z * half.x);
        CHECK(obb::surface_area(obb::smallest_obb(corners)) == doctest::Approx(expected).epsilon(1e-9));
        for (const glm::dvec3& p : tetrahedron) four.push_back(rotation * p + offset);
        CHECK(obb::surface_area(obb::smallest_obb(four)) <= 24.0 * (1.0 + 1e-9));
    }
}

TEST_CASE("a box that stands straight comes back without rounding of its axes")
{
    Points corners;
    for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 3 : 1, i & 2 ? 7 : 4, i & 4 ? 2 : 1});
    const Obb box = obb::smallest_obb(corners);
    CHECK(box.axes == glm::dmat3(1.0));
    CHECK(box.centre == glm::dvec3(2.0, 5.5, 1.5));
    CHECK(fault(box, corners).empty());
}

TEST_CASE("no point and points that are not finite make a box of no size, among others they are ignored")
{
    const Points no_points, bad{{nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}};
    for (const Points& points : {no_points, bad}) {
        const Obb box = obb::smallest_obb(points);
        CHECK(box.axes == glm::dmat3(1.0));
        CHECK(box.centre == glm::dvec3(0.0));
        CHECK(box.half == glm::dvec3(0.0));
    }
    Points mixed = random_set(3);
    const double area = obb::surface_area(obb::smallest_obb(mixed));
    mixed.insert(mixed.begin() + 2, bad.begin(), bad.end());
    CHECK(obb::surface_area(obb::smallest_obb(mixed)) == area);
    CHECK(fault(obb::smallest_obb(mixed), mixed).empty());
}

TEST_CASE("points, lines and planes get boxes as flat as they are")
{
    CHECK(obb::smallest_obb(Points(1'000'000, {0.1, 0.2, 0.3})).half == glm::dvec3(0.0));
    for (unsigned seed = 0; seed < 200; ++seed) {
        CAPTURE(seed);
        Dice dice(seed);
        const double size = std::pow(10.0, dice.uniform(-20, 15));
        const glm::dmat3 axes = size * dice.rotation();
        const Points line = repeat(dice.integer(2, 50), [&] { return axes[0] * dice.normal(); });
        const Points plane =
            repeat(dice.integer(3, 50), [&] { return axes[0] * dice.normal() + axes[1] * dice.normal(); });
        const auto sorted_half = [](const Points& points) {
            glm::dvec3 half = obb::smallest_obb(points).half;
            std::sort(&half.x, &half.x + 3);
            return half;
        };
        CHECK(sorted_half(line).y <= 1e-14 * size);
        CHECK(sorted_half(plane).x <= 1e-13 * size);
    }
}

TEST_CASE("1,000 random degenerate sets get right-handed orthonormal boxes that no point is outside")
{
    check_degenerate_sets(0, 1000);
}

TEST_CASE("100,000 random degenerate sets get right-handed orthonormal boxes that no point is outside" *
          doctest::skip())
{
    check_degenerate_sets(1000, 101'000);
}

}  // namespace firstray
