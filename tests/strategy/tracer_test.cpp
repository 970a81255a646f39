#include "engine/strategy/tracer.h"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <thread>
#include <utility>

#include "bench/strategies.h"
#include "engine/core/errors.h"
#include "engine/scene/meshes.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// Soups of triangles in three groups and the scenery; group 1 is live, 2 is shared and copied.
class Soups {
public:
    explicit Soups(std::uint64_t seed) : random_(seed)
    {
        for (int i = 0; i < 5; ++i) memory_.push_back(soup(i == 0 ? 300 : 60));
        for (std::uint32_t i = 0; i < 300; ++i) indices_.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        const auto some = std::span(indices_).first(60);
        for (const char* name : {"live", "mixed", "copied"}) meshes_.add_group(name);
        meshes_.add({.positions = memory_[0], .indices = indices_});
        meshes_.add({.positions = memory_[1], .indices = some, .vertices = Vertices::live}, 1);
        meshes_.add({.positions = memory_[2], .indices = some, .vertices = Vertices::shared}, 2);
        meshes_.add({.positions = memory_[3], .indices = some}, 2);
        meshes_.add({.positions = memory_[4], .indices = some}, 3);
    }

    Scene scene() const { return meshes_.scene(); }

    /// Puts groups somewhere, the last one far away now and then, and bends the live one.
    std::vector<Transform> next_frame()
    {
        for (glm::vec3& point : memory_[1]) point += glm::vec3(random_.in_cube(0.5));
        std::vector<Transform> places;
        for (int i = 0; i < 3; ++i)
            places.push_back({rotation_about(glm::normalize(random_.in_cube(1.0) + glm::dvec3(0, 0, 2)), i + 1.0),
                              random_.in_cube(i == 2 ? 60.0 : 8.0)});
        return places;
    }

    std::vector<Tracer::Ray> rays(std::size_t count, bool common_apex)
    {
        std::vector<Tracer::Ray> rays(count);
        const glm::vec3 apex(random_.in_cube(30.0));
        for (Tracer::Ray& ray : rays) {
            ray.origin = common_apex ? apex : glm::vec3(random_.in_cube(30.0));
            ray.direction = glm::vec3(random_.in_cube(8.0)) - ray.origin;
        }
        return rays;
    }

private:
    std::vector<glm::vec3> soup(int triangles)
    {
        std::vector<glm::vec3> points;
        for (int i = 0; i < triangles; ++i) {
            const glm::vec3 centre(random_.in_cube(6.0));
            for (int k = 0; k < 3; ++k) points.push_back(centre + glm::vec3(random_.in_cube(1.0)));
        }
        return points;
    }

    Random random_;
    std::vector<std::vector<glm::vec3>> memory_;
    std::vector<glm::uvec3> indices_;
    Meshes meshes_;
};

std::vector<Tracer::Hit> closest(const Tracer& tracer, std::span<const Tracer::Ray> rays)
{
    std::vector<Tracer::Hit> hits(rays.size());
    tracer.closest(rays, hits);
    return hits;
}

bool same(const Tracer::Hit& a, const Tracer::Hit& b)
{
    return a.t == b.t && a.u == b.u && a.v == b.v && a.group == b.group && a.mesh == b.mesh &&
           a.triangle == b.triangle && a.primitive == b.primitive;
}

int count_differences(const std::vector<Tracer::Hit>& a, const std::vector<Tracer::Hit>& b)
{
    int different = a.size() != b.size();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) different += !same(a[i], b[i]);
    return different;
}

/// One triangle at z = 0 that moves, hit at t = 5 from (0, 0, 5) along -z while it stands at the origin.
class OneTriangle {
public:
    OneTriangle()
    {
        meshes_.add({.positions = points, .indices = indices_, .vertices = Vertices::live}, meshes_.add_group("kite"));
        scene = meshes_.scene();
    }
    OneTriangle(const OneTriangle&) = delete;

    std::vector<glm::vec3> points{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    std::vector<Tracer::Ray> ray = std::vector<Tracer::Ray>(1, {.origin = {0, 0, 5}, .direction = {0, 0, -1}});
    std::vector<Transform> still = std::vector<Transform>(1);
    std::vector<Tracer::Hit> hit = std::vector<Tracer::Hit>(1);
    Scene scene;

private:
    std::vector<glm::uvec3> indices_{{0, 1, 2}};
    Meshes meshes_;
};

/// Hits nothing and calls back from inside.
class Calling : public Strategy<float> {
public:
    std::function<void()> at_update = [] {}, at_closest = [] {};

