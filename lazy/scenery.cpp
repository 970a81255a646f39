#include "lazy/scenery.h"

#include <algorithm>
#include <chrono>
#include <new>

#include "engine/strategy/group_bounds.h"

namespace firstray::inline v0::lazy {
namespace {

/// A little more than the largest coordinate, for what is rounded to float.
double largest_of(const DAabb& scenery, const Aabb& movers)
{
    return std::max(largest_coordinate(scenery), static_cast<double>(largest_coordinate(movers))) * (1.0 + 1e-6);
}

/// What is built of scenery stays as it is, however many frames come, and may take time to become better; but not where
/// rays are weighed against building, since they may be few.
GridOptions shape_for(bool is_weighed, GridOptions shape)
{
    if (!is_weighed) shape.order = PackOrder::by_surface;
    return shape;
}

}  // namespace

template <typename Real>
Scenery<Real>::Scenery(const Scene& scene, const RootGeometry<Real>& geometry, std::span<const DAabb> bounds,
                       const GridOptions& options, Ledger& ledger, Chooser* chooser)
    : geometry_(geometry),
      movers_(room_of_movers(scene, bounds)),
      largest_(scene.groups[0].primitives() == 0 ? 0.0 : largest_of(bounds[0], movers_)),
      options_(shape_for(chooser != nullptr, options)),
      ledger_(ledger),
      chooser_(chooser),
      primitives_(scene.groups[0].primitives())
{
}

template <typename Real>
std::uint64_t Scenery<Real>::update(const Executor* executor)
{
    if (made()) flat_list_.structure = {};
    if (is_empty() || made()) return 0;
    made_.forget_refusal();
    const bool is_listed = !flat_list_.structure.lists.empty();
    if (!chooser_ || (is_listed && chooser_->is_expected_to_pay(0, alternatives()))) {
        made_.get_or_make([&] { return make(executor); });
        return primitives_;
    }
    if (!is_listed) {
        PrimitiveList primitives;
        geometry_.touch(0);
        geometry_.list(0, primitives);
        flat_list_ = make_flat_list(geometry_, primitives);
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
    return chooser_->enter(0, rays, alternatives(), 0.0,
                           [&] { return made_.get_or_make([&] { return make_for_rays(); }); });
}

/// As make(), under a claim: so that nothing may be thrown and no task spawned. The budget does not forbid it, as it
/// does not forbid an update: both make the top grid once.
template <typename Real>
std::unique_ptr<typename Scenery<Real>::Made> Scenery<Real>::make_for_rays() const
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    try {
        auto made = make(nullptr);
        ledger_.note_built(static_cast<std::uint64_t>((Clock::now() - start).count()));
        return made;
    } catch (const std::bad_alloc&) {
        ledger_.note_refused();
        return nullptr;  // the flat list is searched instead
    }
}

template <typename Real>
Alternatives Scenery<Real>::alternatives() const
{
    return scenery_alternatives(chooser_->rule().costs, primitives_, flat_list_.packs_met);
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
    return outer(made()).bytes() + (made() ? made()->grid.bytes() + made()->around.bytes() : 0) +
           flat_list_.structure.bytes();
}

template class Scenery<float>;
template class Scenery<double>;

}  // namespace firstray::inline v0::lazy
