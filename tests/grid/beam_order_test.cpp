#include "engine/grid/beam_order.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// How often each lane is in a part or by itself.
std::vector<int> uses_of(const BeamOrder& order, int first_part, int rays)
{
    std::vector<int> uses(static_cast<std::size_t>(rays));
    for (int p = first_part; p < order.count; ++p)
        for (int i = 0; i < order.parts[p].count; ++i) {
            const std::int32_t* lanes = order.lanes_of(order.parts[p]);
            const std::int32_t lane = lanes ? lanes[i] : i;
            if (lane >= 0) ++uses[static_cast<std::size_t>(lane)];
        }
    for (int i = 0; i < order.singles; ++i) ++uses[static_cast<std::size_t>(order.single[i])];
    return uses;
}

constexpr int scattered = 1000;

/// Rays all over the square of slopes, or in two corners of it; they end nearby.
void scatter(BeamPlaces& places, bool has_gap)
{
    Random random(3);
    places.wide_u = places.wide_v = 1.0f;
    places.most_columns = 2.0f;
    for (int i = 0; i < scattered; ++i) {
        const bool is_far = has_gap && i % 2 == 0;
        const double lo = is_far ? 0.8 : 0.0, wide = has_gap ? 0.2 : 1.0;
        places.u[i] = static_cast<float>(random.between(lo, lo + wide));
        places.v[i] = static_cast<float>(random.between(lo, lo + wide));
        places.depth[i] = 0.0f;
        std::uint32_t place = 0;
        for (std::uint32_t bit = 0; bit < 8; ++bit) {
            place |= (static_cast<std::uint32_t>(places.u[i] * 255.0f) >> bit & 1u) << (2 * bit);
            place |= (static_cast<std::uint32_t>(places.v[i] * 255.0f) >> bit & 1u) << (2 * bit + 1);
        }
        places.key[i] = place << 16 | static_cast<std::uint32_t>(i);
    }
}

bool all_once(const std::vector<int>& uses)
{
    return std::all_of(uses.begin(), uses.end(), [](int n) { return n == 1; });
}

}  // namespace

TEST_CASE("every ray of a tile is in one beam or goes alone, and goes along its beam")
{
    const Scene scene = random_scene(1, 50);
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        const int rays = seed % 3 == 0 ? 1024 : static_cast<int>(5 + 20 * seed);
        const auto tile = make_tile<float>(rays_from(seed, scene, {1, 2, 3}, rays), 0);
        BeamOrder order;
        order.split(*tile);
        CHECK(all_once(uses_of(order, 0, tile->count)));
        for (int p = 0; p < order.count; ++p) {
            const BeamPart& part = order.parts[p];
            CHECK(part.count >= fewest_rays);
            for (int i = part.first; i < part.first + part.count; ++i) {
                const glm::vec3 d = tile->direction_of(order.lanes[i]);
                CHECK(d[part.axes.k] * part.axes.forward > 0.0f);
                CHECK(std::abs(d[part.axes.u]) <= most_slope * std::abs(d[part.axes.k]));
            }
        }
    }
}

TEST_CASE("clusters hold every ray of the beam that they were cut from, and are cut where it has gaps")
{
    for (const bool has_gap : {false, true}) {
        CAPTURE(has_gap);
        BeamPlaces places;
        scatter(places, has_gap);
        BeamOrder order;
        order.take_all(scattered, axes_of({0, 0, -1}));
        const BeamPart whole = order.parts[0];
        order.cluster(whole, places);
        CHECK(all_once(uses_of(order, 1, scattered)));
        CHECK(order.count - 1 == (has_gap ? 2 : 1));
        CHECK(order.singles < 2 * fewest_rays);
        CHECK(std::is_sorted(places.key, places.key + scattered,
                             [](std::uint32_t a, std::uint32_t b) { return a >> 16 < b >> 16; }));
    }
}

TEST_CASE("packets of clusters are narrow where their rays end, and hold five rays or more; other rays go alone")
{
    int packets = 0, alone = 0;
    for (const float depth : {1.0f, 4.0f, 10.0f, 20.0f, 1000.0f}) {
        CAPTURE(depth);
        BeamPlaces places;
        scatter(places, true);
        for (int i = 0; i < scattered; ++i) places.depth[i] = i % 3 == 0 ? depth : 0.5f * depth;
        BeamOrder order;
        order.take_all(scattered, axes_of({0, 0, -1}));
        const BeamPart some = order.only(order.parts[0], 0xffffffff0f0full);
        std::vector<int> uses(scattered);
        for (int i = 0; i < some.count; ++i) ++uses[static_cast<std::size_t>(order.lanes_of(some)[i])];
        CHECK(some.count == 16 * 40);
        BeamPlaces chosen = places;
        for (int i = 0; i < some.count; ++i) {
            const auto ray = static_cast<std::size_t>(order.lanes_of(some)[i]);
            chosen.u[i] = places.u[ray];
            chosen.v[i] = places.v[ray];
            chosen.depth[i] = places.depth[ray];
            chosen.key[i] = (places.key[ray] & ~0xffffu) | static_cast<std::uint32_t>(i);
        }
        order.cluster(some, chosen);
        CHECK(uses_of(order, 1, scattered) == uses);
        alone += order.singles;
        for (int p = 1; p < order.count; ++p) {
            const BeamPart& part = order.parts[p];
            REQUIRE(part.count % packet_size == 0);
            for (int first = part.first; first < part.first + part.count; first += packet_size, ++packets) {
                float lo_u = 2, lo_v = 2, hi_u = 0, hi_v = 0, deepest = 0;
                int rays = 0;
                for (int i = first; i < first + packet_size; ++i) {
                    const bool fills = order.lanes[i] < 0;
                    const int lane = fills ? ~order.lanes[i] : order.lanes[i];
                    rays += !fills;
                    lo_u = std::min(lo_u, places.u[lane]);
                    hi_u = std::max(hi_u, places.u[lane]);
                    lo_v = std::min(lo_v, places.v[lane]);
                    hi_v = std::max(hi_v, places.v[lane]);
                    deepest = std::max(deepest, places.depth[lane]);
                }
                CHECK(rays >= fewest_rays);
                CHECK(((hi_u - lo_u) * deepest + 1.0f) * ((hi_v - lo_v) * deepest + 1.0f) <= places.most_columns);
            }
        }
    }
    CHECK(packets > 100);
    CHECK(alone > 100);
}

TEST_CASE("a mailbox gives every packet to a triangle once a beam")
{
    Mailbox& mailbox = Mailbox::of_this_thread();
    mailbox.begin_beam();
    CHECK(mailbox.untested(7, 0b1011) == 0b1011);
    CHECK(mailbox.untested(7, 0b1110) == 0b0100);
    CHECK(mailbox.untested(8, 0b1110) == 0b1110);
    mailbox.begin_beam();
    CHECK(mailbox.untested(7, 0b0001) == 0b0001);
}

TEST_CASE("occluders are remembered by light, and forgotten when the geometry is another")
{
    Occluders& occluders = Occluders::of_this_thread();
    const RootTriangle<float> triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1.0f};
    occluders.begin_tile({1, 2, 3}, 1);
    CHECK(!occluders.has_any());
    for (std::uint32_t id = 0; id < 6; ++id) occluders.remember(triangle, id);
    CHECK(occluders.has_any());
    CHECK(std::count(occluders.pack().id, occluders.pack().id + pack_size, no_primitive) == pack_size - 4);
    occluders.begin_tile({1, 2, 3}, 1);
    CHECK(occluders.has_any());
    occluders.begin_tile({1, 2, 3}, 2);
    CHECK(!occluders.has_any());
}
