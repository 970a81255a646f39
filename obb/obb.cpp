#include "obb/obb.h"

#include <algorithm>
#include <cmath>

#include "engine/grid/bin.h"
#include "engine/grid/outline.h"
#include "obb/box.h"
#include "obb/boxed_grid.h"
#include "obb/hierarchy.h"
#include "obb/placing.h"
#include "obb/search.h"

namespace firstray::obb {
namespace {

/// A cluster that would stand in more cells of the scenery's grid than this is looked for by every ray instead.
constexpr std::uint64_t most_cells = 4096;

/// Poses of the animation at which moving things are looked up, to choose the room that the scenery's grid covers.
constexpr int sampled_poses = 32;

/// That room has at most so many times the scenery's own surface.
constexpr float most_room = 1.5f;

template <typename Real>
class ObbStrategy final : public Strategy<Real> {
public:
    ObbStrategy(const Scene& scene, const StrategyOptions& options, const Options& boxes)
        : scene_(scene),
          options_(options),
          own_(boxes),
          maker_{scene, grid_options(options), boxes.inside, boxes.hits == Hits::local},
          hierarchy_(plan_hierarchy(scene, boxes.groups)),
          geometry_(scene),
          boxes_(hierarchy_.boxes.size()),
          first_(hierarchy_.boxes.size()),
          fits_(hierarchy_.boxes.size()),
          places_(hierarchy_.boxes.size()),
          placed_(hierarchy_.boxes.size() + hierarchy_.clusters.size()),
          supergrids_(hierarchy_.clusters.size()),
          cluster_boxes_(hierarchy_.clusters.size())
    {
    }

    void update(const Pose& pose) override
    {
        geometry_.update_on_touch(pose);
        regridded_ = 0;
        if (axes_.empty()) build(pose);
        for (std::uint32_t number = 0; number < boxes_.size(); ++number) move_box(number, pose);
        place_clusters(pose);
    }
    void closest(RayTile<Real>& rays) const override { search_closest(target(), rays); }
    void occluded(RayTile<Real>& rays) const override { search_any(target(), rays); }
    StructureReport report() const override;
    std::vector<StructureBox> outline() const override;

private:
    SearchTarget<Real> target() const
    {
        return {&scene_,
                &geometry_,
                options_.precision,
                own_.hits,
                has_scenery_ ? &scenery_ : nullptr,
                outer_.voxels.empty() ? nullptr : &outer_,
                &placed_};
    }
    const Group& group_of(std::uint32_t box) const { return scene_.groups[hierarchy_.boxes[box].group]; }
    std::span<const BoxPlace> places_of(const Cluster& cluster) const
    {
        return std::span(places_).subspan(cluster.first_box, cluster.boxes);
    }

    void build(const Pose& pose);
    void build_scenery(const Pose& pose);
    Aabb room_of_movers() const;
    void make_first(std::uint32_t number, const Transform& root_from_node);
    void make_fit(std::uint32_t number, const Fit& fit, const Transform& root_from_node, double largest);
    void move_box(std::uint32_t number, const Pose& pose);
    void move_rigid(std::uint32_t number, const Transform& root_from_node);
    void place_clusters(const Pose& pose);
    Item make_item_of(std::uint32_t cluster, const Pose& pose, double wide);
    bool stands_in_scenery(const Item& item) const;
    void outline_cluster(std::uint32_t cluster, std::vector<StructureBox>& out) const;

    const Scene& scene_;
    StrategyOptions options_;
    Options own_;
    BoxMaker maker_;
    Hierarchy hierarchy_;
    RootGeometry<Real> geometry_;
    bool has_scenery_ = false;
    BoxedGrid scenery_;
    /// What a box was made as for the start of the animation.
    struct First {
        BoxSystem system;
        float blur = 0.0f;
    };
    std::vector<Box> boxes_;             ///< by hierarchy_.boxes
    std::vector<First> first_;           ///< by box
    std::vector<Fit> fits_;              ///< by box: what it is made for now
    std::vector<BoxPlace> places_;       ///< by box
    std::vector<glm::dmat3> axes_;       ///< by hierarchy_.clusters, in the system of their nodes; empty before build()
    std::vector<Placed> placed_;         ///< boxes, then clusters
    std::vector<BoxedGrid> supergrids_;  ///< by cluster; of those that hold several boxes
    std::vector<ClusterBox> cluster_boxes_;  ///< by cluster, around the supergrids
    BoxedGrid outer_;
    double largest_ = 0.0;  ///< coordinate of anything visible when the animation starts
    std::uint64_t peak_bytes_ = 0, regridded_ = 0;
};

/// Maps the unit cube onto a box.
Transform cube_onto(const DAabb& box)
{
    const glm::dvec3 size = box.size();
    return {glm::dmat3(size.x, 0, 0, 0, size.y, 0, 0, 0, size.z), box.lo};
}

/// Where a node stands at the animation's start; where it would have no size then, at its own origin.
Transform usable(const Pose& start, std::uint32_t node)
{
    const Transform& t = start.root_from_node[node];
    return is_singular(t) ? Transform{} : t;
}

template <typename Real>
void ObbStrategy<Real>::build(const Pose& now)
{
    // What is kept is made for the start of the animation, whichever frame comes first.
    const Pose start = pose(scene_, scene_.start);
    const DAabb everything = bounds(start);
    if (!everything.empty())
        for (int axis = 0; axis < 3; ++axis)
            largest_ = std::max({largest_, std::abs(everything.lo[axis]), std::abs(everything.hi[axis])});
    const auto make = [&](std::size_t number) {
        const auto index = static_cast<std::uint32_t>(number);
        if (!group_of(index).deforming) make_first(index, usable(start, group_of(index).node));
    };
    if (options_.executor)
        options_.executor->for_each(boxes_.size(), make);
    else
        for (std::size_t i = 0; i < boxes_.size(); ++i) make(i);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        peak_bytes_ += boxes_[i].inside.bytes();
        if (!group_of(i).deforming) regridded_ += hierarchy_.boxes[i].count();
    }

