#include "lazy/scenery.h"

#include <algorithm>
#include <chrono>
#include <new>

#include "engine/strategy/group_bounds.h"

namespace firstray::lazy {
namespace {

/// What a top grid may hold for each primitive: its box, its vertices, and where it is listed.
constexpr std::uint64_t guessed_bytes = sizeof(Aabb) + sizeof(RootTriangle<float>) + 16;

/// A little more than the largest coordinate, for what is rounded to float.
double largest_of(const DAabb& scenery, const Aabb& movers)
{
    double largest = 0.0;
    if (!scenery.empty()) largest = largest_coordinate(scenery);
    if (!movers.empty()) largest = std::max(largest, static_cast<double>(largest_coordinate(movers)));
    return largest * (1.0 + 1e-6);
}

}  // namespace

template <typename Real>
Scenery<Real>::Scenery(const Scene& scene, const RootGeometry<Real>& geometry, std::span<const DAabb> bounds,
                       const GridOptions& options, Ledger& ledger, Chooser* chooser)
    : scene_(scene),
      geometry_(geometry),
      movers_(room_of_movers(scene, bounds)),
      largest_(scene.groups[0].primitives() == 0 ? 0.0 : largest_of(bounds[0], movers_)),
      options_(options),
      ledger_(ledger),
      chooser_(chooser),
      primitives_(scene.groups[0].primitives())
{
}

template <typename Real>
std::uint64_t Scenery<Real>::update(const Executor* executor)
{
    if (made()) {
        if (const FlatList* flat = flat_list_.get()) packs_met_ = flat->packs_met;
        flat_list_.take();
        listed_ = {};
    }
    if (is_empty() || made()) return 0;
    made_.forget_refusal();
    flat_list_.forget_refusal();
    if (!chooser_ || chooser_->is_expected_to_pay(0, alternatives())) {
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
void Scenery<Real>::place(std::vector<Item> items)
{
    items_ = std::move(items);
    if (Made* made = made_.get_alone())
        made->outer = place_items(&made->around, items_, false);
    else
        outer_ = place_items(nullptr, items_, false);  // or with the grid, by who makes it
}

template <typename Real>
const typename Scenery<Real>::Made* Scenery<Real>::enter(std::uint64_t rays) const
{
    if (is_empty()) return nullptr;
    const Made* const there = made();
    if (there) {
        if (chooser_) chooser_->count_gridded(0, rays);
        return there;
    }
    // How long rays take in the flat list is known when it is there. That it is not worth making can be known before.
    if (!chooser_->is_time_to_build(0, rays, alternatives(), 0.0)) flat_list();
    return chooser_->enter(0, rays, alternatives(), 0.0, [&] {
        return made_.get_or_make([&] { return while_rays_fly([&] { return make(nullptr); }); });
    });
}

/// Makes something under a claim: nothing may be thrown, no task spawned, and no byte too many held.
template <typename Real>
template <class Make>
auto Scenery<Real>::while_rays_fly(const Make& make) const -> decltype(make())
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t guess = primitives_ * guessed_bytes;
    if (!ledger_.charge(guess)) return nullptr;
    ledger_.give_back(guess);  // it is not counted among what is lazy, like what an update makes
    try {
        auto made = make();
        ledger_.note_built(static_cast<std::uint64_t>((Clock::now() - start).count()));
        return made;
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

template <typename Real>
const GridStructure* Scenery<Real>::flat_list() const
{
    const FlatList* const made = flat_list_.get_or_make(
        [&] { return while_rays_fly([&] { return std::make_unique<FlatList>(make_flat_list(geometry_, listed_)); }); });
    return made ? &made->structure : nullptr;
}

template <typename Real>
Alternatives Scenery<Real>::alternatives() const
{
    const FlatList* const flat = flat_list_.get();
    return scenery_alternatives(chooser_->rule().costs, primitives_, flat ? flat->packs_met : packs_met_);
}

template <typename Real>
std::unique_ptr<typename Scenery<Real>::Made> Scenery<Real>::make(const Executor* executor) const
{
    const VoxelChoice choice = chooser_ ? VoxelChoice{chooser_, chooser_->voxels_of(0), true} : VoxelChoice{};
    auto fresh = std::unique_ptr<Made>(
        new Made{LazyGrid(scenery_entries(geometry_, movers_, executor), options_, ledger_, executor, choice), {}});
    fresh->around.structure = fresh->grid.top();
    fresh->outer = place_items(&fresh->around, items_, false);
    return fresh;
}

template <typename Real>
std::uint64_t Scenery<Real>::bytes() const
{
    const FlatList* const flat = flat_list_.get();
    return outer(made()).bytes() + (made() ? made()->grid.bytes() + made()->around.bytes() : 0) +
           (flat ? flat->structure.bytes() : 0);
}

template class Scenery<float>;
template class Scenery<double>;

}  // namespace firstray::lazy
