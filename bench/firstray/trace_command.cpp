#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/firstray/frame_list.h"
#include "bench/firstray/jobs.h"
#include "bench/firstray/ray_file.h"
#include "bench/firstray/scene_input.h"
#include "bench/firstray/search.h"
#include "engine/core/pending_file.h"

namespace firstray::command {
namespace {

/// World rays as the strategy takes them. The origin is subtracted before the coordinates are rounded.
template <typename Real>
void fill(RayTile<Real>& tile, std::span<const WorldRay> rays, const glm::dvec3& scene_origin)
{
    using Vec = typename RayTile<Real>::Vec;
    tile.count = static_cast<int>(rays.size());
    tile.common_apex = false;
    for (int i = 0; i < tile.count; ++i) {
        const WorldRay& ray = rays[static_cast<std::size_t>(i)];
        tile.set_origin(i, Vec(ray.origin - scene_origin));
        tile.set_direction(i, Vec(ray.direction));
        tile.set_interval(i, static_cast<Real>(ray.t_min), static_cast<Real>(ray.t_max));
    }
}

/// The answers of all rays, in their order, as lines.
template <typename Real>
std::string trace(const Strategy<Real>& strategy, const Scene& scene, std::span<const WorldRay> rays,
                  const Executor& executor)
{
    constexpr std::size_t capacity = RayTile<Real>::capacity;
    std::vector<std::string> lines((rays.size() + capacity - 1) / capacity);
    executor.for_pieces(rays.size(), capacity, [&](std::size_t begin, std::size_t end) {
        const auto tile = std::make_unique<RayTile<Real>>();
        fill(*tile, rays.subspan(begin, end - begin), scene.origin);
        strategy.closest(*tile);
        std::string& text = lines[begin / capacity];
        for (std::size_t i = 0; i < end - begin; ++i)
            text += format_answer<Real>(scene, {tile->t_max[i], tile->u[i], tile->v[i], tile->primitive[i]});
    });
    return fmt::format("{}", fmt::join(lines, ""));
}

}  // namespace

void trace_rays(const TraceJob& job, Streams streams)
{
    check_search(job.search);
    const std::vector<WorldRay> rays = read_rays(job.rays);
    const Scene scene = read_scene(job.scene);
    check_frame(job.frame, scene.frames);
    const Executor executor(job.search.threads);
    const AnyStrategy strategy = make_strategy(job.search, scene, executor);
    const Pose current = pose(scene, scene.time_of(job.frame));
    const std::string answers = std::visit(
        [&](const auto& chosen) {
            chosen->update(current);
            return trace(*chosen, scene, rays, executor);
        },
        strategy);
    if (job.output.empty())
        streams.out << answers;
    else
        write_whole_file(job.output, answers);
}

}  // namespace firstray::command