    void update(const Pose&) override { at_update(); }
    void closest(RayTile<float>& rays) const override
    {
        at_closest();
        rays.primitive.fill(no_primitive);
    }
    void occluded(RayTile<float>& rays) const override { closest(rays); }
    StructureReport report() const override { return {}; }
};

/// What a call throws as a fault of use; empty where it throws nothing.
std::string fault_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.fault() == Fault::usage);
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("every strategy finds the same hits on meshes that move and deform, bit for bit")
{
    int hits = 0, on_live = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Soups soups(seed);
        const Scene scene = soups.scene();
        Tracer truth(scene, make_strategy("list", scene));
        std::vector<std::pair<std::string_view, std::unique_ptr<Tracer>>> tracers;
        for (const StrategyEntry& entry : strategies())
            if (!entry.peer)
                tracers.emplace_back(entry.name, std::make_unique<Tracer>(scene, make_strategy(entry.name, scene)));
        for (int frame = 0; frame < 4; ++frame) {
            const std::vector<Transform> places = soups.next_frame();
            const std::vector<Tracer::Ray> rays = soups.rays(1500, frame % 2 == 0);
            truth.update(places);
            const std::vector<Tracer::Hit> expected = closest(truth, rays);
            for (const Tracer::Hit& hit : expected) {
                hits += static_cast<bool>(hit);
                on_live += hit.mesh == 1;
            }
            for (const auto& named : tracers) {
                const auto& tracer = named.second;
                CAPTURE(named.first);
                CAPTURE(frame);
                tracer->update(places);
                CHECK(count_differences(closest(*tracer, rays), expected) == 0);
                std::vector<std::uint8_t> meets(rays.size());
                tracer->occluded(rays, meets);
                for (std::size_t i = 0; i < rays.size(); ++i) CHECK((meets[i] != 0) == static_cast<bool>(expected[i]));
            }
        }
    }
    MESSAGE(hits << " hits, " << on_live << " of them on live meshes");
    CHECK(on_live > 500);
}

TEST_CASE("batches of any size, on one thread and on four, find what rays find alone")
{
    Soups soups(9);
    const Scene scene = soups.scene();
    const Executor executor(4);
    Tracer alone(scene, make_strategy("grid", scene)), four(scene, make_strategy("lazy", scene), &executor);
    const std::vector<Transform> places = soups.next_frame();
    alone.update(places);
    four.update(places);
    for (const std::size_t count : {0u, 1u, 2u, 1023u, 1024u, 1025u, 5000u})
        for (const bool common_apex : {false, true}) {
            const std::vector<Tracer::Ray> rays = soups.rays(count, common_apex);
            std::vector<Tracer::Hit> one_by_one;
            for (const Tracer::Ray& ray : rays) one_by_one.push_back(closest(alone, {&ray, 1})[0]);
            CAPTURE(count);
            CHECK(count_differences(closest(four, rays), one_by_one) == 0);
        }
}

TEST_CASE("a hit tells where it is, and what is hidden or flattened is not hit")
{
    OneTriangle world;
    for (const StrategyEntry& entry : strategies()) {
        CAPTURE(entry.name);
        Tracer tracer(world.scene, make_strategy(entry.name, world.scene));
        tracer.update(world.still);
        const Tracer::Hit hit = closest(tracer, world.ray)[0];
        REQUIRE(hit);
        CHECK(hit.t == doctest::Approx(5.0));
        CHECK(hit.u == doctest::Approx(0.25));
        CHECK(hit.v == doctest::Approx(0.5));
        CHECK(hit.group == 1);
        CHECK(hit.mesh == 0);
        CHECK(hit.triangle == 0);

        const std::uint8_t hidden[] = {0};
        tracer.update(world.still, hidden);
        CHECK(!closest(tracer, world.ray)[0]);
        tracer.update(std::vector<Transform>{{glm::dmat3(0.0), glm::dvec3(0.0)}});
        CHECK(!closest(tracer, world.ray)[0]);
        tracer.update(std::vector<Transform>{{.offset = {0, 0, 2}}});
        CHECK(closest(tracer, world.ray)[0].t == doctest::Approx(3.0));
    }
}

TEST_CASE("live vertices count from the next update on")
{
    for (const StrategyEntry& entry : strategies()) {
        CAPTURE(entry.name);
        OneTriangle world;
        Tracer tracer(world.scene, make_strategy(entry.name, world.scene));
        for (const float z : {0.0f, 1.0f, -300.0f}) {
            for (glm::vec3& point : world.points) point.z = z;
            tracer.update(world.still);
            CHECK(closest(tracer, world.ray)[0].t == doctest::Approx(5.0f - z));
        }
    }
}

TEST_CASE("doubles are traced in doubles")
{
    OneTriangle world;
    DoubleTracer tracer(world.scene, make_strategy<double>("obb", world.scene));
    tracer.update(world.still);
    const std::vector<DoubleTracer::Ray> ray = {{.origin = {0, 0, 1e9 + 1e-6}, .direction = {0, 0, -1}}};
    std::vector<DoubleTracer::Hit> hit(1);
    tracer.closest(ray, hit);
    CHECK(hit[0].t == 1e9 + 1e-6);
}

