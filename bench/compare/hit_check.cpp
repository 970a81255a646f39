#include "bench/compare/hit_check.h"

#include <cmath>
#include <memory>

namespace firstray::compare {
namespace {

constexpr double tolerance = 1e-3;  // of t

template <typename Real>
RayAnswer answer_of(const RayTile<Real>& tile, std::size_t lane, const RecordedRays::Batch& batch)
{
    RayAnswer answer;
    answer.kind = batch.kind;
    if (tile.primitive[lane] == no_primitive) return answer;
    const bool has_place = batch.query == RayQuery::closest;
    answer.t = has_place ? static_cast<double>(tile.t_max[lane]) : 0.0;
    answer.primitive = has_place ? tile.primitive[lane] : 0;
    return answer;
}

template <typename Real>
void search(const Strategy<Real>& strategy, RayQuery query, RayTile<Real>& tile)
{
    if (query == RayQuery::closest)
        strategy.closest(tile);
    else
        strategy.occluded(tile);
}

/// By batch: where its part of the sample begins; one entry more than batches.
std::vector<std::size_t> sample_starts(const RecordedRays& rays, Sample sample)
{
    std::vector<std::size_t> starts{0};
    for (const RecordedRays::Batch& batch : rays.batches()) {
        const std::size_t first = sample.first_lane(batch);
        const std::size_t count = first < batch.count ? (batch.count - first - 1) / sample.step + 1 : 0;
        starts.push_back(starts.back() + count);
    }
    return starts;
}

/// load_first, load_step  which lanes of a batch are searched
/// keep_first, keep_step  and of these, whose answers are kept
template <typename Real, typename Lanes>
std::vector<RayAnswer> collect(const Strategy<Real>& strategy, const RecordedRays& rays, Sample sample,
                               const Executor& executor, const Lanes& lanes)
{
    const std::vector<std::size_t> starts = sample_starts(rays, sample);
    std::vector<RayAnswer> found(starts.back());
    executor.for_each(rays.batches().size(), [&](std::size_t b) {
        if (starts[b] == starts[b + 1]) return;
        const RecordedRays::Batch& batch = rays.batches()[b];
        const auto tile = std::make_unique<RayTile<Real>>();
        const auto [load_first, load_step, keep_first, keep_step] = lanes(batch);
        rays.load(batch, *tile, load_first, load_step);
        search(strategy, batch.query, *tile);
        std::size_t lane = keep_first;
        for (std::size_t i = starts[b]; i < starts[b + 1]; ++i, lane += keep_step)
            found[i] = answer_of(*tile, lane, batch);
    });
    return found;
}

struct Lanes {
    std::size_t load_first, load_step, keep_first, keep_step;
};

}  // namespace

template <typename Real>
std::vector<RayAnswer> answers(const Strategy<Real>& strategy, const RecordedRays& rays, Sample sample,
                               const Executor& executor)
{
    return collect(strategy, rays, sample, executor, [&](const RecordedRays::Batch& batch) {
        return Lanes{0, 1, sample.first_lane(batch), sample.step};
    });
}

template <typename Real>
std::vector<RayAnswer> sparse_answers(const Strategy<Real>& strategy, const RecordedRays& rays, Sample sample,
                                      const Executor& executor)
{
    return collect(strategy, rays, sample, executor, [&](const RecordedRays::Batch& batch) {
        return Lanes{sample.first_lane(batch), sample.step, 0, 1};
    });
}

double HitAgreement::per_million(std::uint64_t count) const
{
    return rays == 0 ? 0.0 : 1e6 * static_cast<double>(count) / static_cast<double>(rays);
}

HitAgreement& HitAgreement::operator+=(const HitAgreement& other)
{
    rays += other.rays;
    hits += other.hits;
    missed += other.missed;
    invented += other.invented;
    moved += other.moved;
    unlike += other.unlike;
    for (std::size_t kind = 0; kind < ray_kinds; ++kind) wrong[kind] += other.wrong[kind];
    t_errors.insert(t_errors.end(), other.t_errors.begin(), other.t_errors.end());
    return *this;
}

HitAgreement agreement(std::span<const RayAnswer> expected, std::span<const RayAnswer> found)
{
    HitAgreement sum;
    sum.rays = expected.size();
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const bool should_hit = std::isfinite(expected[i].t), hit = std::isfinite(found[i].t);
        sum.hits += should_hit;
        sum.missed += should_hit && !hit;
        sum.invented += hit && !should_hit;
        at(sum.wrong, expected[i].kind) += should_hit != hit;
        sum.unlike += expected[i].t != found[i].t || expected[i].primitive != found[i].primitive;
        if (!should_hit || !hit) continue;
        const double off = std::abs(found[i].t - expected[i].t);
        const double error = off == 0.0 ? 0.0 : off / std::abs(expected[i].t);
        sum.moved += error > tolerance;
        sum.t_errors.push_back(error);
    }
    return sum;
}

template std::vector<RayAnswer> answers<float>(const Strategy<float>&, const RecordedRays&, Sample, const Executor&);
template std::vector<RayAnswer> answers<double>(const Strategy<double>&, const RecordedRays&, Sample, const Executor&);
template std::vector<RayAnswer> sparse_answers<float>(const Strategy<float>&, const RecordedRays&, Sample,
                                                      const Executor&);
template std::vector<RayAnswer> sparse_answers<double>(const Strategy<double>&, const RecordedRays&, Sample,
                                                       const Executor&);

}  // namespace firstray::compare
