#include "lazy/lazy.h"

#include <algorithm>
#include <cmath>

#include "engine/grid/boxed_grid.h"
#include "engine/strategy/group_bounds.h"
#include "lazy/group_grids.h"
#include "lazy/lazy_grid.h"
#include "lazy/search.h"

namespace firstray::lazy {
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
          ledger_(own.budget),
          groups_(scene, geometry_, shape_, ledger_)
    {
    }

    void update(const Pose& pose) override
    {
        geometry_.update_on_touch(pose);
        ledger_.begin_frame();
        dropped_ = 0;
        if (!is_built_) build_scenery();
        for (std::uint32_t group = 1; group < scene_.groups.size(); ++group)
            if (geometry_.has_moved(group)) dropped_ += groups_.drop(group);
        place_groups(pose);
        kept_ = count_built();
    }
    void closest(RayTile<Real>& rays) const override { search_closest(target(), rays); }
    void occluded(RayTile<Real>& rays) const override { search_any(target(), rays); }
    StructureReport report() const override;

private:
    SearchTarget<Real> target() const
    {
        return {&scene_,        &geometry_, options_.precision,
                scenery_.get(), &around_,   outer_.voxels.empty() ? nullptr : &outer_,
                &groups_};
    }
    void build_scenery();
    void place_groups(const Pose& pose);
    std::uint64_t count_built() const;

    const Scene& scene_;
    StrategyOptions options_;
    Options own_;
    GridOptions shape_;
    std::vector<DAabb> bounds_;  ///< by group, in their nodes' systems
    RootGeometry<Real> geometry_;
    Ledger ledger_;
    GroupGrids<Real> groups_;
    bool is_built_ = false;
    std::unique_ptr<LazyGrid> scenery_;  ///< null where nothing is static
    BoxedGrid around_;                   ///< the scenery's top grid, with boxes of groups in it
    BoxedGrid outer_;
    std::vector<std::uint32_t> there_;  ///< groups that are visible in this frame, without the scenery
    std::uint64_t kept_ = 0, dropped_ = 0;
};

template <typename Real>
void LazyStrategy<Real>::build_scenery()
{
    is_built_ = true;
    if (scene_.groups[0].primitives() == 0) return;
    geometry_.touch(0);
    PrimitiveList primitives;
    geometry_.list(0, primitives);
    GridEntries entries = make_entries(geometry_, primitives, options_.executor);
    Aabb own;
    for (const Aabb& box : entries.boxes) own.grow(box);
    entries.room = room_for_movers(scene_, bounds_, own);
    scenery_ = std::make_unique<LazyGrid>(std::move(entries), shape_, ledger_, options_.executor);
    around_.structure = scenery_->top();
}

template <typename Real>
void LazyStrategy<Real>::place_groups(const Pose& pose)
{
    there_.clear();
    std::vector<Transform> places;
    double largest = static_cast<double>(around_.structure.largest);
    for (std::uint32_t group = 1; group < scene_.groups.size(); ++group) {
        if (!pose.is_visible(scene_.groups[group]) || bounds_[group].empty()) continue;
        there_.push_back(group);
        const Transform& place = pose.root_from_node[scene_.groups[group].node];
        const DAabb box = transformed(bounds_[group], place);
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max({largest, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
    }
    const double wide = std::max(largest * static_cast<double>(box_pad_factor), 1e-30);
    std::vector<Item> among, outside;
    for (const std::uint32_t group : there_) {
        const Transform& place = pose.root_from_node[scene_.groups[group].node];
        const Item item = make_item(group, inverse(place), place, bounds_[group], wide);
        (scenery_ && around_.has_room_for(item) ? among : outside).push_back(item);
    }
    around_.remove_items();
    if (!among.empty()) around_.insert(among);
    outer_ = outside.empty() ? BoxedGrid{} : grid_of_items(outside, false);
}

template <typename Real>
std::uint64_t LazyStrategy<Real>::count_built() const
{
    std::uint64_t built = scenery_ ? scenery_->counts().built : 0;
    for (const std::uint32_t group : there_)
        if (const LazyGrid* grid = groups_.made(group)) built += grid->counts().built;
    return built;
}

template <typename Real>
StructureReport LazyStrategy<Real>::report() const
{
    StructureReport report;
    const auto add = [&](const LazyGrid& grid) {
        const GridStructure& top = grid.top();
        ++report.grids;
        report.voxels += top.cells.size();
        report.bytes += grid.bytes();
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
    if (scenery_) add(*scenery_);
    report.primitives = scene_.groups[0].primitives();
    for (const std::uint32_t group : there_) {
        report.primitives += scene_.groups[group].primitives();
        if (const LazyGrid* grid = groups_.made(group)) add(*grid);
    }
    report.kept_voxels = kept_;
    report.dropped_voxels = dropped_;
    report.refused_builds = ledger_.refused();
    report.lazy_build_ms = ledger_.milliseconds();
    report.bytes =
        geometry_.bytes() + ledger_.bytes() + around_.bytes() + outer_.bytes() + (scenery_ ? scenery_->bytes() : 0);
    report.peak_bytes = report.bytes;
    return report;
}

}  // namespace

template <typename Real>
std::unique_ptr<Strategy<Real>> make_lazy(const Scene& scene, const StrategyOptions& options, const Options& own)
{
    return std::make_unique<LazyStrategy<Real>>(scene, options, own);
}

template std::unique_ptr<Strategy<float>> make_lazy(const Scene&, const StrategyOptions&, const Options&);
template std::unique_ptr<Strategy<double>> make_lazy(const Scene&, const StrategyOptions&, const Options&);

}  // namespace firstray::lazy