TEST_CASE("a mask keeps rays from meshes that let light through, or from those that do not")
{
    OneTriangle world;
    world.scene.materials[0].transmittance = 0.5f;
    Tracer tracer(world.scene, make_strategy("grid", world.scene));
    tracer.update(world.still);
    std::uint8_t answer[1];
    for (const auto& [mask, met] : {std::pair(RayMask::all, 1), {RayMask::opaque, 0}, {RayMask::transmitting, 1}}) {
        tracer.occluded(world.ray, answer, mask);
        CHECK(answer[0] == met);
    }
}

TEST_CASE("what is wrong with an update is named, and the frame before it stays")
{
    OneTriangle world;
    Tracer tracer(world.scene, make_strategy("lazy", world.scene));
    tracer.update(world.still);
    CHECK(fault_of([&] { tracer.update(std::vector<Transform>(2)); }) ==
          "update: 2 transforms, expected 1, one per group");
    CHECK(fault_of([&] { tracer.update(world.still, std::vector<std::uint8_t>(3)); }) ==
          "update: visibility of 3 groups, expected 1 or none");
    std::vector<Transform> broken = world.still;
    broken[0].linear[1][2] = std::numeric_limits<double>::quiet_NaN();
    CHECK(fault_of([&] { tracer.update(broken); }) ==
          "update: the transform of group 1 (kite) is not finite, expected numbers");
    world.points[2].x = std::numeric_limits<float>::infinity();
    CHECK(fault_of([&] { tracer.update(world.still); }) ==
          "update: mesh 0: triangle 0 has a vertex that is not finite, expected numbers");
    world.points[2].x = 0.0f;
    const Scene other = world.scene;
    CHECK(fault_of([&] { tracer.update(pose(other, 0.0)); }) == "update: a pose of another scene");
    CHECK(closest(tracer, world.ray)[0].t == doctest::Approx(5.0));
}

TEST_CASE("rays are refused before the first update, after a failed one, and without room for the answers")
{
    OneTriangle world;
    auto strategy = std::make_unique<Calling>();
    Calling& calling = *strategy;
    Tracer tracer(world.scene, std::move(strategy));
    const std::string too_early = "rays are traced before an update has succeeded, expected an update first";
    CHECK(fault_of([&] { tracer.closest(world.ray, world.hit); }) == too_early);
    tracer.update(world.still);
    CHECK(fault_of([&] { tracer.closest(world.ray, world.hit); }) == "");
    CHECK(fault_of([&] { tracer.closest(world.ray, {}); }) == "room for 0 answers, expected 1, one per ray");
    calling.at_update = [] { throw std::bad_alloc(); };
    CHECK_THROWS_AS(tracer.update(world.still), std::bad_alloc);
    CHECK(fault_of([&] { tracer.closest(world.ray, world.hit); }) == too_early);
    calling.at_update = [] {};
    tracer.update(world.still);
    CHECK(fault_of([&] { tracer.closest(world.ray, world.hit); }) == "");
}

TEST_CASE("an update while rays are traced is refused, as are rays and updates during an update")
{
    OneTriangle world;
    auto strategy = std::make_unique<Calling>();
    Calling& calling = *strategy;
    Tracer tracer(world.scene, std::move(strategy));
    tracer.update(world.still);
    const auto update = [&] { tracer.update(world.still); };
    const auto trace = [&] { tracer.closest(world.ray, world.hit); };
    std::string fault;
    calling.at_closest = [&] { std::thread([&] { fault = fault_of(update); }).join(); };
    trace();
    CHECK(fault == "update: rays are being traced, expected before or after");
    calling.at_closest = [] {};
    calling.at_update = [&] { std::thread([&] { fault = fault_of(trace); }).join(); };
    update();
    CHECK(fault == "rays are traced during an update, expected before or after");
    bool is_first = true;
    calling.at_update = [&] {
        if (std::exchange(is_first, false)) fault = fault_of(update);
    };
    update();
    CHECK(fault == "update: another update is running");
    CHECK(fault_of(update) == "");
    CHECK(fault_of(trace) == "");
}

TEST_CASE("strategies are made by name, and what is no name or precision is told")
{
    const OneTriangle world;
    CHECK(fault_of([&] { make_strategy("octree", world.scene); })
              .starts_with("no strategy 'octree', expected one of "
                           "list, grid, obb, lazy, adaptive"));
    CHECK(fault_of([&] { make_strategy("grid", world.scene, {.precision = Precision::double_}); }) ==
          "Precision::double_ is for make_strategy<double>");
    CHECK_THROWS_AS(make_strategy("obb", world.scene, {.own = {{"obb-top", "tree"}}}), std::invalid_argument);
}
