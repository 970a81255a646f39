#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bench/measure/recorded_rays.h"
#include "engine/core/executor.h"

namespace firstray::compare {

/// What a strategy says of a ray.
struct RayAnswer {
    double t = std::numeric_limits<double>::infinity();  ///< of the nearest hit; infinity for a miss, 0 where only
                                                         ///< whether was asked
    PrimitiveId primitive = no_primitive;                ///< likewise, 0
    RayKind kind = RayKind::primary;
};

/// Which lanes of the recorded batches are looked at: every step-th ray of all. Rays that follow light from one
/// transmitting surface to the next are left out: they begin exactly where the recorded strategy met the last one,
/// which another arithmetic may meet again, a rounding later. A renderer would have gone on from its own hit.
struct Sample {
    std::size_t step = 1;

    /// The batch's size where none is.
    std::size_t first_lane(const RecordedRays::Batch& batch) const
    {
        const bool goes_on_behind_a_hit = batch.kind == RayKind::shadow && batch.query == RayQuery::closest;
        return goes_on_behind_a_hit ? batch.count : (step - batch.first % step) % step;
    }
};

/// The sample's answers in their order. Whole batches are searched, as when a picture is rendered.
template <typename Real>
std::vector<RayAnswer> answers(const Strategy<Real>& strategy, const RecordedRays& rays, Sample sample,
                               const Executor& executor);

/// The same, but only the sample is searched: for a strategy that is slow, and for which it makes no difference.
template <typename Real>
std::vector<RayAnswer> sparse_answers(const Strategy<Real>& strategy, const RecordedRays& rays, Sample sample,
                                      const Executor& executor);

/// How a strategy's answers differ from the right ones.
struct HitAgreement {
    std::uint64_t rays = 0, hits = 0;  ///< compared; of those, that should have hit
    std::uint64_t missed = 0;          ///< should have hit
    std::uint64_t invented = 0;        ///< should have missed
    std::uint64_t moved = 0;           ///< hit, but at a t that is off by more than 1e-3 of it
    std::uint64_t unlike = 0;          ///< anything not the same to the last bit, the primitive included
    ByKind<std::uint64_t> wrong{};     ///< missed or invented, by the kind of ray
    std::vector<double> t_errors;      ///< relative, of rays that hit and should have

    double per_million(std::uint64_t count) const;
    HitAgreement& operator+=(const HitAgreement& other);
};

/// expected, found  as many
HitAgreement agreement(std::span<const RayAnswer> expected, std::span<const RayAnswer> found);

}  // namespace firstray::compare
