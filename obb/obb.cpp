#include "obb/obb.h"

#include <algorithm>
#include <cmath>

#include "engine/grid/build.h"
#include "engine/strategy/group_bounds.h"
#include "obb/obb_strategy.h"

namespace firstray::inline v0::obb {
namespace {

/// Where a node stands at the animation's start; where it would have no size then, at its own origin.
Transform usable(const Pose& start, std::uint32_t node)
{
    const Transform& t = start.root_from_node[node];
    return is_singular(t) ? Transform{} : t;
}

}  // namespace

template <typename Real>
void ObbStrategy<Real>::build()
{
    // What is kept is made for the start of the animation, whichever frame comes first, and for wherever things go.
    const Pose start = pose(scene_, scene_.start);
    const Aabb movers = room_of_movers(scene_, group_bounds(scene_));
    largest_ = std::max(largest_coordinate(bounds(start)), static_cast<double>(largest_coordinate(movers)));
    const auto make = [&](std::size_t number) {
        const auto index = static_cast<std::uint32_t>(number);
        if (!group_of(index).deforming) make_first(index, usable(start, group_of(index).node));
    };
    if (options_.executor)
        options_.executor->for_each(boxes_.size(), make);
    else
        for (std::size_t i = 0; i < boxes_.size(); ++i) make(i);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        peak_bytes_ += boxes_[i].bytes();
        if (first_[i].is_kept) regridded_ += hierarchy_.boxes[i].count();
    }

    for (const Cluster& cluster : hierarchy_.clusters) {
        const Transform root_from_cluster = usable(start, cluster.node);
        std::vector<BoxPlace> places;
        for (std::uint32_t i = cluster.first_box; i < cluster.first_box + cluster.boxes; ++i) {
            const Transform root_from_node = usable(start, group_of(i).node);
            if (first_[i].is_kept) places.push_back(place_box(boxes_[i], root_from_node, inverse(root_from_node)));
        }
        axes_.push_back(choose_axes(places, inverse(root_from_cluster).linear));
    }
    axes_.resize(std::max<std::size_t>(axes_.size(), 1));
    build_scenery(movers);
}

template <typename Real>
void ObbStrategy<Real>::build_scenery(const Aabb& movers)
{
    has_scenery_ = scene_.groups[0].primitives() > 0;
    if (!has_scenery_) return;
    std::uint64_t built_bytes = 0;
    GridOptions shape = maker_.grid;
    shape.order = PackOrder::by_surface;
    scenery_.structure =
        build_grid(scenery_entries(geometry_, movers, options_.executor), shape, options_.executor, built_bytes);
    regridded_ += scene_.groups[0].primitives();
    peak_bytes_ += built_bytes;
}

template <typename Real>
void ObbStrategy<Real>::make_first(std::uint32_t number, const Transform& root_from_node)
{
    First& first = first_[number];
    first.reach = maker_.reach_of(hierarchy_.boxes[number]);
    first.is_kept = can_be_kept(number, root_from_node);
    if (!first.is_kept) return;
    std::uint64_t built_bytes = 0;
    boxes_[number] = maker_.make(hierarchy_.boxes[number], root_from_node, largest_, built_bytes);
    first.system = boxes_[number];
    first.blur = boxes_[number].blur;
}

/// Whether all of a box is in range, in its node's lengths too: what is not there, corners so far out that they are
/// left alone, does not shape it, and where it stands is known as well as where its vertices do.
template <typename Real>
bool ObbStrategy<Real>::can_be_kept(std::uint32_t number, const Transform& root_from_node) const
{
    const glm::dvec3 offset = glm::abs(root_from_node.offset);
    return first_[number].reach * size_of(root_from_node.linear) + std::max({offset.x, offset.y, offset.z}) <=
           farthest_place;
}

/// largest  coordinate of the box in the root system
template <typename Real>
void ObbStrategy<Real>::make_fit(std::uint32_t number, const Fit& fit, const Transform& root_from_node, double largest)
{
    const BoxPlan& plan = hierarchy_.boxes[number];
    std::uint64_t built_bytes = 0;
    if (fit.is_distorted) {
        boxes_[number] = maker_.make(plan, root_from_node, std::max(largest, largest_), built_bytes);
    } else {
        const First& first = first_[number];
        const Transform larger{glm::dmat3(std::ldexp(1.0, fit.scale)), glm::dvec3(0.0)};
        boxes_[number] = maker_.make_in(plan, larger * first.system.local_from_node,
                                        std::ldexp(std::max(first.blur, 1e-37f), 2 * fit.blur), built_bytes);
    }
    fits_[number] = fit;
    regridded_ += plan.count();
}