    for (const Cluster& cluster : hierarchy_.clusters) {
        const Transform root_from_cluster = usable(start, cluster.node);
        std::vector<BoxPlace> places;
        for (std::uint32_t i = cluster.first_box; i < cluster.first_box + cluster.boxes; ++i) {
            const Transform root_from_node = usable(start, group_of(i).node);
            if (!group_of(i).deforming) places.push_back(place_box(boxes_[i], root_from_node, inverse(root_from_node)));
        }
        axes_.push_back(choose_axes(places, inverse(root_from_cluster).linear));
    }
    axes_.resize(std::max<std::size_t>(axes_.size(), 1));
    build_scenery(now);
}

template <typename Real>
void ObbStrategy<Real>::build_scenery(const Pose&)
{
    const Group& group = scene_.groups[0];
    has_scenery_ = group.primitives() > 0;
    if (!has_scenery_) return;
    geometry_.touch(0);
    PrimitiveList primitives;
    geometry_.list(0, primitives);
    GridEntries entries = make_entries(geometry_, primitives, options_.executor);
    Aabb own;
    for (const Aabb& box : entries.boxes) own.grow(box);
    Aabb room = room_of_movers();
    room.grow(own);
    const auto surface = [](const glm::vec3& d) { return d.x * d.y + d.y * d.z + d.z * d.x; };
    if (surface(room.size()) <= most_room * surface(own.size())) entries.room = room;
    std::uint64_t built_bytes = 0;
    scenery_.structure = build_grid(std::move(entries), maker_.grid, options_.executor, built_bytes);
    regridded_ += group.primitives();
    peak_bytes_ += built_bytes;
}

/// A box around the places of all moving boxes at some times of the animation.
template <typename Real>
Aabb ObbStrategy<Real>::room_of_movers() const
{
    Aabb room;
    for (int i = 0; i < sampled_poses; ++i) {
        const Pose sample = pose(scene_, scene_.start + (scene_.end - scene_.start) * i / (sampled_poses - 1));
        for (std::uint32_t number = 0; number < boxes_.size(); ++number) {
            const std::uint32_t node = group_of(number).node;
            if (!sample.visible[node] || boxes_[number].bounds.empty()) continue;
            const Transform& root_from_node = sample.root_from_node[node];
            const BoxPlace place = place_box(boxes_[number], root_from_node, inverse(root_from_node));
            room.grow(make_item(number, place.local_from_root, place.root_from_local, place.bounds, 0.0).bounds);
        }
    }
    return room;
}

template <typename Real>
void ObbStrategy<Real>::make_first(std::uint32_t number, const Transform& root_from_node)
{
    std::uint64_t built_bytes = 0;
    boxes_[number] = maker_.make(hierarchy_.boxes[number], root_from_node, largest_, built_bytes);
    first_[number] = {boxes_[number], boxes_[number].inside.blur};
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
    Box& box = boxes_[number];
    BoxPlace& place = places_[number];
    place.is_there = pose.is_visible(group);
    if (!place.is_there) return;
    const Transform& root_from_node = pose.root_from_node[group.node];
    if (group.deforming) {
        geometry_.touch(plan.group);
        std::uint64_t built_bytes = 0;
        box = maker_.make_deformed(plan, geometry_, root_from_node, built_bytes);
        regridded_ += group.primitives();
        place = place_in_root(box);
    } else {
        move_rigid(number, root_from_node);
    }
    placed_[number] = {&box, nullptr, plan.group, place.loose, place.local_from_root};
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
    return make_item(number, {glm::transpose(box.axes), glm::dvec3(0.0)}, {box.axes, glm::dvec3(0.0)}, box.bounds,
                     wide);
}

template <typename Real>
bool ObbStrategy<Real>::stands_in_scenery(const Item& item) const
{
    if (own_.top == Top::list || !has_scenery_) return false;
    const Grid& top = scenery_.structure.grids[0];
    return glm::all(glm::greaterThanEqual(item.bounds.lo, top.lo)) &&
           glm::all(glm::lessThanEqual(item.bounds.hi, top.hi())) &&
           cells_of(top, item.bounds, scenery_.structure.pad).cells() <= most_cells;
}

template <typename Real>
void ObbStrategy<Real>::place_clusters(const Pose& pose)
{
    double largest = static_cast<double>(scenery_.structure.largest);
    for (const BoxPlace& place : places_)
        if (place.is_there) largest = std::max(largest, place.largest);
    const double wide = std::max(largest * static_cast<double>(box_pad_factor), 1e-30);
    std::vector<Item> among, outside;
    for (std::uint32_t i = 0; i < hierarchy_.clusters.size(); ++i) {
        supergrids_[i] = {};
        const auto places = places_of(hierarchy_.clusters[i]);
        if (std::none_of(places.begin(), places.end(), [](const BoxPlace& place) { return place.is_there; })) continue;
        const Item item = make_item_of(i, pose, wide);
        (stands_in_scenery(item) ? among : outside).push_back(item);
    }
    scenery_.remove_items();
    if (!among.empty()) scenery_.insert(among);
    outer_ = outside.empty() ? BoxedGrid{} : grid_of_items(outside, own_.top == Top::list);
}

template <typename Real>
StructureReport ObbStrategy<Real>::report() const
{
    StructureReport report;
    const auto add = [&](const GridStructure& structure) {
        report.grids += !structure.grids.empty();
        report.subgrids += structure.grids.size() - !structure.grids.empty();
        report.voxels += structure.cells.size();
        report.filled_voxels += static_cast<std::uint64_t>(
            std::count_if(structure.cells.begin(), structure.cells.end(), [](CellWord w) { return !w.is_empty(); }));
        report.references += structure.references;
        report.depth = std::max<std::uint64_t>(report.depth, structure.depth);
        report.largest_list = std::max<std::uint64_t>(report.largest_list, structure.largest_list);
    };
    report.bytes = geometry_.bytes() + scenery_.bytes() + outer_.bytes();
    if (has_scenery_) {
        add(scenery_.structure);
        report.primitives += scene_.groups[0].primitives();
    }
    add(outer_.structure);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        report.bytes +=
            boxes_[i].inside.bytes() + sizeof(Box) + sizeof(First) + sizeof(Fit) + sizeof(BoxPlace) + sizeof(Placed);
        if (!places_[i].is_there) continue;
        add(boxes_[i].inside);
        report.primitives += hierarchy_.boxes[i].count();
    }
    for (const BoxedGrid& supergrid : supergrids_) {
        add(supergrid.structure);
        report.bytes += supergrid.bytes();
    }
    report.regridded = regridded_;
    report.peak_bytes = std::max(peak_bytes_ + geometry_.bytes(), report.bytes);
    return report;
}

