#include "engine/strategy/grid.h"

#include <algorithm>

#include "engine/grid/build.h"
#include "engine/grid/entries.h"
#include "engine/grid/outline.h"
#include "engine/grid/search.h"

namespace firstray {
namespace {

template <typename Real>
class GridStrategy final : public Strategy<Real> {
public:
    GridStrategy(const Scene& scene, const StrategyOptions& options) : options_(options), geometry_(scene) {}

    void update(const Pose& pose) override
    {
        geometry_.update(pose, options_.executor);
        std::uint64_t built_bytes = 0;
        make_entries(geometry_, geometry_.visible(), options_.executor, entries_);
        build_grid(entries_, grid_options(options_), options_.executor, scratch_, structure_, built_bytes);
        peak_bytes_ = std::max(peak_bytes_, built_bytes + geometry_.bytes());
    }
    void closest(RayTile<Real>& rays) const override { search_closest(target(), rays); }
    void occluded(RayTile<Real>& rays) const override { search_any(target(), rays); }
    StructureReport report() const override;
    std::vector<StructureBox> outline() const override
    {
        std::vector<StructureBox> boxes;
        append_outline(structure_, structure_.cells, Transform{}, {.name = "grid", .primitives = primitives()}, boxes);
        return boxes;
    }

private:
    std::uint64_t primitives() const { return geometry_.visible().size(); }
    SearchTarget<Real> target() const { return {&structure_, &geometry_, options_.precision}; }

    StrategyOptions options_;
    RootGeometry<Real> geometry_;
    GridEntries entries_;   // these three keep their memory from frame to frame
    BuildScratch scratch_;
    GridStructure structure_;
    std::uint64_t peak_bytes_ = 0;
};

template <typename Real>
StructureReport GridStrategy<Real>::report() const
{
    StructureReport report;
    report.grids = structure_.grids.empty() ? 0 : 1;
    report.subgrids = structure_.grids.size() - report.grids;
    report.voxels = structure_.cells.size();
    report.filled_voxels = structure_.lists.size() + report.subgrids;
    report.references = structure_.references;
    report.primitives = primitives();
    report.bytes = structure_.bytes() + entries_.bytes() + geometry_.bytes();
    report.peak_bytes = peak_bytes_;
    report.regridded = report.primitives;
    report.depth = structure_.depth;
    report.largest_list = structure_.largest_list;
    return report;
}

}  // namespace

template <typename Real>
std::unique_ptr<Strategy<Real>> make_grid(const Scene& scene, const StrategyOptions& options)
{
    return std::make_unique<GridStrategy<Real>>(scene, options);
}

template std::unique_ptr<Strategy<float>> make_grid(const Scene&, const StrategyOptions&);
template std::unique_ptr<Strategy<double>> make_grid(const Scene&, const StrategyOptions&);

}  // namespace firstray
