#include "engine/render/render.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>

#include "engine/render/camera_rays.h"
#include "engine/render/shade.h"
#include "tests/support/reference_strategy.h"
#include "tests/support/small_scene.h"

using namespace firstray;

namespace {

const Material grey;
const Material lamp{.ambient = glm::vec3(1.0f), .diffuse = glm::vec3(0.0f)};
const RenderOptions one_pixel{.width = 1, .height = 1, .depth = 0};

struct Picture {
    Frame frame;
    RayCounts counts;
};

template <typename Real = float>
Picture rendered(const Scene& scene, const RenderOptions& options, int threads = 1)
{
    const Pose at_start = pose(scene, scene.start);
    test::ReferenceStrategy<Real> strategy;
    strategy.update(at_start);
    Picture picture;
    picture.counts = render<Real>(strategy, at_start, {}, options, Executor(threads), picture.frame);
    return picture;
}

/// Triangles and spheres, dull, shining, mirroring and transmitting, in two lights.
/// enclosed  put mirroring and transmitting spheres around all: rays then become ever more
Scene mixed_scene(bool enclosed = false)
{
    std::mt19937 random(7);
    const auto number = [&](double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(random()) * 0x1p-32);
    };
    const auto point = [&](double size) {
        return glm::dvec3(number(-size, size), number(-size, size), number(-size, size));
    };
    const Material mirror{.specular = {0.5f, 0.7f, 0.2f}, .shine = 20.0f};
    const Material glass{.diffuse = glm::vec3(0.1f), .specular = glm::vec3(0.2f), .transmittance = 0.7f, .ior = 1.5f};
    const Material veil{.diffuse = {0.2f, 0.5f, 0.1f}, .transmittance = 0.4f};
    test::SmallScene small;
    small.scene.background = {0.2f, 0.3f, 0.5f};
    small.light({5, 6, 2}, {0.7f, 0.6f, 0.5f}).light({-6, 1, 0}, {0.2f, 0.3f, 0.4f});
    for (const Material& material : {grey, mirror, glass, veil})
        for (int i = 0; i < 6; ++i) {
            const glm::dvec3 centre = point(2.5) + glm::dvec3(0, 0, -5);
            small.triangle(material, centre + point(1.5), centre + point(1.5), centre + point(1.5));
            if (i < 2) small.sphere(material, centre, number(0.3, 0.8));
        }
    if (enclosed)
        for (const double radius : {20.0, 21.0, 22.0, 23.0}) small.sphere(glass, {0, 0, -5}, radius);
    return small.build();
}

/// The shading rule by plain recursion, a ray at a time.
class Recursion {
public:
    explicit Recursion(const Scene& scene) : pose_(pose(scene, scene.start)) { strategy_.update(pose_); }
    const Pose& at_start() const { return pose_; }
    std::uint64_t searches() const { return searches_; }

    glm::vec3 trace(const glm::dvec3& origin, const glm::dvec3& direction, double begin, int depth)
    {
        const Scene& scene = *pose_.scene;
        search(origin, direction, begin, std::numeric_limits<double>::infinity(), RayMask::all);
        if (rays_->primitive[0] == no_primitive) return scene.background;
        const Surface s = surface_at(pose_, {}, ray_hit(*rays_, 0));
        glm::vec3 colour = ambient_term(s, scene.ambient);
        for (std::size_t i = 0; i < pose_.lights.size(); ++i) {
            const glm::dvec3 to_light = pose_.lights[i] - s.point;
            if (responds_to(s, to_light))
                colour += visible(pose_.lights[i], s) * light_term(s, to_light, scene.lights[i].colour);
        }
        if (depth == 0) return colour;
        if (s.material->specular != glm::vec3(0.0f))
            colour += s.material->specular * follow(s, reflected_direction(s), depth);
        if (s.material->transmits()) colour += s.material->transmittance * follow(s, transmitted_direction(s), depth);
        return colour;
    }

private:
    glm::vec3 follow(const Surface& s, const glm::dvec3& direction, int depth)
    {
        return trace(start_of_ray<double>(s, direction), direction, 0.0, depth - 1);
    }

    float visible(const glm::dvec3& light, const Surface& s)
    {
        const glm::dvec3 way = end_of_shadow_ray<double>(s, light) - light;
        search(light, way, 0.0, 1.0, RayMask::opaque);
        if (rays_->primitive[0] != no_primitive) return 0.0f;
        float light_left = 1.0f;
        for (double begin = 0.0;; begin = rays_->t_max[0]) {
            search(light, way, begin, 1.0, RayMask::transmitting);
            if (rays_->primitive[0] == no_primitive) return light_left;
            light_left *= pose_.scene->material(rays_->primitive[0]).transmittance;
        }
    }

