#include "lazy/scenery.h"

#include <chrono>
#include <new>

#include "engine/strategy/group_bounds.h"

namespace firstray::lazy {
namespace {

/// What a top grid may hold for each primitive: its box, its vertices, and where it is listed.
constexpr std::uint64_t guessed_bytes = sizeof(Aabb) + sizeof(RootTriangle<float>) + 16;

}  // namespace

template <typename Real>
Scenery<Real>::Scenery(const Scene& scene, const RootGeometry<Real>& geometry, std::span<const DAabb> bounds,
                       const GridOptions& options, Ledger& ledger, Chooser* chooser)
    : scene_(scene),
      geometry_(geometry),
      bounds_(bounds),
      options_(options),
      ledger_(ledger),
      chooser_(chooser),
      primitives_(scene.groups[0].primitives())
{
}

template <typename Real>
std::uint64_t Scenery<Real>::update(const Executor* executor)
{
    if (made()) listed_ = {};
    if (is_empty() || made()) return 0;
    made_.forget_refusal();
    if (!chooser_ || chooser_->is_expected_to_pay(0)) {
        made_.get_or_make([&] { return make(executor); });
        return primitives_;
    }
    if (listed_.size() == 0) {
        geometry_.touch(0);
        geometry_.list(0, listed_);
    }
    return 0;
}

template <typename Real>
const typename Scenery<Real>::Made* Scenery<Real>::enter(std::uint64_t rays) const
{
    if (is_empty()) return nullptr;
    const Made* const there = made();
    if (!there)
        return chooser_->enter(0, rays, chooser_->group(0),
                               [&] { return made_.get_or_make([&] { return make_for_rays(); }); });
    if (chooser_) chooser_->count_gridded(0, rays);
    return there;
}

/// As make(), under a claim: so that nothing may be thrown, no task spawned, and no byte too many held.
template <typename Real>
std::unique_ptr<typename Scenery<Real>::Made> Scenery<Real>::make_for_rays() const
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t guess = primitives_ * guessed_bytes;
    if (!ledger_.charge(guess)) return nullptr;
    ledger_.give_back(guess);  // it is not counted among what is lazy, like one that an update makes
    try {
        auto fresh = make(nullptr);
        ledger_.note_built(static_cast<std::uint64_t>((Clock::now() - start).count()));
        return fresh;
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

template <typename Real>
std::unique_ptr<typename Scenery<Real>::Made> Scenery<Real>::make(const Executor* executor) const
{
    const VoxelChoice choice = chooser_ ? VoxelChoice{chooser_, chooser_->voxels_of(0)} : VoxelChoice{};
    auto fresh =
        std::unique_ptr<Made>(new Made{LazyGrid(scenery_entries(geometry_, room_of_movers(scene_, bounds_), executor),
                                                options_, ledger_, executor, choice),
                                       {}});
    fresh->around.structure = fresh->grid.top();
    return fresh;
}

template class Scenery<float>;
template class Scenery<double>;

}  // namespace firstray::lazy
