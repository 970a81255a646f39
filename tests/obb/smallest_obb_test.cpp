#include "obb/smallest_obb.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
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
    glm::dmat3 rotation()
    {
        return glm::mat3_cast(glm::normalize(glm::dquat(normal(), normal(), normal(), normal())));
    }
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
        case 0: return repeat(count, [&] { return dice.gaussian(); });
        case 1: return repeat(count, [&] {  // a box's surface
            glm::dvec3 p = dice.in_cube();
            p[dice.integer(0, 2)] = dice.integer(0, 1) ? 1.0 : -1.0;
            return p;
        });
        case 2: return repeat(dice.integer(4, 12), [&] { return dice.in_cube(); });
        case 3: return repeat(count, [&] { return glm::normalize(dice.gaussian()); });
        case 4: return repeat(count, [&] { return dice.in_cube() * glm::dvec3(1, 1, 0.01); });
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
        MESSAGE(what << ": " << count << " sets, area by the slow search's from " << least << " to " << most << ", "
                     << above << " above 1.0001");
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

}  // namespace

TEST_CASE("a box around 400 random sets is within 1 % of the smallest that a slow search finds")
{
    compare_random_sets(0, 400);
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
        for (const Group& group : scene.groups) {
            const auto first = scene.positions.begin() + group.first_vertex;
            const Points points(first, first + group.vertices);
            if (points.empty()) continue;
            const Obb box = obb::smallest_obb(points);
            const double ratio = obb::surface_area(box) / test::slow_obb_area(points);
            ratios.add(ratio);
            CAPTURE(name);
            CAPTURE(&group - scene.groups.data());
            CHECK(fault(box, points).empty());
            CHECK(ratio <= 1.01);
        }
        ratios.print(name);
    }
}

}  // namespace firstray
