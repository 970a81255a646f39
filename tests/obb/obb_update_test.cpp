#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "engine/strategy/list.h"
#include "obb/obb.h"
#include "tests/support/compare_hits.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;

namespace {

using Obb = std::unique_ptr<Strategy<float>>;

std::vector<Pose> poses_of(const Scene& scene)
{
    std::vector<Pose> poses;
    for (int frame = 0; frame < scene.frames; ++frame) poses.push_back(pose(scene, scene.time_of(frame)));
    return poses;
}

std::uint64_t regridded(const Obb& strategy, const Pose& now)
{
    strategy->update(now);
    return strategy->report().regridded;
}

/// What a report says of a frame, without what it says of the way there: bytes held in reserve, most bytes, work done.
auto state_of(const StructureReport& report)
{
    return std::tuple(report.grids, report.subgrids, report.voxels, report.filled_voxels, report.references,
                      report.primitives, report.depth, report.largest_list);
}

bool same_bits(const StructureBox& a, const StructureBox& b)
{
    return a.kind == b.kind && a.name == b.name && a.level == b.level && a.dims == b.dims &&
           a.primitives == b.primitives && a.references == b.references && a.filled_cells == b.filled_cells &&
           std::memcmp(&a.root_from_box, &b.root_from_box, sizeof(Transform)) == 0;
}

/// Whether two strategies that were updated to one frame are alike.
void check_same(const Obb& anew, const Obb& old, const std::vector<TestRay>& rays, int& hits)
{
    CHECK(state_of(anew->report()) == state_of(old->report()));
    const std::vector<StructureBox> expected = anew->outline(), found = old->outline();
    REQUIRE(expected.size() == found.size());
    CHECK(std::equal(expected.begin(), expected.end(), found.begin(), same_bits));
    CHECK(differences(*anew, *old, rays, hits) == 0);
}

/// Strategies, each made anew and updated to one frame alone, that others are compared with.
class Frames {
public:
    explicit Frames(const Scene& scene) : scene_(scene), poses_(poses_of(scene))
    {
        for (const Pose& now : poses_) {
            anew_.push_back(obb::make_obb<float>(scene, {}));
            anew_.back()->update(now);
            rays_.push_back(awkward_rays(rays_.size(), targets_of(now), 200));
        }
    }
    const Pose& at(int frame) const { return poses_[static_cast<std::size_t>(frame)]; }
    void check(int frame, const Obb& strategy, int& hits) const
    {
        CAPTURE(frame);
        const auto i = static_cast<std::size_t>(frame);
        check_same(anew_[i], strategy, rays_[i], hits);
    }
    Obb make() const { return obb::make_obb<float>(scene_, {}); }

private:
    const Scene& scene_;
    std::vector<Pose> poses_;
    std::vector<Obb> anew_;
    std::vector<std::vector<TestRay>> rays_;
};

const std::string triangle = "p 3 0 0 0 1 0 0 0 1 0 ";

/// Two triangles, away from the origin, that grow by a factor from time 0 to 8, beside a still one.
Scene growing_scene(double factor)
{
    const std::string f = std::to_string(factor), end = f + ' ' + f + ' ' + f + " 0 0 0 ";
    return scene_of("a 0 8 9 " + triangle + "xs 1 1 1 0 0 1 0 9 9 9 { x a {" + triangle + triangle +
                    "} } k a { scale 4  -1 1 1 1 0 0 0  0 1 1 1 0 0 0  8 " + end + "9 " + end + "}");
}

}  // namespace

TEST_CASE("the first update grids everything, those after it nothing but what deforms")
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        CAPTURE(seed);
        const bool has_deforming = seed % 2 == 0;
        const Scene scene =
            moving_scene(seed, {.clusters = 3,
                                .has_deforming = has_deforming,
                                .motions = {Motion::rigid, Motion::still, Motion::blinks, Motion::mirrors}});
        const std::vector<Pose> poses = poses_of(scene);
        const Obb strategy = obb::make_obb<float>(scene, {});
        CHECK(regridded(strategy, poses[0]) == scene.primitive_count());
        for (const Pose& now : poses) {
            std::uint64_t deforming = 0;
            for (const Group& group : scene.groups)
                if (group.deforming && now.is_visible(group)) deforming += group.primitives();
            CHECK((deforming > 0) == has_deforming);
            CHECK(regridded(strategy, now) == deforming);
        }
    }
}

