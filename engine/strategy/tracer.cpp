#include "engine/strategy/tracer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/errors.h"

namespace firstray::inline v0 {
namespace {

constexpr int updating = -1;

[[noreturn]] void refuse(const std::string& what)
{
    throw Error(Fault::usage, what);
}

bool is_finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool is_finite(const Transform& t)
{
    return is_finite(t.linear[0]) && is_finite(t.linear[1]) && is_finite(t.linear[2]) && is_finite(t.offset);
}

std::string name_of(const Scene& scene, std::size_t node)
{
    const std::string& name = scene.nodes[node].name;
    return "group " + std::to_string(node) + (name.empty() ? "" : " (" + name + ")");
}

/// Checks what triangles name; other vertices of the caller's may be anything.
void check_live_vertices(const Scene& scene)
{
    for (const Part& part : scene.parts) {
        if (!scene.groups[part.group].live) continue;
        const std::uint32_t first = scene.triangle_slot(part.first);
        for (std::uint32_t i = 0; i < part.count; ++i)
            for (int k = 0; k < 3; ++k)
                if (!is_finite(scene.position(scene.triangles[first + i].vertex[k])))
                    refuse("update: mesh " + std::to_string(part.mesh) + ": triangle " + std::to_string(i) +
                           " has a vertex that is not finite, expected numbers");
    }
}

Pose pose_of(const Scene& scene, std::span<const Transform> root_from_group, std::span<const std::uint8_t> visible)
{
    const std::size_t movers = scene.nodes.size() - 1;
    if (root_from_group.size() != movers)
        refuse("update: " + std::to_string(root_from_group.size()) + " transforms, expected " + std::to_string(movers) +
               ", one per group");
    if (!visible.empty() && visible.size() != movers)
        refuse("update: visibility of " + std::to_string(visible.size()) + " groups, expected " +
               std::to_string(movers) + " or none");
    Pose pose;
    pose.scene = &scene;
    pose.root_from_node.resize(1);
    pose.root_from_node.insert(pose.root_from_node.end(), root_from_group.begin(), root_from_group.end());
    pose.visible.assign(1, 1);
    pose.visible.resize(scene.nodes.size(), 1);
    for (std::uint32_t node = 1; node <= movers; ++node) {
        if (!visible.empty() && visible[node - 1] == 0) pose.visible[node] = 0;
        if (!is_finite(pose.root_from_node[node]))
            refuse("update: the transform of " + name_of(scene, node) + " is not finite, expected numbers");
        if (pose.visible[node] == 0 || !is_singular(pose.root_from_node[node])) continue;
        pose.visible[node] = 0;
        pose.singular_nodes.push_back(node);
    }
    return pose;
}

/// Whether all rays start at one point, so that they can be searched as a beam.
template <typename Ray>
bool have_common_apex(std::span<const Ray> rays)
{
    return rays.size() > 1 &&
           std::all_of(rays.begin(), rays.end(), [&](const Ray& ray) { return ray.origin == rays.front().origin; });
}

}  // namespace

/// Keeps updates out while a batch is traced.
template <typename Real>
class BasicTracer<Real>::Tracing {
public:
    explicit Tracing(const BasicTracer& tracer) : users_(tracer.users_)
    {
        int users = users_.load(std::memory_order_relaxed);
        do
            if (users == updating) refuse("rays are traced during an update, expected before or after");
        while (!users_.compare_exchange_weak(users, users + 1, std::memory_order_acquire));
    }
    ~Tracing() { users_.fetch_sub(1, std::memory_order_release); }
    Tracing(const Tracing&) = delete;
    Tracing& operator=(const Tracing&) = delete;

private:
    std::atomic<int>& users_;
};

template <typename Real>
BasicTracer<Real>::BasicTracer(const Scene& scene, std::unique_ptr<Strategy<Real>> strategy, const Executor* executor)
    : scene_(scene), strategy_(std::move(strategy)), executor_(executor)
{
}

template <typename Real>
void BasicTracer<Real>::update(std::span<const Transform> root_from_group, std::span<const std::uint8_t> visible)
{
    update(pose_of(scene_, root_from_group, visible));
}

template <typename Real>
void BasicTracer<Real>::update(Pose pose)
{
    if (pose.scene != &scene_) refuse("update: a pose of another scene");
    int nobody = 0;
    if (!users_.compare_exchange_strong(nobody, updating, std::memory_order_acquire))
        refuse(nobody == updating ? "update: another update is running"
                                  : "update: rays are being traced, expected before or after");
    struct Release {
        std::atomic<int>& users;
        ~Release() { users.store(0, std::memory_order_release); }
    } release{users_};
    check_live_vertices(scene_);
    is_ready_ = false;
    pose_ = std::move(pose);
    strategy_->update(pose_);
    is_ready_ = true;
}

/// Calls answer(tile, first) for each tile of rays, `first` being the number of its first ray.
template <typename Real>
template <typename Answer>
void BasicTracer<Real>::for_tiles(std::span<const Ray> rays, std::size_t answers, RayMask mask,
                                  const Answer& answer) const
{
    if (answers != rays.size())
        refuse("room for " + std::to_string(answers) + " answers, expected " + std::to_string(rays.size()) +
               ", one per ray");
    const Tracing tracing(*this);
    if (!is_ready_) refuse("rays are traced before an update has succeeded, expected an update first");
    const auto trace = [&](std::size_t begin, std::size_t end) {
        const auto some = rays.subspan(begin, end - begin);
        const auto tile = std::make_unique_for_overwrite<Tile>();
        tile->count = static_cast<int>(some.size());
        tile->mask = mask;
        tile->common_apex = have_common_apex(some);
        tile->apex = some.front().origin;
        for (int i = 0; i < tile->count; ++i) {
            const Ray& ray = some[static_cast<std::size_t>(i)];
            tile->set_origin(i, ray.origin);
            tile->set_direction(i, ray.direction);
            tile->set_interval(i, ray.t_min, ray.t_max);
        }
        answer(*tile, begin);
    };
    constexpr std::size_t grain = Tile::capacity;
    if (executor_) return executor_->for_pieces(rays.size(), grain, trace);
    for (std::size_t begin = 0; begin < rays.size(); begin += grain)  // for_pieces would make one piece of all
        trace(begin, std::min(begin + grain, rays.size()));
}

template <typename Real>
void BasicTracer<Real>::closest(std::span<const Ray> rays, std::span<Hit> hits, RayMask mask) const
{
    for_tiles(rays, hits.size(), mask, [&](Tile& tile, std::size_t first) {
        strategy_->closest(tile);
        for (std::size_t i = 0; i < static_cast<std::size_t>(tile.count); ++i) hits[first + i] = hit_of(tile, i);
    });
}

template <typename Real>
void BasicTracer<Real>::occluded(std::span<const Ray> rays, std::span<std::uint8_t> answers, RayMask mask) const
{
    for_tiles(rays, answers.size(), mask, [&](Tile& tile, std::size_t first) {
        strategy_->occluded(tile);
        for (std::size_t i = 0; i < static_cast<std::size_t>(tile.count); ++i)
            answers[first + i] = tile.primitive[i] != no_primitive;
    });
}

template <typename Real>
typename BasicTracer<Real>::Hit BasicTracer<Real>::hit_of(const Tile& tile, std::size_t lane) const
{
    const PrimitiveId primitive = tile.primitive[lane];
    if (primitive == no_primitive) return {};
    const Part& part = scene_.part(primitive);
    return {.t = tile.t_max[lane],
            .u = tile.u[lane],
            .v = tile.v[lane],
            .group = scene_.groups[part.group].node,
            .mesh = part.mesh,
            .triangle = primitive - part.first,
            .primitive = primitive};
}

template class BasicTracer<float>;
template class BasicTracer<double>;

}  // namespace firstray::inline v0
