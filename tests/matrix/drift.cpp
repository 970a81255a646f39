// T8: what is shown at a time does not depend on what was shown before.
#include <fmt/format.h>

#include <cstring>

#include "engine/aff/reader.h"
#include "tests/matrix/shoot.h"
#include "tests/support/moving_scenes.h"

namespace firstray::matrix {
namespace {

bool same_bits(const Pose& a, const Pose& b)
{
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    return same(a.root_from_node, b.root_from_node) && same(a.visible, b.visible) && same(a.lights, b.lights) &&
           a.camera.eye == b.camera.eye && a.camera.forward == b.camera.forward && a.camera.up == b.camera.up;
}

/// How far a rotation is from orthonormal: the largest entry of R^T R - I.
double skew(const glm::dmat3& r)
{
    const glm::dmat3 product = glm::transpose(r) * r;
    double largest = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
    return largest;
}

/// Rays and what they find now.
template <typename Real>
std::unique_ptr<RayTile<Real>> hits_of(const Strategy<Real>& strategy, const std::vector<test::TestRay>& rays)
{
    auto tile = test::make_tile<Real>(rays, 0);
    strategy.closest(*tile);
    return tile;
}

/// Strategies that have been through all frames, and back, against ones that begin at the frame.
template <typename Real>
std::uint64_t differing(const Scene& scene, const StrategyOptions& options, std::uint64_t frames, std::uint64_t& rays)
{
    Pose poses[2] = {pose(scene, scene.start), pose(scene, scene.start)};
    auto played = contenders<Real>(scene, poses[0], options, false);
    std::uint64_t different = 0, step = 0;
    const auto time_of = [&](std::uint64_t frame) {
        return scene.start + (scene.end - scene.start) * static_cast<double>(frame) / static_cast<double>(frames - 1);
    };
    const auto show = [&](std::uint64_t frame) {
        Pose& now = poses[++step % 2];
        now = pose(scene, time_of(frame));
        for (Contender<Real>& contender : played) contender.strategy->update(now);
        if (step % (frames / 8) != 0) return;
        const auto sample = test::awkward_rays(step, test::targets_of(now), 1024);
        const auto fresh = contenders<Real>(scene, now, options, false);
        for (std::size_t i = 0; i < played.size(); ++i) {
            const auto a = hits_of(*played[i].strategy, sample), b = hits_of(*fresh[i].strategy, sample);
            rays += sample.size();
            for (std::size_t lane = 0; lane < sample.size(); ++lane) different += !same_answer(*a, *b, lane);
        }
    };
    for (std::uint64_t frame = 0; frame < frames; ++frame) show(frame);
    for (std::uint64_t frame = frames; frame-- > 0;) show(frame);
    return different;
}

}  // namespace

void drift_rows(Matrix& matrix)
{
    const Scene scene = test::moving_scene(3, {.scenery = 20,
                                               .clusters = 3,
                                               .triangles = 8,
                                               .has_deforming = false,
                                               .motions = {test::Motion::rigid, test::Motion::mirrors}});
    const std::uint64_t frames = matrix.part_of(100'000, 2000);
    double most_skew = 0.0;
    std::uint64_t other_poses = 0;
    std::vector<Pose> forward;
    const auto time_of = [&](std::uint64_t i) {
        return scene.start + (scene.end - scene.start) * static_cast<double>(i) / static_cast<double>(frames - 1);
    };
    for (std::uint64_t i = 0; i < frames; ++i) {
        const Pose now = pose(scene, time_of(i));
        for (const Animation& animation : scene.animations)
            if (!animation.rotation.empty()) most_skew = std::max(most_skew, skew(animation.rotation.at(now.time)));
        if (i % 97 == 0) forward.push_back(now);
    }
    for (std::uint64_t i = forward.size(); i-- > 0;)
        other_poses += !same_bits(forward[i], pose(scene, time_of(i * 97)));
    matrix.add(
        {.id = "T8",
         .tried = "poses played forward, then sought backward: other bits; largest entry of R^T R - I of rotations",
         .n = frames,
         .result = fmt::format("{}, {:.1e}", other_poses, most_skew),
         .target = "0, <= 1e-6",
         .met = other_poses == 0 && most_skew <= 1e-6,
         .known_miss = {}});
    std::uint64_t rays = 0, different = 0;
    different += differing<float>(scene, {}, frames / 2, rays);
    different +=
        differing<double>(scene, {.precision = Precision::double_}, std::max<std::uint64_t>(frames / 20, 800), rays);
    matrix.add(
        {.id = "T8",
         .tried = fmt::format("after {} frames forward and backward, hits against those of a strategy made at that "
                              "frame, each strategy of ours, robust and double",
                              frames),
         .n = rays,
         .result = fmt::format("{} differ", different),
         .target = "0",
         .met = different == 0,
         .known_miss = {}});
}

}  // namespace firstray::matrix