    void search(const glm::dvec3& origin, const glm::dvec3& direction, double begin, double end, RayMask mask)
    {
        ++searches_;
        rays_->count = 1;
        rays_->mask = mask;
        rays_->set_origin(0, origin);
        rays_->set_direction(0, direction);
        rays_->set_interval(0, begin, end);
        strategy_.closest(*rays_);
    }

    std::uint64_t searches_ = 0;
    Pose pose_;
    test::ReferenceStrategy<double> strategy_;
    std::unique_ptr<RayTile<double>> rays_ = std::make_unique<RayTile<double>>();
};

}  // namespace

TEST_CASE_TEMPLATE("a lit surface has the colour of the shading rule", Real, float, double)
{
    const Material m{
        .ambient = {0.1f, 0.2f, 0.3f}, .diffuse = {0.5f, 0.4f, 0.3f}, .specular = glm::vec3(0.2f), .shine = 2.0f};
    test::SmallScene small;
    small.quad(m, {0, 0, -2}, {1, 0, 0}, {0, 1, 0}).light({0, 2, 0}, {1.0f, 0.5f, 0.25f});
    small.scene.ambient = glm::vec3(0.5f);
    const Picture p = rendered<Real>(small.build(), one_pixel);
    // The light stands at 45 degrees: N.l = R.V = sqrt(1/2).
    const glm::vec3 light = (m.diffuse * std::sqrt(0.5f) + 0.2f * 0.5f) * glm::vec3(1.0f, 0.5f, 0.25f);
    CHECK(glm::distance(p.frame.colour[0], 0.5f * m.ambient + light) < 1e-6f);
    CHECK(p.frame.distance[0] == 2.0f);
    CHECK(p.frame.primitive[0] == 0);
    CHECK(p.frame.group[0] == 0);
    CHECK(p.counts.primary == 1);
    CHECK(p.counts.shadow == 1);
    CHECK(p.counts.total() == 2);
}

TEST_CASE("rays that meet nothing show the background, and layers say so")
{
    test::SmallScene small;
    small.scene.background = {0.5f, 0.25f, 3.0f};
    const Picture p = rendered(small.build(), {.width = 5, .height = 3});
    REQUIRE(p.frame.colour.size() == 15);
    for (std::size_t i = 0; i < 15; ++i) {
        CHECK(p.frame.colour[i] == glm::vec3(0.5f, 0.25f, 1.0f));
        CHECK(std::isinf(p.frame.distance[i]));
        CHECK(p.frame.primitive[i] == no_primitive);
        CHECK(p.frame.group[i] == 4294967295u);
    }
    CHECK(p.frame.cells.empty());
    CHECK(p.frame.tests.empty());
    CHECK(p.frame.nanoseconds.empty());
    CHECK(p.counts.total() == 15);
}

TEST_CASE("an opaque surface blocks a light, transmitting ones dim it by each transmittance")
{
    const Material veil{.transmittance = 0.5f}, glass{.transmittance = 0.25f, .ior = 1.5f};
    const auto picture = [](const Material* upper, const Material* lower) {
        test::SmallScene small;
        small.scene.ambient = glm::vec3(0.0f);
        small.quad({.diffuse = glm::vec3(1.0f)}, {0, 0, -2}, {1, 0, 0}, {0, 1, 0}).light({0, 2, 0});
        // Small ones, off the centre so that the light does not pass along a diagonal.
        if (upper) small.quad(*upper, {0.05, 1, -1}, {0.2, 0, 0}, {0, 0.2, 0});
        if (lower) small.quad(*lower, {0.05, 0.5, -1.5}, {0.2, 0, 0}, {0, 0.2, 0});
        return rendered(small.build(), one_pixel);
    };
    const float full = std::sqrt(0.5f);
    const auto red = [](const Picture& p) { return p.frame.colour[0].r; };
    CHECK(red(picture(nullptr, nullptr)) == doctest::Approx(full));
    CHECK(red(picture(&grey, nullptr)) == 0.0f);
    CHECK(red(picture(&veil, nullptr)) == doctest::Approx(full * 0.5f));
    CHECK(red(picture(&veil, &glass)) == doctest::Approx(full * 0.125f));
    CHECK(red(picture(&glass, &veil)) == doctest::Approx(full * 0.125f));
    CHECK(red(picture(&grey, &veil)) == 0.0f);
    CHECK(red(picture(&veil, &grey)) == 0.0f);

    CHECK(picture(nullptr, nullptr).counts.shadow == 1);
    CHECK(picture(&grey, &veil).counts.shadow == 1);
    CHECK(picture(&veil, &glass).counts.shadow == 4);  // one for opaque ones, two that find a veil, one that does not
}

