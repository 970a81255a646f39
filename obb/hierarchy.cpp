#include "obb/hierarchy.h"

#include <algorithm>
#include <map>

namespace firstray::inline v0::obb {
namespace {

/// The dynamic node at or above `node` that has none above it; the root where there is none.
std::uint32_t topmost_dynamic(const Scene& scene, std::uint32_t node)
{
    std::uint32_t topmost = 0;
    for (; node != 0; node = scene.nodes[node].parent)
        if (scene.nodes[node].dynamic) topmost = node;
    return topmost;
}

std::string name_of(const Scene& scene, const Group& group)
{
    if (group.node == 0) return "deforming";
    return scene.nodes[group.node].name + (group.deforming ? " (deforming)" : "");
}

/// The boxes of a group: one, or one for each transform that its parts stand in.
std::vector<BoxPlan> plan_boxes(const Scene& scene, std::uint32_t index, const std::vector<const Part*>& parts,
                                Groups groups)
{
    const Group& group = scene.groups[index];
    const bool split = groups == Groups::all && !group.deforming;
    std::map<std::uint32_t, BoxPlan> by_node;
    for (const Part* part : parts) {
        const std::uint32_t node = split ? part->node : group.node;
        BoxPlan& plan = by_node[node];
        plan.group = index;
        plan.name = name_of(scene, group);
        if (node != group.node) plan.name += "/static " + std::to_string(node);
        if (!plan.primitives.empty() && plan.primitives.back().first + plan.primitives.back().count == part->first)
            plan.primitives.back().count += part->count;
        else
            plan.primitives.push_back({part->first, part->count});
    }
    std::vector<BoxPlan> plans;
    for (auto& [node, plan] : by_node) plans.push_back(std::move(plan));
    return plans;
}

}  // namespace

Hierarchy plan_hierarchy(const Scene& scene, Groups groups)
{
    std::vector<std::vector<const Part*>> parts(scene.groups.size());
    for (const Part& part : scene.parts) parts[part.group].push_back(&part);
    std::map<std::uint32_t, std::vector<std::uint32_t>> groups_of;  // by topmost dynamic node
    for (std::uint32_t g = 1; g < scene.groups.size(); ++g)
        groups_of[topmost_dynamic(scene, scene.groups[g].node)].push_back(g);

    Hierarchy hierarchy;
    for (const auto& [node, members] : groups_of) {
        Cluster cluster{.node = node, .name = node == 0 ? "deforming" : scene.nodes[node].name};
        cluster.first_box = static_cast<std::uint32_t>(hierarchy.boxes.size());
        for (const std::uint32_t group : members)
            for (BoxPlan& plan : plan_boxes(scene, group, parts[group], groups))
                hierarchy.boxes.push_back(std::move(plan));
        cluster.boxes = static_cast<std::uint32_t>(hierarchy.boxes.size()) - cluster.first_box;
        hierarchy.clusters.push_back(std::move(cluster));
    }
    return hierarchy;
}

}  // namespace firstray::inline v0::obb
