#include "bench/peers/embree_trace.h"

namespace firstray::peers {
namespace {

/// How a group's body comes into the root system.
enum class Placement {
    stays,   ///< static: built once in the root system
    moves,   ///< rigid (or scaled): built once in the system of the group's node, its instance moves
    deforms  ///< built every frame in the root system
};

Placement placement_of(const Group& group)
{
    if (group.deforming) return Placement::deforms;
    return group.node == 0 ? Placement::stays : Placement::moves;
}

void set_transform(RTCGeometry instance, const Transform& root_from_body)
{
    float columns[12];
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            columns[3 * column + row] =
                static_cast<float>(column < 3 ? root_from_body.linear[column][row] : root_from_body.offset[row]);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

/// A body per group, each behind an instance. The static group too: in one scene with the instances its triangles would
/// be built anew with them every frame.
class TwoLevel final : public Strategy<float> {
public:
    TwoLevel(const Scene& scene, const StrategyOptions& options, Options own)
        : scene_(scene),
          device_(options.executor),
          packet_width_(packet_width(device_, own)),
          top_(device_.new_scene(with_precision({}, options.precision)))
    {
        const BuildChoice choice = with_precision({}, options.precision);
        bodies_.reserve(scene.groups.size());
        for (std::uint32_t i = 0; i < scene.groups.size(); ++i) bodies_.push_back(make_body(i, choice));
        for (std::uint32_t i = 0; i < scene.groups.size(); ++i) instances_.push_back(make_instance(i));
    }

    void update(const Pose& pose) override
    {
        for (std::uint32_t i = 0; i < bodies_.size(); ++i) place_instance(pose, i);
        device_.commit(top_.get());
        met_ = lowest_visible(pose);
    }

    void closest(RayTile<float>& rays) const override
    {
        trace_closest(top_.get(), packet_width_, rays,
                      [this](unsigned instance) -> const Body& { return *bodies_[instance]; });
    }

    // Called coherent, packets of shadow rays through instances do not come back from Embree 3.13.5 on some scenes, the
    // moving ones of the tests among them.
    void occluded(RayTile<float>& rays) const override
    {
        trace_occluded(top_.get(), packet_width_, rays, met_, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    }

    StructureReport report() const override
    {
        StructureReport report;
        std::uint64_t ours = 0;
        for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
            ours += bodies_[i]->bytes();
            if (shown_[i]) report.primitives += bodies_[i]->primitives();
        }
        report.bytes = device_.bytes() + ours;
        report.peak_bytes = device_.peak_bytes() + ours;
        return report;
    }

private:
    std::unique_ptr<Body> make_body(std::uint32_t index, const BuildChoice& choice) const
    {
        auto body = std::make_unique<Body>(device_, choice);
        body->list(scene_, {&index, 1});
        const Group& group = scene_.groups[index];
        if (placement_of(group) != Placement::moves) return body;
        for (std::uint32_t i = 0; i < group.vertices; ++i)
            body->vertices()[i] = glm::vec3(scene_.position(group.first_vertex + i));
        const Transform identity;
        body->place_quadrics(scene_, {&identity, 1});
        body->commit();
        return body;
    }

    GeometryHandle make_instance(std::uint32_t index)
    {
        if (scene_.groups[index].primitives() == 0) return {};
        GeometryHandle instance = device_.new_geometry(RTC_GEOMETRY_TYPE_INSTANCE, RTC_BUILD_QUALITY_MEDIUM);
        rtcSetGeometryInstancedScene(instance.get(), bodies_[index]->scene());
        rtcSetGeometryTimeStepCount(instance.get(), 1);
        rtcSetGeometryMask(instance.get(), bodies_[index]->mask());
        set_transform(instance.get(), {});
        rtcAttachGeometryByID(top_.get(), instance.get(), index);
        return instance;
    }

    void place_instance(const Pose& pose, std::uint32_t index)
    {
        const Group& group = scene_.groups[index];
        const RTCGeometry instance = instances_[index].get();
        if (!instance) return;
        shown_[index] = pose.is_visible(group);
        if (!shown_[index]) return rtcDisableGeometry(instance);
        rtcEnableGeometry(instance);
        const Placement placement = placement_of(group);
        if (placement == Placement::moves) set_transform(instance, pose.root_from_node[group.node]);
        if (placement == Placement::deforms || (placement == Placement::stays && !static_built_))
            build_in_root(pose, index);
        rtcCommitGeometry(instance);
    }

    void build_in_root(const Pose& pose, std::uint32_t index)
    {
        const Group& group = scene_.groups[index];
        Body& body = *bodies_[index];
        carry_vertices(pose, group, body.vertices().data());
        body.touch();
        body.place_quadrics(scene_, {&pose.root_from_node[group.node], 1});
        body.commit();
        if (placement_of(group) == Placement::stays) static_built_ = true;
    }

    const Scene& scene_;
    Device device_;
    int packet_width_;
    std::vector<std::unique_ptr<Body>> bodies_;  // by group; Embree keeps pointers into them
    SceneHandle top_;
    std::vector<GeometryHandle> instances_;  // by group, null for groups without primitives
    std::vector<bool> shown_ = std::vector<bool>(scene_.groups.size(), false);
    bool static_built_ = false;  // node 0 is always visible, its pose is the same in every frame
    PrimitiveId met_ = no_primitive;
};

}  // namespace

std::unique_ptr<Strategy<float>> make_embree_two_level(const Scene& scene, const StrategyOptions& options, Options own)
{
    return std::make_unique<TwoLevel>(scene, options, own);
}

}  // namespace firstray::peers