TEST_CASE("surfaces turned away from a light cost no shadow ray")
{
    test::SmallScene small;
    small.quad(grey, {0, 0, -2}, {1, 0, 0}, {0, 1, 0}).light({0, 0, -5});
    const Picture p = rendered(small.build(), one_pixel);
    CHECK(p.counts.shadow == 0);
    CHECK(p.frame.colour[0].r == 0.2f);
}

TEST_CASE_TEMPLATE("two mirrors reflect each other as often as the depth says", Real, float, double)
{
    const Material mirror{.ambient = glm::vec3(0.125f), .diffuse = glm::vec3(0.0f), .specular = glm::vec3(0.5f)};
    test::SmallScene small;
    small.quad(mirror, {0, 0, -2}, {1, 0, 0}, {0, 1, 0}).quad(mirror, {0, 0, 3}, {1, 0, 0}, {0, 1, 0});
    const Scene scene = small.build();
    float expected = 0.0f, weight = 0.125f;
    for (int depth = 0; depth <= 8; ++depth) {
        CAPTURE(depth);
        expected += weight;
        weight *= 0.5f;
        const Picture p = rendered<Real>(scene, {.width = 1, .height = 1, .depth = depth});
        CHECK(p.frame.colour[0] == glm::vec3(expected));
        CHECK(p.counts.reflected == static_cast<std::uint64_t>(depth));
        CHECK(p.counts.total() == static_cast<std::uint64_t>(depth + 1));
    }
}

TEST_CASE("a reflected ray brings the background, weighted, unless the depth ends before it")
{
    test::SmallScene small;
    small.quad({.ambient = glm::vec3(0.0f), .specular = {0.5f, 0.25f, 0.0f}}, {0, 0, -2}, {1, 0, 0}, {0, 1, 0});
    small.scene.background = {0.5f, 1.0f, 1.0f};
    const Scene scene = small.build();
    CHECK(rendered(scene, {.width = 1, .height = 1, .depth = 1}).frame.colour[0] == glm::vec3(0.25f, 0.25f, 0.0f));
    CHECK(rendered(scene, one_pixel).frame.colour[0] == glm::vec3(0.0f));
}

TEST_CASE_TEMPLATE("a slab of glass shifts what stands behind it", Real, float, double)
{
    // The view is at 45 degrees to a slab from z = -1 to -2. Inside, the ray's sine is sqrt(1/2) / 1.5.
    const double inside = std::sqrt(0.5) / 1.5;
    const double shifted = 1.0 + inside / std::sqrt(1.0 - inside * inside) + 1.0;
    const auto picture = [&](float ior, double target, int depth) {
        const Material glass{.ambient = glm::vec3(0.0f), .diffuse = glm::vec3(0.0f), .transmittance = 0.5f, .ior = ior};
        test::SmallScene small;
        small.scene.view.at = {0, 1, -1};
        small.quad(glass, {0.1, 0, -1}, {9, 0, 0}, {0, 9, 0}).quad(glass, {0.1, 0, -2}, {9, 0, 0}, {0, -9, 0});
        small.quad(lamp, {0.0005, target, -3}, {0.001, 0, 0}, {0, 0.001, 0});
        return rendered<Real>(small.build(), {.width = 1, .height = 1, .depth = depth});
    };
    CHECK(picture(1.5f, shifted, 2).frame.colour[0] == glm::vec3(0.25f));
    CHECK(picture(1.5f, shifted, 2).counts.transmitted == 2);
    CHECK(picture(1.5f, 3.0, 2).frame.colour[0] == glm::vec3(0.0f));
    CHECK(picture(1.0f, 3.0, 2).frame.colour[0] == glm::vec3(0.25f));
    CHECK(picture(0.0f, 3.0, 2).frame.colour[0] == glm::vec3(0.25f));
    CHECK(picture(1.5f, shifted, 1).frame.colour[0] == glm::vec3(0.0f));
}

TEST_CASE("tracing generation by generation gives the colours of plain recursion, from as many rays in each pixel")
{
    const Scene scene = mixed_scene(true);
    Recursion recursion(scene);
    const int width = 45, height = 37;
    for (const int depth : {0, 1, 5}) {
        CAPTURE(depth);
        const RenderOptions options{.width = width, .height = height, .depth = depth, .costs = true};
        const Picture p = rendered<double>(scene, options);
        const CameraRays camera = camera_rays(recursion.at_start(), width, height);
        float worst = 0.0f;
        int other_counts = 0;
        for (std::size_t i = 0; i < p.frame.pixel_count(); ++i) {
            const auto x = static_cast<double>(i % width), y = static_cast<double>(i / width);
            const glm::dvec3 d = direction(camera, {x + 0.5, y + 0.5});
            const double begin = camera.hither / glm::dot(d, camera.forward);
            const std::uint64_t before = recursion.searches();
            const glm::vec3 expected = glm::clamp(recursion.trace(camera.eye, d, begin, depth), 0.0f, 1.0f);
            const glm::vec3 off = glm::abs(p.frame.colour[i] - expected);
            worst = std::max({worst, off.r, off.g, off.b});
            other_counts += recursion.searches() - before != p.frame.cells[i];
        }
        CHECK(worst < 1e-5f);
        CHECK(other_counts == 0);
        // More than a RayTile holds in some generation of one of the picture's 4 tiles: queues are cut.
        if (depth == 5) CHECK(p.counts.transmitted > 5 * 4 * RayTile<double>::capacity);
    }
}

