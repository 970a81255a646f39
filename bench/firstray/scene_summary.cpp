#include "bench/firstray/scene_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/scene/pose.h"
#include "engine/strategy/group_bounds.h"

namespace firstray::command {
namespace {

constexpr int sampled_poses = 33;

/// Below so many primary rays a frame building costs more than searching lists: `bench/micro/ray_sweep`.
constexpr std::uint64_t few_rays = 10'000;

/// Share of all primitives above which what moves rigidly makes keeping grids for it worth their first frame.
constexpr double mostly = 0.5;

/// The middle of a group's box in the root system, at poses where it is visible.
class Path {
public:
    void add(const glm::dvec3& middle)
    {
        if (!first_) first_ = middle;
        reach_ = std::max(reach_, glm::length(middle - *first_));
    }
    double reach() const { return reach_; }

private:
    std::optional<glm::dvec3> first_;
    double reach_ = 0.0;
};

/// Whether any transform on the way to a node has keys.
bool is_animated(const Scene& scene, std::uint32_t node)
{
    for (; node != none && node != 0; node = scene.nodes[node].parent)
        if (scene.nodes[node].animation != none) return true;
    return false;
}

}  // namespace

SceneMotion motion_of(const Scene& scene)
{
    const std::vector<DAabb> boxes = group_bounds(scene);
    std::vector<Path> paths(scene.groups.size());
    for (int i = 0; i < sampled_poses; ++i) {
        const Pose now = pose(scene, scene.start + (scene.end - scene.start) * i / (sampled_poses - 1));
        for (std::size_t g = 1; g < scene.groups.size(); ++g) {
            const Group& group = scene.groups[g];
            if (!now.is_visible(group) || boxes[g].empty()) continue;
            paths[g].add(now.root_from_node[group.node].point((boxes[g].lo + boxes[g].hi) * 0.5));
        }
    }
    SceneMotion motion;
    for (std::size_t g = 0; g < scene.groups.size(); ++g) {
        const Group& group = scene.groups[g];
        const std::uint64_t primitives = group.primitives();
        const bool moves = is_animated(scene, group.node);
        (group.deforming ? motion.deforming : moves ? motion.rigid : motion.still) += primitives;
        if (g == 0) continue;
        const std::string& name = scene.nodes[group.node].name;
        motion.movers.push_back({name.empty() ? "deforming" : name, primitives, group.deforming, paths[g].reach()});
    }
    std::stable_sort(motion.movers.begin(), motion.movers.end(),
                     [](const GroupMotion& a, const GroupMotion& b) { return a.primitives > b.primitives; });
    return motion;
}

Recommendation recommend(const SceneMotion& motion, std::uint64_t rays)
{
    const auto percent = [&](std::uint64_t part) {
        return motion.total() == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(motion.total());
    };
    if (rays < few_rays)
        return {"adaptive",
                fmt::format("{} primary rays a frame are few: it searches lists where grids would not pay", rays)};
    if (percent(motion.rigid) >= 100.0 * mostly)
        return {"obb",
                fmt::format("{:.0f} % of the primitives move without changing shape: it keeps their grids and moves "
                            "boxes",
                            percent(motion.rigid))};
    if (motion.deforming > motion.still)
        return {"lazy",
                fmt::format("{:.0f} % of the primitives deform and are built anew: it builds only what rays enter",
                            percent(motion.deforming))};
    return {"lazy", fmt::format("{:.0f} % of the primitives stand still: it builds what rays enter, once, and keeps it",
                                percent(motion.still))};
}

}  // namespace firstray::command