template <typename Real>
std::vector<StructureBox> ObbStrategy<Real>::outline() const
{
    std::vector<StructureBox> out;
    if (has_scenery_)
        append_outline(scenery_.structure, scenery_.cells_without_items(), {},
                       {.name = "scenery", .primitives = scene_.groups[0].primitives()}, out);
    for (std::uint32_t i = 0; i < hierarchy_.clusters.size(); ++i) outline_cluster(i, out);
    return out;
}

template <typename Real>
void ObbStrategy<Real>::outline_cluster(std::uint32_t index, std::vector<StructureBox>& out) const
{
    const Cluster& cluster = hierarchy_.clusters[index];
    const std::size_t heading = out.size();
    const bool has_supergrid = !supergrids_[index].structure.grids.empty();
    if (has_supergrid) {
        const ClusterBox box = cluster_boxes_[index];
        const Grid& grid = supergrids_[index].structure.grids[0];
        out.push_back({.kind = StructureBox::Kind::supergrid, .name = cluster.name});
        out.back().root_from_box = Transform{box.axes, glm::dvec3(0.0)} * cube_onto(box.bounds);
        if (grid.cells() > 1) out.back().dims = grid.dims;
        out.back().references = supergrids_[index].structure.references;
    }
    for (std::uint32_t i = cluster.first_box; i < cluster.first_box + cluster.boxes; ++i) {
        if (!places_[i].is_there) continue;
        StructureBox box{.kind = StructureBox::Kind::box,
                         .name = hierarchy_.boxes[i].name,
                         .level = has_supergrid ? 1 : 0,
                         .primitives = hierarchy_.boxes[i].count()};
        if (has_supergrid) out[heading].primitives += box.primitives;
        append_outline(boxes_[i].inside, boxes_[i].inside.cells, places_[i].root_from_local, std::move(box), out);
    }
}

}  // namespace

template <typename Real>
std::unique_ptr<Strategy<Real>> make_obb(const Scene& scene, const StrategyOptions& options, const Options& boxes)
{
    return std::make_unique<ObbStrategy<Real>>(scene, options, boxes);
}

template std::unique_ptr<Strategy<float>> make_obb(const Scene&, const StrategyOptions&, const Options&);
template std::unique_ptr<Strategy<double>> make_obb(const Scene&, const StrategyOptions&, const Options&);

}  // namespace firstray::obb