TEST_CASE_TEMPLATE("pictures and counts do not depend on the number of threads", Real, float, double)
{
    const Scene scene = mixed_scene();
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(33, 31), glm::ivec2(100, 70)})
        for (const int samples : {1, 4, 5}) {
            if (samples > 1 && size.x == 100) continue;
            CAPTURE(size.x);
            CAPTURE(samples);
            const RenderOptions options{.width = size.x, .height = size.y, .depth = 4, .samples = samples};
            const Picture one = rendered<Real>(scene, options);
            for (const glm::vec3& c : one.frame.colour)
                REQUIRE((c.r >= 0.0f && c.r <= 1.0f && c.g >= 0.0f && c.g <= 1.0f && c.b >= 0.0f && c.b <= 1.0f));
            for (const int threads : {2, 7}) {
                const Picture other = rendered<Real>(scene, options, threads);
                CHECK(image_hash(other.frame) == image_hash(one.frame));
                CHECK(other.frame.distance == one.frame.distance);
                CHECK(other.frame.primitive == one.frame.primitive);
                CHECK(other.counts.primary == static_cast<std::uint64_t>(samples * size.x * size.y));
                CHECK(other.counts.shadow == one.counts.shadow);
                CHECK(other.counts.reflected == one.counts.reflected);
                CHECK(other.counts.transmitted == one.counts.transmitted);
            }
        }
}

TEST_CASE("a pixel is the mean of its samples, its layers those of the first")
{
    // A lamp whose right edge cuts the one pixel at 0.4 of its width: x = -0.2 at depth 1.
    test::SmallScene small;
    small.quad(lamp, {-1.2, 0, -1}, {1, 0, 0}, {0, 2, 0});
    const Scene scene = small.build();
    const auto picture = [&](int samples) {
        return rendered(scene, {.width = 1, .height = 1, .samples = samples}).frame;
    };
    CHECK(picture(1).colour[0].r == 0.0f);
    CHECK(picture(4).colour[0].r == 0.5f);
    CHECK(picture(5).colour[0].r == doctest::Approx(0.4f));  // two of the R2 places lie left of 0.4
    CHECK(picture(1).primitive[0] == no_primitive);
    CHECK(picture(4).primitive[0] != no_primitive);
    CHECK(picture(5).primitive[0] == no_primitive);
}

TEST_CASE("what all rays of a pixel cost is added up where it is asked for, and changes nothing else")
{
    const Scene scene = mixed_scene();
    RenderOptions options{.width = 40, .height = 35, .depth = 3, .samples = 2};
    const Picture plain = rendered(scene, options, 2);
    options.costs = true;
    const Picture metered = rendered(scene, options, 2);
    CHECK(image_hash(metered.frame) == image_hash(plain.frame));
    // The reference strategy books a cell for each search.
    const auto& cells = metered.frame.cells;
    REQUIRE(cells.size() == 40 * 35);
    CHECK(std::accumulate(cells.begin(), cells.end(), std::uint64_t{0}) == metered.counts.total());
    CHECK(*std::min_element(cells.begin(), cells.end()) == 2);  // a pixel of background: one ray a sample
    CHECK(*std::max_element(cells.begin(), cells.end()) > 10);
    const auto& tests = metered.frame.tests;
    CHECK(*std::min_element(tests.begin(), tests.end()) == 2 * scene.primitive_count());
    CHECK(metered.frame.nanoseconds.size() == 40 * 35);
}

TEST_CASE("options that make no picture are refused")
{
    const Scene scene = test::SmallScene().build();
    CHECK_THROWS_AS(rendered(scene, {.width = 0}), std::invalid_argument);
    CHECK_THROWS_AS(rendered(scene, {.height = -1}), std::invalid_argument);
    CHECK_THROWS_AS(rendered(scene, {.depth = -1}), std::invalid_argument);
    CHECK_THROWS_AS(rendered(scene, {.samples = 0}), std::invalid_argument);
    Scene textured = scene;
    textured.textures.push_back("missing.ppm");
    CHECK_THROWS_AS(rendered(textured, one_pixel), std::invalid_argument);
}
