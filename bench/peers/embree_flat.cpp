#include "bench/peers/embree_trace.h"

namespace firstray::peers {
namespace {

/// One body over everything visible, in the root system, built anew or refitted every frame.
class Flat final : public Strategy<float> {
public:
    Flat(const Scene& scene, const StrategyOptions& options, Options own, const BuildChoice& choice)
        : scene_(scene),
          executor_(options.executor),
          device_(options.executor),
          packet_width_(packet_width(device_, own)),
          body_(device_, with_precision(choice, options.precision))
    {
    }

    void update(const Pose& pose) override
    {
        std::vector<std::uint32_t> shown = visible_groups(pose);
        if (shown != shown_) {  // mostly it is the last frame's: what is listed then stays, only vertices move
            shown_ = std::move(shown);
            body_.list(scene_, shown_);
        }
        carry(pose);
        body_.commit();
        met_ = lowest_visible(pose);
    }

    void closest(RayTile<float>& rays) const override
    {
        trace_closest(body_.scene(), packet_width_, rays, [this](unsigned) -> const Body& { return body_; });
    }

    void occluded(RayTile<float>& rays) const override { trace_occluded(body_.scene(), packet_width_, rays, met_); }

    StructureReport report() const override
    {
        StructureReport report;
        report.primitives = body_.primitives();
        report.bytes = device_.bytes() + body_.bytes();
        report.peak_bytes = device_.peak_bytes() + body_.bytes();
        return report;
    }

private:
    std::vector<std::uint32_t> visible_groups(const Pose& pose) const
    {
        std::vector<std::uint32_t> shown;
        for (std::uint32_t i = 0; i < scene_.groups.size(); ++i)
            if (scene_.groups[i].primitives() > 0 && pose.is_visible(scene_.groups[i])) shown.push_back(i);
        return shown;
    }

    void carry(const Pose& pose)
    {
        std::vector<std::size_t> first(shown_.size() + 1, 0);  // where a group's vertices begin in the body
        std::vector<Transform> root_from_group(shown_.size());
        for (std::size_t i = 0; i < shown_.size(); ++i) {
            const Group& group = scene_.groups[shown_[i]];
            first[i + 1] = first[i] + group.vertices;
            root_from_group[i] = pose.root_from_node[group.node];
        }
        const auto carry_group = [&](std::size_t i) {
            carry_vertices(pose, scene_.groups[shown_[i]], body_.vertices().data() + first[i], executor_);
        };
        if (executor_)
            executor_->for_each(shown_.size(), carry_group);
        else
            for (std::size_t i = 0; i < shown_.size(); ++i) carry_group(i);
        body_.touch();
        body_.place_quadrics(scene_, root_from_group);
    }

    const Scene& scene_;
    const Executor* executor_;
    Device device_;
    int packet_width_;
    Body body_;
    std::vector<std::uint32_t> shown_;  // groups in body_, ascending
    PrimitiveId met_ = no_primitive;
};

}  // namespace

std::unique_ptr<Strategy<float>> make_embree_medium(const Scene& scene, const StrategyOptions& options, Options own)
{
    return std::make_unique<Flat>(scene, options, own, BuildChoice{RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE});
}

std::unique_ptr<Strategy<float>> make_embree_low(const Scene& scene, const StrategyOptions& options, Options own)
{
    return std::make_unique<Flat>(scene, options, own, BuildChoice{RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_DYNAMIC});
}

std::unique_ptr<Strategy<float>> make_embree_refit(const Scene& scene, const StrategyOptions& options, Options own)
{
    return std::make_unique<Flat>(scene, options, own, BuildChoice{RTC_BUILD_QUALITY_REFIT, RTC_SCENE_FLAG_DYNAMIC});
}

}  // namespace firstray::peers
