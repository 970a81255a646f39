#include "bench/measure/recorded_rays.h"

#include <doctest/doctest.h>

#include <memory>

#include "engine/render/render.h"
#include "tests/support/reference_strategy.h"
#include "tests/support/small_scene.h"

using namespace firstray;

namespace {

/// A mirror, a sheet of glass and a wall, lit so that all kinds of rays fly.
Scene varied_scene()
{
    test::SmallScene small;
    small.scene.background = {0.2f, 0.3f, 0.5f};
    small.light({0, 3, 1});
    small.quad({}, {0, -1, -6}, {4, 0, 0}, {0, 1, 0});
    small.sphere({.specular = glm::vec3(0.5f)}, {0.3, 0, -4}, 0.9);
    small.quad({.transmittance = 0.5f, .ior = 1.5f}, {-1, 0, -3}, {1, 0, 0}, {0, 1, 0});
    return small.build();
}

template <typename Real>
struct Recording {
    Frame frame;
    RayCounts counts;
    RecordedRays rays;
};

template <typename Real>
Recording<Real> record(const Scene& scene, const Pose& at_start, std::size_t most_rays)
{
    test::ReferenceStrategy<Real> strategy;
    strategy.update(at_start);
    Recording<Real> result{{}, {}, RecordedRays(most_rays)};
    RayRecorder<Real> recorder(strategy);
    recorder.record_to(&result.rays);
    result.counts =
        render<Real>(recorder, at_start, {}, {.width = 96, .height = 64, .depth = 3}, Executor(1), result.frame);
    CHECK(result.frame.pixel_count() == 96 * 64);
    CHECK(scene.primitive_count() == 5);
    return result;
}

}  // namespace

TEST_CASE_TEMPLATE("a frame's rays are recorded by kind, and its picture is what it is without", Real, float, double)
{
    const Scene scene = varied_scene();
    const Pose at_start = pose(scene, scene.start);
    const Recording<Real> recording = record<Real>(scene, at_start, 1u << 24);
    const RecordedRays& rays = recording.rays;
    CHECK(rays.asked(RayKind::primary) == recording.counts.primary);
    CHECK(rays.asked(RayKind::shadow) == recording.counts.shadow);
    CHECK(rays.asked(RayKind::secondary) == recording.counts.reflected + recording.counts.transmitted);
    CHECK(recording.counts.reflected > 0);
    CHECK(recording.counts.transmitted > 0);
    CHECK(rays.kept() == recording.counts.total());

    test::ReferenceStrategy<Real> strategy;
    strategy.update(at_start);
    Frame plain;
    render<Real>(strategy, at_start, {}, {.width = 96, .height = 64, .depth = 3}, Executor(2), plain);
    CHECK(image_hash(plain) == image_hash(recording.frame));
}

TEST_CASE("rays asked again are the rays that were asked")
{
    RecordedRays rays(100);
    const auto tile = std::make_unique<RayTile<float>>(), again = std::make_unique<RayTile<float>>();
    tile->count = 5;
    tile->mask = RayMask::opaque;
    for (int i = 0; i < 5; ++i) {
        const auto x = static_cast<float>(i);
        tile->set_origin(i, {x, 1, 2});
        tile->set_direction(i, {3, x, 4});
        tile->set_interval(i, 0.5f * x, 9.0f + x);
    }
    rays.add(RayKind::shadow, RayQuery::occluded, *tile);
    tile->common_apex = true;
    tile->apex = {7, 8, 9};
    rays.add(RayKind::primary, RayQuery::closest, *tile);
    REQUIRE(rays.batches().size() == 2);
    CHECK(rays.batches()[0].query == RayQuery::occluded);
    CHECK(rays.batches()[1].kind == RayKind::primary);

    rays.load(rays.batches()[0], *again);
    CHECK(again->count == 5);
    CHECK(again->mask == RayMask::opaque);
    CHECK_FALSE(again->common_apex);
    CHECK(again->origin_of(4) == glm::vec3(4, 1, 2));
    CHECK(again->direction_of(3) == glm::vec3(3, 3, 4));
    CHECK(again->t_min[2] == 1.0f);
    CHECK(again->t_max[2] == 11.0f);
    rays.load(rays.batches()[1], *again, 1, 3);  // lanes 1 and 4
    CHECK(again->count == 2);
    CHECK(again->origin_of(1) == glm::vec3(7, 8, 9));
    CHECK(again->direction_of(1) == glm::vec3(3, 4, 4));
}

TEST_CASE("beyond what may be kept every second batch of a kind goes, and all are counted")
{
    RecordedRays rays(100);
    const auto tile = std::make_unique<RayTile<float>>();
    tile->count = 10;
    for (int batch = 0; batch < 64; ++batch) {
        for (int i = 0; i < 10; ++i) tile->set_origin(i, glm::vec3(static_cast<float>(batch)));
        rays.add(batch % 4 == 0 ? RayKind::primary : RayKind::secondary, RayQuery::closest, *tile);
    }
    CHECK(rays.asked(RayKind::primary) == 160);
    CHECK(rays.asked(RayKind::secondary) == 480);
    CHECK(rays.kept() <= 100);
    CHECK(rays.kept() > 40);
    CHECK(rays.kept(RayKind::primary) > 0);
    CHECK(rays.kept(RayKind::primary) + rays.kept(RayKind::secondary) == rays.kept());
    for (const RecordedRays::Batch& batch : rays.batches()) {
        rays.load(batch, *tile);
        const int number = static_cast<int>(tile->origin_of(0).x);
        CHECK((number % 4 == 0) == (batch.kind == RayKind::primary));
        CHECK(tile->origin_of(9) == tile->origin_of(0));
    }
}
