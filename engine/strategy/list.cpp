#include "engine/strategy/list.h"

#include "engine/strategy/list_search.h"
#include "engine/strategy/root_geometry.h"

namespace firstray::inline v0 {
namespace {

template <typename Real>
class ListStrategy final : public Strategy<Real> {
public:
    ListStrategy(const Scene& scene, const StrategyOptions& options) : options_(options), geometry_(scene) {}

    void update(const Pose& pose) override { geometry_.update(pose, options_.executor); }
    void closest(RayTile<Real>& rays) const override { search_list(geometry_, options_.precision, false, rays); }
    void occluded(RayTile<Real>& rays) const override { search_list(geometry_, options_.precision, true, rays); }
    StructureReport report() const override
    {
        StructureReport report;
        report.primitives = report.references = geometry_.visible().size();
        report.largest_list = report.primitives;
        report.bytes = report.peak_bytes = geometry_.bytes();
        return report;
    }

private:
    StrategyOptions options_;
    RootGeometry<Real> geometry_;
};

}  // namespace

template <typename Real>
std::unique_ptr<Strategy<Real>> make_list(const Scene& scene, const StrategyOptions& options)
{
    return std::make_unique<ListStrategy<Real>>(scene, options);
}

template std::unique_ptr<Strategy<float>> make_list(const Scene&, const StrategyOptions&);
template std::unique_ptr<Strategy<double>> make_list(const Scene&, const StrategyOptions&);

}  // namespace firstray::inline v0
