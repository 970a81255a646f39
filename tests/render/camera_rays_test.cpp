#include "engine/render/camera_rays.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "tests/support/small_scene.h"

using namespace firstray;

namespace {

/// Largest difference of two points' coordinates.
double apart(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

}  // namespace

TEST_CASE("camera rays run through square pixels, rows from the top, the angle spanning the height")
{
    test::SmallScene small;
    small.scene.view = {.from = {1, 2, 3}, .at = {1, 2, 7}, .up = {0, 2, 0}, .angle = 90.0, .hither = 0.5};
    const Scene scene = small.build();
    const CameraRays camera = camera_rays(pose(scene, 0.0), 4, 2);
    CHECK(apart(camera.eye, {1, 2, 3}) == 0.0);
    // Looking along +z with y up, right is -x; half the height is tan 45 = 1, half the width 2.
    CHECK(apart(direction(camera, {2, 1}), {0, 0, 1}) < 1e-15);
    CHECK(apart(direction(camera, {0, 0}), glm::dvec3(2, 1, 1) / std::sqrt(6.0)) < 1e-15);
    CHECK(apart(direction(camera, {4, 2}), glm::dvec3(-2, -1, 1) / std::sqrt(6.0)) < 1e-15);
    CHECK(apart(direction(camera, {0.5, 1.5}), glm::dvec3(1.5, -0.5, 1) / std::sqrt(3.5)) < 1e-15);
}

TEST_CASE("a point on the ray through a place is projected to that place, behind the eye too")
{
    test::SmallScene small;
    small.scene.view = {.from = {1, 2, 3}, .at = {4, 1, 7}, .up = {0, 2, 0}, .angle = 50.0, .hither = 0.5};
    const Scene scene = small.build();
    const CameraRays camera = camera_rays(pose(scene, 0.0), 400, 200);
    for (const glm::dvec2 place : {glm::dvec2(0, 0), {200, 100}, {399.5, 0.5}, {-50, 300}})
        for (const double t : {0.25, 5.0, -5.0}) {
            CAPTURE(place.x);
            CAPTURE(t);
            const glm::dvec3 ray = direction(camera, place), found = project(camera, camera.eye + t * ray);
            CHECK(found.z == doctest::Approx(t * glm::dot(ray, camera.forward)));
            CHECK(apart({found.x / found.z, found.y / found.z, 0}, {place, 0}) < 1e-9);
        }
}

TEST_CASE("primary rays start at the eye's apex, at the depth of the near plane")
{
    test::SmallScene small;
    small.scene.view.hither = 0.5;
    const Scene scene = small.build();
    const CameraRays camera = camera_rays(pose(scene, 0.0), 2, 2);
    const auto rays = std::make_unique<RayTile<double>>();
    const glm::ivec2 pixels[] = {{0, 0}, {1, 1}};
    aim<double>(camera, pixels, {0.0, 0.0}, *rays);
    REQUIRE(rays->count == 2);
    CHECK(rays->common_apex);
    CHECK(rays->mask == RayMask::all);
    CHECK(apart(rays->direction_of(0), glm::dvec3(-1, 1, -1) / std::sqrt(3.0)) < 1e-15);
    CHECK(apart(rays->direction_of(1), {0, 0, -1}) < 1e-15);
    CHECK(rays->t_min[0] == doctest::Approx(0.5 * std::sqrt(3.0)));
    CHECK(rays->t_min[1] == 0.5);
    CHECK(std::isinf(rays->t_max[0]));
}

TEST_CASE("square numbers of samples lie on a grid in the pixel, others are well spread")
{
    CHECK(sample_places(1) == std::vector<glm::dvec2>{{0.5, 0.5}});
    CHECK(sample_places(4) == std::vector<glm::dvec2>{{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}});
    const auto nine = sample_places(9);
    REQUIRE(nine.size() == 9);
    CHECK(nine[5].x == doctest::Approx(5.0 / 6.0));
    CHECK(nine[5].y == doctest::Approx(0.5));
    for (const int count : {2, 3, 5, 7, 10, 48}) {
        CAPTURE(count);
        const auto places = sample_places(count);
        REQUIRE(places.size() == static_cast<std::size_t>(count));
        double nearest = 1.0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            CHECK((places[i].x >= 0.0 && places[i].x < 1.0 && places[i].y >= 0.0 && places[i].y < 1.0));
            for (std::size_t k = 0; k < i; ++k) nearest = std::min(nearest, glm::distance(places[i], places[k]));
        }
        CHECK(nearest > 0.5 / std::sqrt(count));
    }
}

TEST_CASE("the tiles of a picture cover each pixel once, full 4 x 4 blocks first")
{
    for (const glm::ivec2 picture : {glm::ivec2(1, 1), {33, 31}, {64, 32}, {70, 45}}) {
        CAPTURE(picture.x);
        std::set<std::pair<int, int>> seen;
        std::vector<glm::ivec2> pixels;
        const glm::ivec2 tiles = tile_counts(picture.x, picture.y);
        for (int y = 0; y < tiles.y; ++y)
            for (int x = 0; x < tiles.x; ++x) {
                tile_pixels({x, y}, picture.x, picture.y, pixels);
                const glm::ivec2 size = glm::min(picture - glm::ivec2(x, y) * tile_width, tile_width);
                const auto in_full_blocks = static_cast<std::size_t>((size.x / 4) * (size.y / 4) * 16);
                REQUIRE(pixels.size() == static_cast<std::size_t>(size.x * size.y));
                for (std::size_t i = 0; i < pixels.size(); ++i) {
                    CHECK(seen.insert({pixels[i].x, pixels[i].y}).second);
                    if (i < in_full_blocks) CHECK(pixels[i] / 4 == pixels[i / 16 * 16] / 4);
                }
            }
        CHECK(seen.size() == static_cast<std::size_t>(picture.x * picture.y));
        CHECK(seen.rbegin()->first == picture.x - 1);
    }
}
