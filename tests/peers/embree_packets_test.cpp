#ifdef FIRSTRAY_HAVE_EMBREE
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "bench/peers/embree.h"
#include "bench/strategies.h"
#include "engine/core/simd.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;

namespace {

using Tile = RayTile<float>;
using PeerStrategy = std::unique_ptr<Strategy<float>>;

const std::string_view peer_names[] = {"embree", "embree-low", "embree-refit", "embree-two-level"};

PeerStrategy make_peer(std::string_view name, const Scene& scene, const std::string& rays)
{
    const StrategyEntry* entry = find_strategy(name);
    REQUIRE(entry);
    return entry->make(scene, {.own = {{"embree-rays", rays}}});
}

/// Rays from one place in all directions, or in a narrow cone; some with intervals, some that meet nothing.
std::unique_ptr<Tile> rays_from_a_place(Random& random, RayMask mask)
{
    auto tile = std::make_unique<Tile>();
    const bool narrow = random.unit() < 0.5;
    const glm::dvec3 towards = random.in_cube(1.0);
    tile->count = Tile::capacity - static_cast<int>(random.below(20));
    tile->common_apex = true;
    tile->mask = mask;
    tile->apex = glm::vec3(random.in_cube(9.0));
    for (int i = 0; i < tile->count; ++i) {
        tile->set_direction(i, glm::vec3(narrow ? towards + random.in_cube(0.1) : random.in_cube(1.0)));
        tile->set_interval(i, 0.0f);
        if (i % 4 == 1) tile->set_interval(i, 0.0f, static_cast<float>(random.between(0.0, 9.0)));
        if (i % 4 == 2) tile->set_interval(i, static_cast<float>(random.between(-1.0, 4.0)));
        if (i % 61 == 5) tile->set_direction(i, glm::vec3(0.0f));
        if (i % 61 == 6) tile->set_direction(i, {std::numeric_limits<float>::quiet_NaN(), 1.0f, 0.0f});
        if (i % 61 == 7) tile->set_interval(i, 2.0f, 2.0f);
    }
    return tile;
}

/// What two strategies do not agree about, t up to 1e-5 of it.
struct Differences {
    int rays = 0, hits = 0, closest = 0, occluded = 0;
};

void compare(const Strategy<float>& a, const Strategy<float>& b, const Tile& asked, Differences& found)
{
    const auto by_a = std::make_unique<Tile>(asked), by_b = std::make_unique<Tile>(asked),
               any_a = std::make_unique<Tile>(asked), any_b = std::make_unique<Tile>(asked);
    a.closest(*by_a);
    b.closest(*by_b);
    a.occluded(*any_a);
    b.occluded(*any_b);
    found.rays += asked.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(asked.count); ++i) {
        const bool hit = by_a->primitive[i] != no_primitive;
        const float t = by_a->t_max[i];
        found.hits += hit;
        found.closest +=
            hit != (by_b->primitive[i] != no_primitive) || (hit && std::abs(by_b->t_max[i] - t) > 1e-5f * t);
        found.occluded += (any_a->primitive[i] != no_primitive) != (any_b->primitive[i] != no_primitive);
    }
}

Scene scene_with_quadrics(std::uint64_t seed)
{
    if (seed % 2 == 0) return random_scene(seed, 600);
    return moving_scene(seed, {.motions = {Motion::rigid, Motion::grows, Motion::blinks, Motion::mirrors}});
}

}  // namespace

TEST_CASE("Embree's packets find what its single rays find, in scenes with quadrics, masks and intervals")
{
    for (const std::string_view name : peer_names) {
        Differences found;
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            const Scene scene = scene_with_quadrics(seed);
            const Pose now = pose(scene, 3.3);
            const PeerStrategy packets = make_peer(name, scene, "packets"), single = make_peer(name, scene, "single");
            packets->update(now);
            single->update(now);
            Random random(seed);
            for (int tile = 0; tile < 4; ++tile)
                for (const RayMask mask : {RayMask::all, RayMask::opaque, RayMask::transmitting})
                    compare(*single, *packets, *rays_from_a_place(random, mask), found);
        }
        CAPTURE(name);
        CAPTURE(found.rays);
        CHECK(found.hits > 7500);
        CHECK(found.closest == 0);
        CHECK(found.occluded == 0);
    }
}

TEST_CASE("a refitted tree finds what a tree built anew finds, all through an animation and back")
{
    Differences found;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Scene scene = moving_scene(seed, {.motions = {Motion::rigid, Motion::grows, Motion::blinks}});
        const PeerStrategy refit = make_peer("embree-refit", scene, "packets"),
                           medium = make_peer("embree", scene, "packets");
        Random random(seed);
        for (const double time : {0.0, 1.0, 2.5, 3.0, 4.5, 6.5, 8.0, 1.0, 0.0}) {
            const Pose now = pose(scene, time);
            refit->update(now);
            medium->update(now);
            CHECK(refit->report().primitives == medium->report().primitives);
            compare(*medium, *refit, *rays_from_a_place(random, RayMask::all), found);
        }
    }
    CAPTURE(found.rays);
    CHECK(found.hits > 3000);
    CHECK(found.closest == 0);
    CHECK(found.occluded == 0);
}

TEST_CASE("Embree keeps to the instruction set that ours is held to, and finds the same hits with each")
{
    const Scene scene = scene_with_quadrics(1);
    const Pose now = pose(scene, 3.3);
    for (const std::string_view name : peer_names) {
        const PeerStrategy expected = make_peer(name, scene, "single");
        expected->update(now);
        for (const std::string& set : instruction_sets()) {
            CAPTURE(name);
            CAPTURE(set);
            use_instruction_set(set);
            CHECK(peers::embree_packet_width() <= (set == "AVX3" ? 16 : set == "AVX2" ? 8 : 4));
            const PeerStrategy strategy = make_peer(name, scene, "packets");
            strategy->update(now);
            Random random(7);
            Differences found;
            for (int tile = 0; tile < 8; ++tile)
                compare(*expected, *strategy, *rays_from_a_place(random, RayMask::all), found);
            CHECK(found.hits > 500);
            CHECK(found.closest == 0);
            CHECK(found.occluded == 0);
        }
        use_instruction_set("");
    }
}
#endif