TEST_CASE("a group is gridded anew only where its scale has changed by more than 1024")
{
    const Scene little = growing_scene(500.0), much = growing_scene(1e5);
    const std::vector<Pose> few = poses_of(little), many = poses_of(much);
    const Obb a = obb::make_obb<float>(little, {}), b = obb::make_obb<float>(much, {});
    a->update(few[0]);
    b->update(many[0]);
    for (const Pose& now : few) CHECK(regridded(a, now) == 0);
    CHECK(regridded(b, many[8]) == 2);
    CHECK(regridded(b, many[7]) == 0);  // near enough to frame 8
    CHECK(regridded(b, many[0]) == 2);
    CHECK(regridded(b, many[0]) == 0);
}

TEST_CASE("a group that shrinks is gridded anew at every fourth of its size at most")
{
    const Scene scene = growing_scene(1e-3);  // 4^5
    const std::vector<Pose> poses = poses_of(scene);
    const Obb strategy = obb::make_obb<float>(scene, {});
    strategy->update(poses[0]);
    std::uint64_t all = 0;
    for (int step = 0; step <= 200; ++step) all += regridded(strategy, pose(scene, 0.04 * step));
    CHECK(all > 0);
    CHECK(all <= 2 * 5);
}

TEST_CASE("a frame is the same after any others, forward, backward and in any order")
{
    int hits = 0, frames = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        CAPTURE(seed);
        const Scene scene = moving_scene(seed, {.clusters = 4, .triangles = seed % 4 == 0 ? 80 : 12});
        const Frames expected(scene);
        const Obb forward = expected.make(), backward = expected.make(), shuffled = expected.make();
        const auto check = [&](const Obb& strategy, int frame) {
            strategy->update(expected.at(frame));
            expected.check(frame, strategy, hits);
            ++frames;
        };
        for (int i = 0; i < scene.frames; ++i) check(forward, i);
        for (int i = scene.frames - 1; i >= 0; --i) check(backward, i);
        for (int i = 0; i < scene.frames; ++i) check(shuffled, (5 * i + 3) % scene.frames);
    }
    CHECK(hits > 30000);
    MESSAGE("frames compared: " << frames << ", hits compared: " << hits);
}

TEST_CASE("after 100,000 updates nothing has drifted")
{
    const Scene scene = moving_scene(3, {.clusters = 3,
                                         .triangles = 4,
                                         .has_deforming = false,
                                         .motions = {Motion::rigid, Motion::mirrors, Motion::huge, Motion::blinks}});
    const Frames expected(scene);
    const Obb strategy = expected.make();
    Random random(1);
    for (int i = 0; i < 100000; ++i) strategy->update(expected.at(static_cast<int>(random.below(9))));
    int hits = 0;
    for (int frame = 0; frame < scene.frames; ++frame) {
        strategy->update(expected.at(frame));
        expected.check(frame, strategy, hits);
    }
    CHECK(hits > 1000);
}

TEST_CASE("a cluster that is hidden leaves nothing behind in report and outline")
{
    const Scene scene =
        scene_of("a 0 2 3 k a { visibility 2 0 1 1 0 } x a {" + triangle + " x b {" + triangle + "} }" + triangle);
    const std::vector<Pose> poses = poses_of(scene);
    const Obb strategy = obb::make_obb<float>(scene, {});
    strategy->update(poses[0]);
    CHECK(strategy->report().primitives == 3);
    CHECK(strategy->outline().size() == 4);  // scenery, supergrid, two boxes
    strategy->update(poses[2]);
    CHECK(strategy->report().primitives == 1);
    CHECK(strategy->report().grids == 1);
    REQUIRE(strategy->outline().size() == 1);
    CHECK(strategy->outline()[0].name == "scenery");
}
