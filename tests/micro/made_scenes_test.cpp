#include "bench/micro/made_scenes.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "bench/strategies.h"
#include "engine/core/errors.h"
#include "engine/scene/pose.h"

using namespace firstray;

TEST_CASE("made scenes have about as many triangles as asked for, and deform where that is asked for")
{
    for (const MadeScene& kind : made_scenes())
        for (const std::size_t triangles : {2u, 1000u, 20000u})
            for (const bool deforms : {false, true}) {
                CAPTURE(kind.name);
                CAPTURE(triangles);
                const Scene scene = kind.make(triangles, deforms);
                CHECK(scene.triangles.size() == doctest::Approx(static_cast<double>(triangles)).epsilon(0.05));
                const Pose before = pose(scene, 0.0), after = pose(scene, 1.0);
                const auto list = find_strategy("list")->make(scene, {});
                const auto first = small_picture(before), last = small_picture(after);
                list->update(before);
                list->closest(*first);
                list->update(after);
                list->closest(*last);
                const auto hits = std::count_if(first->primitive.begin(), first->primitive.begin() + first->count,
                                                [](PrimitiveId id) { return id != no_primitive; });
                if (triangles >= 1000) CHECK(hits > 50);
                if (triangles >= 1000) CHECK((first->t_max == last->t_max) == !deforms);
            }
}

TEST_CASE("a small picture is the same as a beam and ray by ray, and may be searched again")
{
    const Scene scene = made_scenes()[0].make(1000, false);
    const Pose now = pose(scene, 0.0);
    const auto grid = find_strategy("grid")->make(scene, {});
    grid->update(now);
    const auto beam = small_picture(now, true), rays = small_picture(now, false);
    for (RayTile<float>* tile : {beam.get(), rays.get(), beam.get()}) {
        reset(*tile);
        grid->closest(*tile);
    }
    CHECK(beam->count == 256);
    CHECK(std::equal(beam->t_max.begin(), beam->t_max.begin() + 256, rays->t_max.begin()));
    CHECK_NOTHROW(check_hits(*beam, *rays, "beam"));
    const auto hit = std::find_if(rays->primitive.begin(), rays->primitive.begin() + 256,
                                  [](PrimitiveId id) { return id != no_primitive; });
    REQUIRE(hit != rays->primitive.begin() + 256);
    *hit = no_primitive;
    rays->t_max[static_cast<std::size_t>(hit - rays->primitive.begin())] *= 1.01f;
    CHECK_THROWS_WITH_AS(check_hits(*beam, *rays, "beam"), "beam gives wrong answers", Error);
}
