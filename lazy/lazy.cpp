#include "lazy/lazy.h"

#include <algorithm>
#include <cmath>

#include "engine/grid/boxed_grid.h"
#include "engine/grid/search.h"
#include "engine/strategy/group_bounds.h"
#include "lazy/group_grids.h"
#include "lazy/lazy_grid.h"
#include "lazy/scenery.h"
#include "lazy/search.h"

namespace firstray::inline v0::lazy {
namespace {

template <typename Real>
class LazyStrategy final : public Strategy<Real> {
public:
    LazyStrategy(const Scene& scene, const StrategyOptions& options, const Options& own)
        : scene_(scene),
          options_(options),
          own_(own),
          shape_(grid_options(options)),
          bounds_(group_bounds(scene)),
          geometry_(scene),
          ledger_(options.structure_budget),
          chooser_(own.rule ? std::make_unique<Chooser>(scene, *own.rule, shape_.max_list) : nullptr),
          groups_(scene, geometry_, shape_, ledger_, chooser_.get()),
          scenery_(scene, geometry_, bounds_, shape_, ledger_, chooser_.get())
    {
    }

    void update(const Pose& pose) override
    {
        geometry_.update_on_touch(pose);
        follow_live_groups(scene_, bounds_);
        ledger_.begin_frame();
        dropped_ = 0;
        if (chooser_) begin_choices();
        regridded_ = scenery_.update(options_.executor);
        const bool moved = drop_moved();
        if (own_.top == LazyTop::groups)
            place_groups(pose);
        else if (moved)
            place_primitives(pose);
        kept_ = scenery_.made() ? scenery_.made_alone()->grid.keep() : 0;
        for (const std::uint32_t item : there_) kept_ += groups_.keep(item);
    }
    void closest(RayTile<Real>& rays) const override { search(rays, false); }
    void occluded(RayTile<Real>& rays) const override { search(rays, true); }
    StructureReport report() const override;
    std::vector<StructureBox> outline() const override;

private:
    using MadeScenery = typename Scenery<Real>::Made;

    void search(RayTile<Real>& rays, bool any) const;
    void search_grids(const MadeScenery* scenery, RayTile<Real>& rays, bool any) const;
    void search_lists(RayTile<Real>& rays, bool any) const;
    void begin_choices();
    ChoiceReport choices() const;
    bool drop_moved();
    void place_groups(const Pose& pose);
    void place_primitives(const Pose& pose);

