#include "bench/micro/measurement.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

#include "engine/core/errors.h"

namespace firstray {
namespace {

constexpr double tolerance = 1e-3;              // of t
constexpr double most_differing = 0.001 * 1e6;  // rays per million
constexpr float nothing = std::numeric_limits<float>::infinity();

struct Contender {
    Measured& result;
    std::unique_ptr<Strategy<float>> strategy;
};

void search(const Strategy<float>& strategy, Phase phase, RayTile<float>& tile)
{
    if (phase == Phase::shadow)
        strategy.occluded(tile);
    else
        strategy.closest(tile);
}

/// Calls visit(tile) for every batch of a phase that next() names, until that is past the last.
template <typename Next, typename Visit>
void for_batches(const FrameRays& rays, Phase phase, Next next, const Visit& visit)
{
    const auto tile = std::make_unique<RayTile<float>>();
    for (std::size_t batch = next(); batch < rays.batches(phase); batch = next()) {
        rays.load(phase, batch, *tile);
        visit(*tile);
    }
}

/// Per ray: t of the hit, or 1 where a shadow ray meets something; infinity for nothing.
std::vector<float> answers(const Strategy<float>& strategy, const FrameRays& rays, Phase phase)
{
    std::vector<float> found;
    found.reserve(rays.count(phase));
    const auto in_order = [batch = std::size_t{0}]() mutable { return batch++; };
    for_batches(rays, phase, in_order, [&](RayTile<float>& tile) {
        search(strategy, phase, tile);
        for (std::size_t i = 0; i < static_cast<std::size_t>(tile.count); ++i)
            found.push_back(tile.primitive[i] == no_primitive ? nothing
                            : phase == Phase::shadow          ? 1.0f
                                                              : tile.t_max[i]);
    });
    return found;
}

/// The seconds of the thread that searched longest. Making the rays does not count, so that no clock can run from the
/// first batch to the last.
double seconds_to_search(const Strategy<float>& strategy, const FrameRays& rays, Phase phase, const Executor& executor)
{
    using Clock = std::chrono::steady_clock;
    std::vector<Clock::duration> spent(static_cast<std::size_t>(executor.threads()));
    std::atomic<std::size_t> batch = 0;
    executor.for_each(spent.size(), [&](std::size_t worker) {
        Clock::duration sum{};
        const auto next_free = [&] { return batch++; };
        for_batches(rays, phase, next_free, [&](RayTile<float>& tile) {
            const Clock::time_point start = Clock::now();
            search(strategy, phase, tile);
            sum += Clock::now() - start;
        });
        spent[worker] = sum;
    });
    return std::chrono::duration<double>(*std::max_element(spent.begin(), spent.end())).count();
}

double seconds_to_update(Strategy<float>& strategy, const Pose& pose)
{
    const auto start = std::chrono::steady_clock::now();
    strategy.update(pose);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool differ(float expected, float found)
{
    if (std::isfinite(expected) != std::isfinite(found)) return true;
    return std::isfinite(expected) && std::abs(found - expected) > tolerance * std::abs(expected);
}

void compare(const std::vector<float>& expected, const std::vector<float>& found, Agreement& agreement)
{
    agreement.rays += expected.size();
    for (std::size_t i = 0; i < expected.size(); ++i) agreement.differing += differ(expected[i], found[i]);
}

/// Runs `work` unless the contender is out already; an Error puts it out.
template <typename Work>
void attempt(Measured& result, const Work& work)
{
    if (!result.fault.empty()) return;
    try {
        work();
    } catch (const Error& error) {
        result.fault = error.what();
    }
}

/// Records a frame's rays with the reference's hits and compares everyone's answers.
void check_frame(Strategy<float>& reference, bool scattered, FrameRays& rays, std::vector<Contender>& contenders)
{
    reference.update(rays.pose());
    const std::vector<float> primary = answers(reference, rays, Phase::primary);
    rays.set_hits(primary);
    std::vector<Phase> phases = {Phase::primary, Phase::shadow};
    if (scattered) phases.push_back(Phase::scattered);
    std::vector<std::vector<float>> expected;
    for (const Phase phase : phases) expected.push_back(answers(reference, rays, phase));
    for (Contender& contender : contenders)
        attempt(contender.result, [&] {
            contender.strategy->update(rays.pose());
            for (std::size_t i = 0; i < phases.size(); ++i)
                compare(expected[i], answers(*contender.strategy, rays, phases[i]), contender.result.agreement);
        });
}

void refuse_differing(std::vector<Contender>& contenders)
{
    for (Contender& contender : contenders) {
        const double differing = contender.result.agreement.per_million();
        if (differing > most_differing && contender.result.fault.empty())
            contender.result.fault =
                std::to_string(std::lround(differing)) + " rays per million differ from the reference";
    }
}

void time_frame(Contender& contender, const FrameRays& rays, bool scattered, const Executor& executor,
                PhaseTimes& times)
{
    times.update = seconds_to_update(*contender.strategy, rays.pose());
    times.primary = seconds_to_search(*contender.strategy, rays, Phase::primary, executor);
    times.shadow = seconds_to_search(*contender.strategy, rays, Phase::shadow, executor);
    if (scattered) times.scattered = seconds_to_search(*contender.strategy, rays, Phase::scattered, executor);
}

void time_round(std::vector<Contender>& contenders, const std::vector<FrameRays>& frames, bool scattered,
                const Executor& executor, std::size_t round)
{
    for (Contender& contender : contenders) contender.result.rounds.emplace_back(frames.size());
    for (std::size_t frame = 0; frame < frames.size(); ++frame)
        for (std::size_t turn = 0; turn < contenders.size(); ++turn) {
            Contender& contender = contenders[(turn + round) % contenders.size()];  // nobody always follows the same
            PhaseTimes& times = contender.result.rounds.back()[frame];
            attempt(contender.result, [&] { time_frame(contender, frames[frame], scattered, executor, times); });
        }
}

/// What the renderer asks for is opaque primitives only where there are others.
RayMask shadow_mask(const Scene& scene, RayMask wanted)
{
    const auto transmits = [&](const Part& part) { return scene.materials[part.material].transmits(); };
    return std::any_of(scene.parts.begin(), scene.parts.end(), transmits) ? wanted : RayMask::all;
}

std::vector<FrameRays> frames_of(const Scene& scene, const MeasurePlan& plan)
{
    std::vector<FrameRays> frames;
    for (int i = 0; i < plan.frames; ++i) {
        const int frame = static_cast<int>(std::int64_t{i} * scene.frames / plan.frames);
        frames.emplace_back(pose(scene, scene.time_of(frame)), plan.width, plan.height,
                            shadow_mask(scene, plan.shadow_mask));
    }
    return frames;
}

std::vector<Contender> make_contenders(const Scene& scene, const std::vector<Contestant>& contestants,
                                       StrategyOptions options, std::vector<Measured>& results)
{
    std::vector<Contender> contenders;
    results.resize(contestants.size());
    for (std::size_t i = 0; i < contestants.size(); ++i) {
        results[i].name = contestants[i].name;
        results[i].is_peer = contestants[i].entry->peer;
        options.own = contestants[i].own;
        contenders.push_back({results[i], nullptr});
        attempt(results[i], [&] { contenders.back().strategy = contestants[i].entry->make(scene, options); });
    }
    return contenders;
}

}  // namespace

Measurement measure(const Scene& scene, const MeasurePlan& plan)
{
    const Executor executor(plan.threads);
    StrategyOptions options = plan.options;
    options.executor = &executor;

    Measurement measurement;
    std::vector<Contender> contenders = make_contenders(scene, plan.contestants, options, measurement.strategies);
    std::vector<FrameRays> frames = frames_of(scene, plan);

    auto reference = plan.reference->make(scene, options);
    for (FrameRays& frame : frames) {
        check_frame(*reference, plan.scattered, frame, contenders);
        measurement.primary += frame.count(Phase::primary);
        measurement.shadow += frame.count(Phase::shadow);
        if (plan.scattered) measurement.scattered += frame.count(Phase::scattered);
    }
    reference.reset();
    refuse_differing(contenders);

    for (int round = 0; round < plan.rounds; ++round)
        time_round(contenders, frames, plan.scattered, executor, static_cast<std::size_t>(round));
    for (Contender& contender : contenders)
        attempt(contender.result, [&] { contender.result.structure = contender.strategy->report(); });
    return measurement;
}

}  // namespace firstray
