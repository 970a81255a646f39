#include "bench/measure/recorded_rays.h"

#include <cmath>

namespace firstray {

const char* name_of(RayKind kind)
{
    constexpr ByKind<const char*> names = {"primary", "shadow", "secondary"};
    return at(names, kind);
}

template <typename Real>
void RecordedRays::add(RayKind kind, RayQuery query, const RayTile<Real>& tile)
{
    if (tile.count == 0) return;
    const auto count = static_cast<std::size_t>(tile.count);
    const std::uint64_t number = at(batches_seen_, kind)++;
    at(asked_, kind) += count;
    if (number % step_ != 0) return;
    batches_.push_back({kind, query, tile.mask, tile.common_apex, glm::vec3(tile.apex), rays_.size(), count});
    number_.push_back(number);
    for (int i = 0; i < tile.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        const glm::vec3 origin = tile.common_apex ? glm::vec3(0.0f) : glm::vec3(tile.origin_of(i));
        rays_.push_back({origin, glm::vec3(tile.direction_of(i)), static_cast<float>(tile.t_min[lane]),
                         static_cast<float>(tile.t_max[lane])});
    }
    if (rays_.size() > most_rays_ && batches_.size() > ray_kinds) thin();
}

void RecordedRays::thin()
{
    step_ *= 2;
    std::size_t kept = 0, end = 0;
    for (std::size_t b = 0; b < batches_.size(); ++b) {
        if (number_[b] % step_ != 0) continue;
        Batch batch = batches_[b];
        for (std::size_t i = 0; i < batch.count; ++i) rays_[end + i] = rays_[batch.first + i];
        batch.first = end;
        end += batch.count;
        number_[kept] = number_[b];
        batches_[kept++] = batch;
    }
    batches_.resize(kept);
    number_.resize(kept);
    rays_.resize(end);
}

std::uint64_t RecordedRays::kept(RayKind kind) const
{
    std::uint64_t rays = 0;
    for (const Batch& batch : batches_)
        if (batch.kind == kind) rays += batch.count;
    return rays;
}

template <typename Real>
void RecordedRays::load(const Batch& batch, RayTile<Real>& tile, std::size_t first, std::size_t step) const
{
    using Vec = typename RayTile<Real>::Vec;
    tile.count = 0;
    tile.cost = nullptr;
    tile.common_apex = batch.common_apex;
    tile.apex = Vec(batch.apex);
    tile.mask = batch.mask;
    for (std::size_t i = first; i < batch.count; i += step) {
        const Ray& ray = rays_[batch.first + i];
        tile.set_origin(tile.count, Vec(ray.origin));
        tile.set_direction(tile.count, Vec(ray.direction));
        tile.set_interval(tile.count++, static_cast<Real>(ray.t_min), static_cast<Real>(ray.t_max));
    }
}

template <typename Real>
void RayRecorder<Real>::write_down(RayKind kind, RayQuery query, const RayTile<Real>& tile) const
{
    const std::lock_guard lock(mutex_);
    if (rays_) rays_->add(kind, query, tile);
}

template <typename Real>
void RayRecorder<Real>::update(const Pose& pose)
{
    eye_ = typename RayTile<Real>::Vec(pose.camera.eye);
    asked_.update(pose);
}

/// Rays that go straight through surfaces come from the eye too, but their directions are as long as the way there.
template <typename Real>
bool RayRecorder<Real>::is_primary(const RayTile<Real>& tile) const
{
    constexpr Real rounding = Real(1e-5);
    return tile.common_apex && tile.apex == eye_ && tile.count > 0 &&
           std::abs(glm::length(tile.direction_of(0)) - 1) < rounding;
}

template <typename Real>
void RayRecorder<Real>::closest(RayTile<Real>& tile) const
{
    const RayKind kind = tile.mask == RayMask::transmitting ? RayKind::shadow
                         : is_primary(tile)                 ? RayKind::primary
                                                            : RayKind::secondary;
    write_down(kind, RayQuery::closest, tile);
    asked_.closest(tile);
}

template <typename Real>
void RayRecorder<Real>::occluded(RayTile<Real>& tile) const
{
    write_down(RayKind::shadow, RayQuery::occluded, tile);
    asked_.occluded(tile);
}

template void RecordedRays::add<float>(RayKind, RayQuery, const RayTile<float>&);
template void RecordedRays::add<double>(RayKind, RayQuery, const RayTile<double>&);
template void RecordedRays::load<float>(const Batch&, RayTile<float>&, std::size_t, std::size_t) const;
template void RecordedRays::load<double>(const Batch&, RayTile<double>&, std::size_t, std::size_t) const;
template class RayRecorder<float>;
template class RayRecorder<double>;

}  // namespace firstray