    const Scene& scene_;
    StrategyOptions options_;
    Options own_;
    GridOptions shape_;
    std::vector<DAabb> bounds_;  ///< by group, in their nodes' systems
    RootGeometry<Real> geometry_;
    Ledger ledger_;
    std::unique_ptr<Chooser> chooser_;  ///< null: the first ray has built what it enters
    GroupGrids<Real> groups_;
    Scenery<Real> scenery_;
    std::vector<std::uint32_t> there_;  ///< numbers of the items in this frame
    std::uint64_t kept_ = 0, dropped_ = 0, moving_ = 0, regridded_ = 0;
};

template <typename Real>
void LazyStrategy<Real>::search(RayTile<Real>& rays, bool any) const
{
    const MadeScenery* const scenery = scenery_.enter(static_cast<std::uint64_t>(rays.count));
    if (scenery || scenery_.is_empty())
        search_grids(scenery, rays, any);
    else
        search_lists(rays, any);
}

template <typename Real>
void LazyStrategy<Real>::search_grids(const MadeScenery* scenery, RayTile<Real>& rays, bool any) const
{
    const BoxedGrid& outer = scenery_.outer(scenery);
    const SearchTarget<Real> target{&scene_,
                                    &geometry_,
                                    options_.precision,
                                    scenery ? &scenery->grid : nullptr,
                                    scenery ? &scenery->around : nullptr,
                                    outer.voxels.empty() ? nullptr : &outer,
                                    &groups_};
    any ? search_any(target, rays) : search_closest(target, rays);
}

/// Tests the scenery first, so that what it hides is not even entered: with hits as open ends of the rays. A hit at the
/// same t in a group counts less, since the scenery's ids are the smallest.
template <typename Real>
void LazyStrategy<Real>::search_lists(RayTile<Real>& rays, bool any) const
{
    const firstray::SearchTarget<Real> target{&scenery_.flat_list(), &geometry_, options_.precision};
    any ? firstray::search_any(target, rays) : firstray::search_closest(target, rays);
    if (scenery_.outer(nullptr).voxels.empty()) return;
    const auto rest = std::make_unique<RayTile<Real>>(rays);
    const auto count = static_cast<std::size_t>(rays.count);
    for (std::size_t i = 0; any && i < count; ++i)
        if (rays.primitive[i] != no_primitive) rest->t_max[i] = rest->t_min[i];  // is done
    std::vector<std::uint8_t> may_pass(rays.may_pass ? count : 0, 1);
    if (rays.may_pass) rest->may_pass = may_pass.data();
    search_grids(nullptr, *rest, any);
    for (std::size_t i = 0; i < may_pass.size(); ++i) rays.may_pass[i] |= may_pass[i];
    for (std::size_t i = 0; i < count; ++i) {
        if (rest->primitive[i] == no_primitive) continue;
        rays.t_max[i] = rest->t_max[i];
        rays.primitive[i] = rest->primitive[i];
        rays.u[i] = rest->u[i];
        rays.v[i] = rest->v[i];
    }
}

template <typename Real>
void LazyStrategy<Real>::begin_choices()
{
    for (std::uint32_t group = 0; group < scene_.groups.size(); ++group)
        chooser_->begin_frame(group, group > 0 && geometry_.has_moved(group));
}

/// Gives up what was built of groups that stand otherwise now; returns whether there are any.
template <typename Real>
bool LazyStrategy<Real>::drop_moved()
{
    bool moved = false;
    for (std::uint32_t group = 1; group < scene_.groups.size(); ++group) {
        if (!geometry_.has_moved(group)) continue;
        dropped_ += groups_.drop(group);
        moved = true;
    }
    return moved;
}

/// Puts the boxes of groups where they are now.
template <typename Real>
void LazyStrategy<Real>::place_groups(const Pose& pose)
{
    there_.clear();
    double largest = scenery_.largest();
    for (std::uint32_t group = 1; group < scene_.groups.size(); ++group) {
        if (!pose.is_visible(scene_.groups[group]) || bounds_[group].empty()) continue;
        there_.push_back(group);
        const Transform& root_from_node = pose.root_from_node[scene_.groups[group].node];
        largest = std::max(largest, largest_coordinate(transformed(bounds_[group], root_from_node)));
    }
    const double wide = box_pad(largest);
    std::vector<Item> items;
    for (const std::uint32_t group : there_) {
        const Transform& root_from_node = pose.root_from_node[scene_.groups[group].node];
        items.push_back(make_item(group, inverse(root_from_node), root_from_node, bounds_[group], wide));
    }
    scenery_.place(std::move(items));
}

/// Carries everything that moves and lists it in one grid.
template <typename Real>
void LazyStrategy<Real>::place_primitives(const Pose& pose)
{
    there_.clear();
    PrimitiveList primitives;
    for (std::uint32_t group = 1; group < scene_.groups.size(); ++group) {
        if (!pose.is_visible(scene_.groups[group])) continue;
        geometry_.touch(group, options_.executor);
        geometry_.list(group, primitives);
    }
    std::vector<Item> items;
    if (primitives.size() > 0) {
        there_.push_back(everything_that_moves);
        moving_ = primitives.size();
        regridded_ += moving_;
        dropped_ += groups_.gather(primitives, scenery_.movers(), options_.executor);
        const GridStructure& top = groups_.made(everything_that_moves)->top();
        const DAabb box{top.grids[0].lo, top.grids[0].hi()};
        const double largest = std::max(static_cast<double>(top.largest), scenery_.largest());
        items.push_back(make_item(everything_that_moves, {}, {}, box, box_pad(largest)));
    }
    if (items.empty()) dropped_ += groups_.drop(everything_that_moves);
    scenery_.place(std::move(items));
}

template <typename Real>
StructureReport LazyStrategy<Real>::report() const
{
    StructureReport report;
    const auto add = [&](const LazyGrid& grid) {
        const GridStructure& top = grid.top();
        ++report.grids;
        report.voxels += top.cells.size();
        for (std::uint32_t cell = 0; cell < top.cells.size(); ++cell) {
            report.filled_voxels += !grid.listed(cell).empty();
            const GridStructure* built = grid.built(cell);
            if (!built) continue;
            ++report.built_voxels;
            report.references += built->references;
            report.depth = std::max<std::uint64_t>(report.depth, built->cells.size() > 1 ? built->depth + 1 : 1);
            report.largest_list = std::max<std::uint64_t>(report.largest_list, built->largest_list);
            if (built->cells.size() > 1) {
                report.subgrids += built->grids.size();
                report.voxels += built->cells.size();
            }
        }
    };
    if (const MadeScenery* scenery = scenery_.made()) add(scenery->grid);
    report.primitives = scene_.groups[0].primitives();
    for (const std::uint32_t group : there_) {
        report.primitives += group == everything_that_moves ? moving_ : scene_.groups[group].primitives();
        if (const LazyGrid* grid = groups_.made(group)) add(*grid);
    }
    report.kept_voxels = kept_;
    report.dropped_voxels = dropped_;
    report.regridded = regridded_;
    report.refused_builds = ledger_.refused();
    report.lazy_build_ms = ledger_.milliseconds();
    if (chooser_) report.choices = choices();
    report.bytes = geometry_.bytes() + ledger_.bytes() + scenery_.bytes() + (chooser_ ? chooser_->bytes() : 0);
    report.peak_bytes = report.bytes;
    return report;
}

template <typename Real>
ChoiceReport LazyStrategy<Real>::choices() const
{
    ChoiceReport report{.is_made = true};
    const auto add = [&](std::uint32_t group, const LazyGrid* grid) {
        chooser_->report(group, group == 0 ? scenery_.alternatives() : chooser_->group(group), grid != nullptr, report);
        if (grid && chooser_->voxels_of(group).count > 0) grid->report_choices(report);
    };
    const MadeScenery* const scenery = scenery_.made();
    if (!scenery_.is_empty()) add(0, scenery ? &scenery->grid : nullptr);
    for (const std::uint32_t group : there_) add(group, groups_.made(group));
    return report;
}

/// The scenery's grid; of what moves, the grids that rays have had made.
template <typename Real>
std::vector<StructureBox> LazyStrategy<Real>::outline() const
{
    std::vector<StructureBox> out;
    if (const MadeScenery* scenery = scenery_.made())
        scenery->grid.append_outline({.name = "scenery", .primitives = scene_.groups[0].primitives()}, out);
    for (const std::uint32_t item : there_) {
        const LazyGrid* grid = groups_.made(item);
        if (!grid) continue;
        StructureBox box{.name = "what moves", .level = 1, .primitives = moving_};
        if (item != everything_that_moves) {
            const Group& group = scene_.groups[item];
            box.name = group.node == 0 ? "deforming" : scene_.nodes[group.node].name;
            box.primitives = group.primitives();
        }
        grid->append_outline(std::move(box), out);
    }
    return out;
}

}  // namespace

template <typename Real>
std::unique_ptr<Strategy<Real>> make_lazy(const Scene& scene, const StrategyOptions& options, const Options& own)
{
    return std::make_unique<LazyStrategy<Real>>(scene, options, own);
}

template std::unique_ptr<Strategy<float>> make_lazy(const Scene&, const StrategyOptions&, const Options&);
template std::unique_ptr<Strategy<double>> make_lazy(const Scene&, const StrategyOptions&, const Options&);

}  // namespace firstray::inline v0::lazy
