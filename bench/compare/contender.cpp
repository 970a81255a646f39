#include "bench/compare/contender.h"

#include <atomic>
#include <utility>

#include "engine/core/errors.h"

namespace firstray::compare {
namespace {

template <typename Real>
std::uint64_t nanoseconds_to_search(const Strategy<Real>& strategy, RayQuery query, RayTile<Real>& tile)
{
    const Stopwatch watch;
    if (query == RayQuery::closest)
        strategy.closest(tile);
    else
        strategy.occluded(tile);
    return static_cast<std::uint64_t>(1e9 * watch.seconds());
}

template <typename Real>
ByKind<double> replay_through(const Strategy<Real>& strategy, const RecordedRays& rays, const Executor& executor)
{
    ByKind<std::atomic<std::uint64_t>> spent{};
    executor.for_each(rays.batches().size(), [&](std::size_t b) {
        const RecordedRays::Batch& batch = rays.batches()[b];
        const auto tile = std::make_unique<RayTile<Real>>();
        rays.load(batch, *tile);
        at(spent, batch.kind) += nanoseconds_to_search(strategy, batch.query, *tile);
    });
    ByKind<double> seconds{};
    for (std::size_t kind = 0; kind < ray_kinds; ++kind) seconds[kind] = 1e-9 * static_cast<double>(spent[kind]);
    return seconds;
}

}  // namespace

template <typename Real>
Contender::Made<Real> Contender::made(const Scene& scene, std::span<const Texture> textures,
                                      std::unique_ptr<Strategy<Real>> strategy, const Executor& executor)
{
    Made<Real> result{std::move(strategy), nullptr, nullptr, nullptr};
    result.recorder = std::make_unique<RayRecorder<Real>>(*result.strategy);
    result.loop = std::make_unique<FrameLoop<Real>>(scene, textures, *result.strategy, executor);
    result.recording_loop = std::make_unique<FrameLoop<Real>>(scene, textures, *result.recorder, executor);
    return result;
}

Contender::Contender(const Scene& scene, std::span<const Texture> textures, const Contestant& contestant,
                     StrategyOptions options, const Executor& executor)
    : executor_(executor)
{
    options.executor = &executor;
    options.own = contestant.own;
    const bool in_double = options.precision == Precision::double_;
    if (in_double ? !contestant.entry->make_double : !contestant.entry->make)
        throw Error(Fault::usage, "the strategy does not have this precision");
    if (in_double)
        any_ = made(scene, textures, contestant.entry->make_double(scene, options), executor);
    else
        any_ = made(scene, textures, contestant.entry->make(scene, options), executor);
}

void Contender::update(int frame)
{
    std::visit([&](auto& made) { made.loop->update(frame); }, any_);
}

FrameStats Contender::render(int frame, const RenderOptions& options, Frame& picture)
{
    return std::visit([&](auto& made) { return made.loop->render(frame, options, picture); }, any_);
}

FrameStats Contender::render_part(int frame, const RenderOptions& options, std::span<const glm::ivec2> pixels,
                                  Frame& picture)
{
    return std::visit([&](auto& made) { return made.loop->render_part(frame, options, pixels, picture); }, any_);
}

FrameStats Contender::record(int frame, const RenderOptions& options, Frame& picture, RecordedRays& rays)
{
    return std::visit(
        [&](auto& made) {
            made.recorder->record_to(&rays);
            const FrameStats stats = made.recording_loop->render(frame, options, picture);
            made.recorder->record_to(nullptr);
            return stats;
        },
        any_);
}

const Pose& Contender::current_pose() const
{
    return std::visit([](const auto& made) -> const Pose& { return made.loop->current_pose(); }, any_);
}

std::vector<StructureBox> Contender::outline() const
{
    return std::visit([](const auto& made) { return made.loop->outline(); }, any_);
}

ByKind<double> Contender::replay(const RecordedRays& rays) const
{
    return std::visit([&](const auto& made) { return replay_through(*made.strategy, rays, executor_); }, any_);
}

std::vector<RayAnswer> Contender::answers(const RecordedRays& rays, Sample sample) const
{
    return std::visit([&](const auto& made) { return compare::answers(*made.strategy, rays, sample, executor_); },
                      any_);
}

std::vector<RayAnswer> Contender::sparse_answers(const RecordedRays& rays, Sample sample) const
{
    return std::visit(
        [&](const auto& made) { return compare::sparse_answers(*made.strategy, rays, sample, executor_); }, any_);
}

}  // namespace firstray::compare
