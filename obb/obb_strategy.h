#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/grid/boxed_grid.h"
#include "engine/strategy/strategy.h"
#include "obb/box.h"
#include "obb/hierarchy.h"
#include "obb/options.h"
#include "obb/placing.h"
#include "obb/search.h"

namespace firstray::inline v0::obb {

/// See make_obb.
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
        if (axes_.empty()) build();
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
                has_scenery_ ? &scenery_ : nullptr,
                outer_.voxels.empty() ? nullptr : &outer_,
                &placed_};
    }
    const Group& group_of(std::uint32_t box) const { return scene_.groups[hierarchy_.boxes[box].group]; }
    std::span<const BoxPlace> places_of(const Cluster& cluster) const
    {
        return std::span(places_).subspan(cluster.first_box, cluster.boxes);
    }

    void build();
    void build_scenery(const Aabb& movers);
    void make_first(std::uint32_t number, const Transform& root_from_node);
    void make_fit(std::uint32_t number, const Fit& fit, const Transform& root_from_node, double largest);
    void move_box(std::uint32_t number, const Pose& pose);
    void move_rigid(std::uint32_t number, const Transform& root_from_node);
    void regrid(std::uint32_t number, const Transform& root_from_node);
    bool can_be_kept(std::uint32_t number, const Transform& root_from_node) const;
    void place_clusters(const Pose& pose);
    Item make_item_of(std::uint32_t cluster, const Pose& pose, double wide);
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
        double reach = 0.0;    ///< see BoxMaker::reach_of
        bool is_kept = false;  ///< false: deforms, or was out of range
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
    double largest_ = 0.0;  ///< coordinate of anything visible at the animation's start, or of what moves later
    std::uint64_t peak_bytes_ = 0, regridded_ = 0;
};

}  // namespace firstray::inline v0::obb
