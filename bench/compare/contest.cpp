#include "bench/compare/contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "engine/core/errors.h"

namespace firstray::compare {
namespace {

constexpr std::size_t most_rays_kept = std::size_t{8} << 20;        // of all frames; 32 bytes each
constexpr std::size_t most_rays_of_a_frame = std::size_t{1} << 18;  // replayed in every round: enough for a mean
constexpr double list_tests = 5e8;                                  // a frame; a thread makes about two in a nanosecond

// A frame rendered, then its rays asked again.
constexpr double check_work = 2.0, round_work = 2.0;

/// Gives the reference's pictures and records the rays: all of our strategies give the same.
constexpr const char* reference_strategy = "grid";

}  // namespace

std::size_t default_check_rays(std::size_t primitives)
{
    return static_cast<std::size_t>(list_tests / static_cast<double>(std::max<std::size_t>(primitives, 1))) + 1;
}

Contest::Contest(const Scene& scene, std::span<const Texture> textures, const Plan& plan, const Watch& watch)
    : scene_(scene),
      textures_(textures),
      plan_(plan),
      watch_(watch),
      executor_(plan.threads),
      alone_(1),
      reference_name_(reference_strategy)
{
    const auto make = [&](const Contestant& contestant, const Executor& executor) {
        return std::make_unique<Contender>(scene, textures, contestant, plan.options, executor);
    };
    reference_ = make(parse_contestant(reference_strategy), alone_);
    list_ = make(parse_contestant("list"), executor_);
    contenders_.resize(plan.contestants.size());
    for (const Contestant& contestant : plan.contestants) rows_.push_back({contestant, "", {}, {}, {}});
    for (std::size_t i = 0; i < rows_.size(); ++i) try {
            contenders_[i] = make(rows_[i].contestant, executor_);
        } catch (const std::exception& error) {
            rows_[i].fault = error.what();
        }
}

Sample Contest::sample_of(const RecordedRays& rays) const
{
    const std::size_t wanted = plan_.check_rays > 0 ? plan_.check_rays : default_check_rays(scene_.primitive_count());
    return {std::max<std::size_t>(1, (static_cast<std::size_t>(rays.kept()) + wanted - 1) / wanted)};
}

double Contest::work() const
{
    const auto frames = static_cast<double>(plan_.frames.size()), rows = static_cast<double>(rows_.size());
    return frames * (executor_.threads() + rows * (check_work + plan_.repeat * round_work));
}

void Contest::check()
{
    for (std::size_t f = 0; f < plan_.frames.size(); ++f) check_frame(f);
}

void Contest::check_frame(std::size_t f)
{
    const int frame = plan_.frames[f];
    watch_.step(fmt::format("frame {}: recording its rays", frame), executor_.threads());
    RecordedRays rays(std::min(most_rays_of_a_frame, most_rays_kept / plan_.frames.size()));
    Frame expected;
    FrameFacts facts{frame, reference_->record(frame, plan_.render, expected, rays).rays, {}, {}};
    for (std::size_t kind = 0; kind < ray_kinds; ++kind) {
        facts.asked[kind] = rays.asked(static_cast<RayKind>(kind));
        facts.kept[kind] = rays.kept(static_cast<RayKind>(kind));
    }
    const Sample sample = sample_of(rays);
    list_->update(frame);
    const Stopwatch list_watch;
    const std::vector<RayAnswer> truth = list_->sparse_answers(rays, sample);
    list_seconds_ += list_watch.seconds() * executor_.threads();
    list_rays_ += truth.size();
    for (std::size_t i = 0; i < rows_.size(); ++i)
        attempt(i, [&] {
            watch_.step(fmt::format("frame {}: checking {}", frame, rows_[i].contestant.name), check_work);
            Frame found;
            contenders_[i]->render(frame, plan_.render, found);
            rows_[i].errors.push_back(image_error(expected, found));
            rows_[i].hits += agreement(truth, contenders_[i]->answers(rays, sample));
        });
    rays_.push_back(std::move(rays));
    frames_.push_back(facts);
}

double Contest::list_ns_per_ray() const
{
    return list_rays_ == 0 ? 0.0 : 1e9 * list_seconds_ / static_cast<double>(list_rays_);
}

void Contest::measure()
{
    const auto rounds = static_cast<std::size_t>(plan_.repeat);
    for (std::size_t round = 0; round < rounds; ++round) {
        for (Row& row : rows_) row.rounds.emplace_back();
        for (std::size_t f = 0; f < plan_.frames.size(); ++f) measure_frame(f, round);
        complete_rounds_ = round + 1;
    }
}

void Contest::measure_frame(std::size_t f, std::size_t round)
{
    Frame picture;
    for (std::size_t turn = 0; turn < rows_.size(); ++turn) {
        const std::size_t i = (turn + round) % rows_.size();
        attempt(i, [&] {
            watch_.step(fmt::format("round {} of {}, frame {}: {}", round + 1, plan_.repeat, plan_.frames[f],
                                    rows_[i].contestant.name),
                        round_work);
            FrameSample sample{contenders_[i]->render(plan_.frames[f], plan_.render, picture), {}};
            const ByKind<double> seconds = contenders_[i]->replay(rays_[f]);
            for (std::size_t kind = 0; kind < ray_kinds; ++kind)
                if (frames_[f].kept[kind] > 0)
                    sample.ns_per_ray[kind] = 1e9 * seconds[kind] / static_cast<double>(frames_[f].kept[kind]);
            rows_[i].rounds.back().push_back(sample);
        });
    }
}

}  // namespace firstray::compare
