#include "engine/scene/track.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/aff/reader.h"
#include "tests/support/bart.h"

namespace firstray {
namespace {

Key key(double time, glm::dvec3 value, double angle = 0.0)
{
    Key k;
    k.time = time;
    k.value = value;
    k.angle = angle;
    return k;
}

/// Keys on the x axis at the given times and places.
VectorTrack track_along_x(const std::vector<std::pair<double, double>>& points)
{
    std::vector<Key> keys;
    for (const auto& [time, x] : points) keys.push_back(key(time, {x, 0.0, 0.0}));
    return VectorTrack(keys);
}

RotationTrack turns_about_z(const std::vector<std::pair<double, double>>& angles)
{
    std::vector<Key> keys;
    for (const auto& [time, angle] : angles) keys.push_back(key(time, {0.0, 0.0, 1.0}, angle));
    return RotationTrack(keys);
}

double degrees_about_z(const glm::dmat3& m)
{
    return glm::degrees(std::atan2(m[0].y, m[0].x));
}

struct GoldenRow {
    std::string scene, track;
    int frame;
    double time;
    double m[3][4];
};

std::vector<GoldenRow> golden_rows(const std::filesystem::path& file)
{
    std::vector<GoldenRow> rows;
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);  // titles
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        GoldenRow row;
        std::string text;
        const auto next = [&] { return std::getline(fields, text, ',') ? text : std::string(); };
        row.scene = next();
        row.track = next();
        row.frame = std::stoi(next());
        row.time = std::stod(next());
        for (auto& matrix_row : row.m)
            for (double& entry : matrix_row) entry = std::stod(next());
        rows.push_back(row);
    }
    return rows;
}

const Animation* find(const Scene& scene, const std::string& name)
{
    for (const Animation& animation : scene.animations)
        if (animation.name == name) return &animation;
    return nullptr;
}

double largest_difference(const Transform& a, const double (&b)[3][4])
{
    double largest = 0.0;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            largest = std::max(largest, std::abs(a.linear[column][row] - b[row][column]));
        largest = std::max(largest, std::abs(a.offset[row] - b[row][3]));
    }
    return largest;
}

}  // namespace

TEST_CASE("animations follow the published paths of BART in all 1,321 rows of the golden file")
{
    const auto golden = test::bart_file("golden-transforms.csv");
    const auto robots = test::bart_file("robots/Robot.aff");
    const auto kitchen = test::bart_file("kitchen/kitchen.aff");
    const auto museum = test::bart_file("museum/museum5.aff");
    if (!golden || !robots || !kitchen || !museum) return;
    std::map<std::string, Scene> scenes;
    scenes["robots"] = read_aff(*robots);
    scenes["kitchen"] = read_aff(*kitchen);
    scenes["museum"] = read_aff(*museum);

    const std::vector<GoldenRow> rows = golden_rows(*golden);
    CHECK(rows.size() == 1321);
    double largest = 0.0;
    for (const GoldenRow& row : rows) {
        CAPTURE(row.scene);
        CAPTURE(row.track);
        CAPTURE(row.frame);
        const Scene& scene = scenes.at(row.scene);
        const Animation* animation = find(scene, row.track);
        REQUIRE(animation);
        CHECK(scene.time_of(row.frame) == doctest::Approx(row.time).epsilon(1e-7));
        const double difference = largest_difference(animation->at(scene.time_of(row.frame)), row.m);
        CHECK(difference < 1e-4);
        largest = std::max(largest, difference);
    }
    MESSAGE("largest difference " << largest << " in " << rows.size() << " matrices");
}

TEST_CASE("a spline holds the value of its second key before it and of its last but one after it")
{
    const VectorTrack track = track_along_x({{0, -7}, {1, 10}, {2, 20}, {3, 99}});
    CHECK(track.at(-5.0).x == 10.0);
    CHECK(track.at(1.0).x == 10.0);
    CHECK(track.at(2.0).x == doctest::Approx(20.0));
    CHECK(track.at(50.0).x == track.at(2.0).x);
}

TEST_CASE("a spline through equally spaced keys on a line moves evenly")
{
    const VectorTrack track = track_along_x({{0, 0}, {1, 10}, {2, 20}, {3, 30}, {4, 40}});
    for (double t = 1.0; t <= 3.0; t += 0.125) CHECK(track.at(t).x == doctest::Approx(10.0 * t));
}

TEST_CASE("tangents are corrected for unequal key distances")
{
    // a0 = (t2-t1)/(t2-t0) = 1/4 scales both differences, so out = (40 + 10)/4, in = (10 + 10)/2, at s = 1/2:
    const VectorTrack track = track_along_x({{0, -40}, {3, 0}, {4, 10}, {5, 20}});
    CHECK(track.at(3.5).x == doctest::Approx(5.0 + (12.5 - 10.0) / 8.0));
}

TEST_CASE("tension 1 stops at a key")
{
    std::vector<Key> keys{key(0, {0, 0, 0}), key(1, {1, 0, 0}), key(2, {2, 0, 0}), key(3, {3, 0, 0})};
    keys[1].tension = keys[2].tension = 1.0;
    const VectorTrack track(keys);
    CHECK(track.at(1.001).x - 1.0 < 1e-5);
    CHECK(track.at(1.5).x == doctest::Approx(1.5));
}