template <typename Real>
void ObbStrategy<Real>::move_rigid(std::uint32_t number, const Transform& root_from_node)
{
    const Transform node_from_root = inverse(root_from_node);
    BoxPlace& place = places_[number];
    place = place_box(first_[number].system, root_from_node, node_from_root);
    if (!place.is_there) return;
    const Fit fit = fit_of(place, first_[number].blur);
    if (fit.is_distorted || fit != fits_[number]) make_fit(number, fit, root_from_node, place.largest);
    place = place_box(boxes_[number], root_from_node, node_from_root);
}

template <typename Real>
void ObbStrategy<Real>::move_box(std::uint32_t number, const Pose& pose)
{
    const BoxPlan& plan = hierarchy_.boxes[number];
    const Group& group = scene_.groups[plan.group];
    BoxPlace& place = places_[number];
    place.is_there = pose.is_visible(group);
    if (!place.is_there) return;
    const Transform& root_from_node = pose.root_from_node[group.node];
    const bool is_kept = first_[number].is_kept && can_be_kept(number, root_from_node);
    if (is_kept)
        move_rigid(number, root_from_node);
    else
        regrid(number, root_from_node);
    const bool in_root = own_.hits == Hits::root || !is_kept;
    placed_[number] = {&boxes_[number], &plan, nullptr, in_root, plan.group, place.loose, place.local_from_root};
}

template <typename Real>
void ObbStrategy<Real>::regrid(std::uint32_t number, const Transform& root_from_node)
{
    const BoxPlan& plan = hierarchy_.boxes[number];
    geometry_.touch(plan.group, options_.executor);
    std::uint64_t built_bytes = 0;
    boxes_[number] = maker_.make_in_root(plan, geometry_, root_from_node, options_.executor, built_bytes);
    fits_[number] = {.is_distorted = true};  // what was kept is gone
    regridded_ += plan.count();
    places_[number] = place_in_root(boxes_[number]);
}

/// The item of a cluster: its one box, or a supergrid over its boxes, made anew.
template <typename Real>
Item ObbStrategy<Real>::make_item_of(std::uint32_t index, const Pose& pose, double wide)
{
    const Cluster& cluster = hierarchy_.clusters[index];
    std::vector<Item> items;
    for (std::uint32_t i = cluster.first_box; i < cluster.first_box + cluster.boxes; ++i) {
        const BoxPlace& place = places_[i];
        if (place.is_there)
            items.push_back(make_item(i, place.local_from_root, place.root_from_local, place.bounds, wide));
    }
    if (items.size() == 1) return items[0];
    supergrids_[index] = grid_of_items(items, false);
    const auto number = static_cast<std::uint32_t>(boxes_.size()) + index;
    placed_[number].supergrid = &supergrids_[index];
    ClusterBox& box = cluster_boxes_[index];
    box = fit_cluster(pose.root_from_node[cluster.node].linear * axes_[index], places_of(cluster));
    Item item =
        make_item(number, {glm::transpose(box.axes), glm::dvec3(0.0)}, {box.axes, glm::dvec3(0.0)}, box.bounds, wide);
    item.bounds = {};  // those of the boxes reach less far than those of the box around them
    for (const Item& inner : items) item.bounds.grow(inner.bounds);
    return item;
}

template <typename Real>
void ObbStrategy<Real>::place_clusters(const Pose& pose)
{
    double largest = static_cast<double>(scenery_.structure.largest);
    for (const BoxPlace& place : places_)
        if (place.is_there) largest = std::max(largest, place.largest);
    const double wide = box_pad(largest);
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < hierarchy_.clusters.size(); ++i) {
        supergrids_[i] = {};
        const auto places = places_of(hierarchy_.clusters[i]);
        if (std::none_of(places.begin(), places.end(), [](const BoxPlace& place) { return place.is_there; })) continue;
        items.push_back(make_item_of(i, pose, wide));
    }
    const bool is_among = own_.top == Top::grid && has_scenery_;
    outer_ = place_items(is_among ? &scenery_ : nullptr, items, own_.top == Top::list);
}

template <typename Real>
std::unique_ptr<Strategy<Real>> make_obb(const Scene& scene, const StrategyOptions& options, const Options& boxes)
{
    return std::make_unique<ObbStrategy<Real>>(scene, options, boxes);
}

template std::unique_ptr<Strategy<float>> make_obb(const Scene&, const StrategyOptions&, const Options&);
template std::unique_ptr<Strategy<double>> make_obb(const Scene&, const StrategyOptions&, const Options&);

}  // namespace firstray::inline v0::obb
