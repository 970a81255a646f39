#include "bench/compare/hit_check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "engine/render/render.h"
#include "tests/support/reference_strategy.h"
#include "tests/support/small_scene.h"

using namespace firstray;
using namespace firstray::compare;

TEST_CASE("answers that differ are counted by how they differ")
{
    const RayAnswer miss;
    const std::vector<RayAnswer> expected = {{2.0, 7}, {2.0, 7, RayKind::shadow},
                                             miss,     miss,
                                             {4.0, 1}, {4.0, 1},
                                             {5.0, 2}, {0.0, 0}},
                                 found = {{2.0, 7}, miss, {9.0, 3}, miss, {4.001, 1}, {4.5, 1}, {5.0, 3}, {0.0, 0}};
    HitAgreement sum = agreement(expected, found);
    CHECK(sum.rays == 8);
    CHECK(sum.hits == 6);
    CHECK(sum.missed == 1);
    CHECK(sum.invented == 1);
    CHECK(sum.moved == 1);
    CHECK(sum.unlike == 5);
    CHECK(at(sum.wrong, RayKind::primary) == 1);
    CHECK(at(sum.wrong, RayKind::shadow) == 1);
    CHECK(at(sum.wrong, RayKind::secondary) == 0);
    REQUIRE(sum.t_errors.size() == 5);
    CHECK(*std::max_element(sum.t_errors.begin(), sum.t_errors.end()) == doctest::Approx(0.125));
    CHECK(sum.per_million(sum.missed) == 125000.0);
    sum += agreement(expected, expected);
    CHECK(sum.rays == 16);
    CHECK(sum.unlike == 5);
    CHECK(HitAgreement{}.per_million(0) == 0.0);
}

TEST_CASE("a sample is every so manyth of all rays, searched alone or with their batches alike")
{
    test::SmallScene small;
    small.light({0, 3, 1});
    small.quad({}, {0, -1, -6}, {4, 0, 0}, {0, 1, 0});
    small.sphere({.specular = glm::vec3(0.5f)}, {0.3, 0, -4}, 0.9);
    const Scene scene = small.build();
    const Pose at_start = pose(scene, scene.start);
    test::ReferenceStrategy<float> strategy;
    RayRecorder<float> recorder(strategy);
    recorder.update(at_start);
    RecordedRays rays(1u << 20);
    recorder.record_to(&rays);
    Frame frame;
    render<float>(recorder, at_start, {}, {.width = 50, .height = 40, .depth = 2}, Executor(1), frame);

    const Executor executor(2);
    const std::vector<RayAnswer> all = answers<float>(strategy, rays, {1}, executor);
    REQUIRE(all.size() == rays.kept());
    for (const std::size_t step : {std::size_t{1}, std::size_t{7}, std::size_t{5000}}) {
        CAPTURE(step);
        const auto dense = answers<float>(strategy, rays, {step}, executor);
        const auto sparse = sparse_answers<float>(strategy, rays, {step}, executor);
        CHECK(dense.size() == (rays.kept() + step - 1) / step);
        CHECK(agreement(dense, sparse).unlike == 0);
        for (std::size_t i = 0; i < dense.size(); ++i) CHECK(dense[i].t == all[i * step].t);
    }
    CHECK(agreement(all, all).hits > 100);
    CHECK(agreement(all, all).hits < all.size());
}

TEST_CASE("rays that go on behind a hit are not in a sample")
{
    RecordedRays rays(100);
    const auto tile = std::make_unique<RayTile<float>>();
    tile->count = 3;
    for (const RayQuery query : {RayQuery::occluded, RayQuery::closest}) rays.add(RayKind::shadow, query, *tile);
    CHECK(Sample{1}.first_lane(rays.batches()[0]) == 0);
    CHECK(Sample{2}.first_lane(rays.batches()[0]) == 0);
    CHECK(Sample{1}.first_lane(rays.batches()[1]) == 3);
}