TEST_CASE("where key times jump back the run before the jump counts")
{
    std::vector<Key> keys;
    for (const auto& [time, x] : {std::pair{0, 0}, {1, 10}, {5, 50}, {2, -100}, {6, 60}, {7, 70}}) {
        keys.push_back(key(time, {x, 0.0, 0.0}));
        keys.back().tension = 1.0;  // no tangents: s*s*(3 - 2*s) of the way
    }
    const VectorTrack track(keys);
    CHECK(track.at(3.0).x == doctest::Approx(30.0));
    CHECK(track.at(4.0).x == doctest::Approx(10.0 + 40.0 * 0.84375));
    CHECK(track.at(5.0).x == doctest::Approx(-100.0 + 160.0 * 0.84375));  // the segment from 2 to 6
}

TEST_CASE("keys with equal times never give a NaN")
{
    for (const std::vector<double>& times :
         {std::vector<double>{0, 0, 1, 1}, {0, 1, 1, 2}, {1, 1, 1, 1}, {0, 0, 0, 1, 1, 1}}) {
        std::vector<std::pair<double, double>> points;
        for (const double t : times) points.emplace_back(t, 10.0 * static_cast<double>(points.size()));
        for (double t = -0.5; t < 2.5; t += 0.25) {
            CHECK(std::isfinite(track_along_x(points).at(t).x));
            CHECK(std::isfinite(turns_about_z(points).at(t)[0].x));
        }
    }
}

TEST_CASE("rotations turn counter-clockwise about their axis and hold their ends")
{
    const RotationTrack track = turns_about_z({{0, 0}, {1, 0}, {2, 90}, {3, 90}});
    CHECK(degrees_about_z(track.at(0.0)) == doctest::Approx(0.0));
    CHECK(degrees_about_z(track.at(1.5)) == doctest::Approx(45.0));
    CHECK(degrees_about_z(track.at(2.0)) == doctest::Approx(90.0));
    CHECK(degrees_about_z(track.at(9.0)) == doctest::Approx(90.0));
}

TEST_CASE("a wheel with keys 90 degrees apart spins evenly through many turns")
{
    std::vector<std::pair<double, double>> angles;
    for (int i = 0; i < 100; ++i) angles.emplace_back(i, 90.0 * i);
    const RotationTrack track = turns_about_z(angles);
    for (double t = 1.0; t <= 98.0; t += 0.125) {
        const double off = std::remainder(degrees_about_z(track.at(t)) - 90.0 * t, 360.0);
        CHECK(std::abs(off) < 1e-6);
    }
}

TEST_CASE("rotation axes that are too long give rotations, not NaNs")
{
    std::vector<Key> keys;
    for (int i = 0; i < 6; ++i) keys.push_back(key(i, {0.0, 0.0, 1.2}, 10.0 * (i % 2)));
    const RotationTrack track(keys);
    for (double t = 0.0; t < 6.0; t += 0.01) {
        const glm::dmat3 m = track.at(t);
        CHECK(std::abs(glm::determinant(m) - 1.0) < 1e-9);
    }
}

TEST_CASE("a key that is turned to the other sign goes on with an axis of unit length")
{
    const auto track = [](double length) {
        std::vector<Key> keys;
        for (const double angle : {0.0, 10.0, 390.0, 400.0, 430.0})
            keys.push_back(key(double(keys.size()), {0, 0, 1}, angle));
        keys[2].value.z = length;  // 390 degrees have the opposite sign of 10
        return RotationTrack(keys);
    };
    CHECK(degrees_about_z(track(1.2).at(2.5)) == doctest::Approx(degrees_about_z(track(1.0).at(2.5))).epsilon(1e-12));
    CHECK(std::abs(degrees_about_z(track(1.2).at(1.5)) - degrees_about_z(track(1.0).at(1.5))) > 0.1);
}

TEST_CASE("missing tracks are the identity")
{
    const Transform t = Animation{}.at(3.0);
    CHECK(t.linear == glm::dmat3(1.0));
    CHECK(t.offset == glm::dvec3(0.0));
    CHECK(Animation{}.visible_at(3.0));
}

TEST_CASE("an animation scales first, then turns, then moves")
{
    Animation animation;
    std::vector<Key> scale, turn, move;
    for (int i = 0; i < 4; ++i) {
        scale.push_back(key(i, {2, 3, 4}));
        turn.push_back(key(i, {0, 0, 1}, 90.0));
        move.push_back(key(i, {10, 20, 30}));
    }
    animation.scale = VectorTrack(scale);
    animation.rotation = RotationTrack(turn);
    animation.translation = VectorTrack(move);
    const glm::dvec3 p = animation.at(1.5).point({1, 1, 1});
    CHECK(p.x == doctest::Approx(10.0 - 3.0));
    CHECK(p.y == doctest::Approx(20.0 + 2.0));
    CHECK(p.z == doctest::Approx(30.0 + 4.0));
}

TEST_CASE("visibility changes exactly at its keys, visible before the first")
{
    Animation animation;
    animation.visibility = {{1.0, false}, {2.0, true}, {3.0, false}};
    CHECK(animation.visible_at(0.999));
    CHECK_FALSE(animation.visible_at(1.0));
    CHECK(animation.visible_at(2.5));
    CHECK_FALSE(animation.visible_at(1e9));
}

}  // namespace firstray
