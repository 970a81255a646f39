#include "lazy/group_grids.h"

#include <chrono>
#include <new>

namespace firstray::inline v0::lazy {
namespace {

/// What a group's entries and top grid may hold, guessed before they are made.
std::uint64_t guessed_bytes(std::size_t primitives)
{
    return primitives * 16 + sizeof(LazyGrid) + 1024;
}

}  // namespace

template <typename Real>
GroupGrids<Real>::GroupGrids(const Scene& scene, const RootGeometry<Real>& geometry, const GridOptions& options,
                             Ledger& ledger, Chooser* chooser)
    : scene_(scene),
      geometry_(geometry),
      options_(options),
      ledger_(ledger),
      chooser_(chooser),
      grids_(std::make_unique<MadeOnce<LazyGrid>[]>(scene.groups.size()))
{
}

template <typename Real>
GroupGrids<Real>::~GroupGrids()
{
    for (std::uint32_t group = 0; group < scene_.groups.size(); ++group) drop(group);
}

template <typename Real>
const LazyGrid* GroupGrids<Real>::enter_first(std::uint32_t group, std::uint64_t rays) const
{
    const auto make_one = [&]() -> const LazyGrid* {
        if (!carry(group)) return nullptr;
        return grids_[group].get_or_make([&] { return make(group); });
    };
    if (!chooser_) return make_one();
    const LazyGrid* const made = chooser_->enter(group, rays, chooser_->group(group), 0.0, make_one);
    if (!made && is_carried_first(chooser_->rule().costs)) carry(group);
    return made;
}

/// Whether a group is carried now; not while another thread is at it, or where there is no memory for it.
template <typename Real>
bool GroupGrids<Real>::carry(std::uint32_t group) const
{
    try {
        return geometry_.touch(group);
    } catch (const std::bad_alloc&) {
        ledger_.note_refused();
        return false;
    }
}

/// Of a group that is carried.
template <typename Real>
std::unique_ptr<LazyGrid> GroupGrids<Real>::make(std::uint32_t group) const
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t guess = guessed_bytes(scene_.groups[group].primitives());
    if (!ledger_.charge(guess)) return nullptr;
    std::unique_ptr<LazyGrid> made;
    try {
        PrimitiveList primitives;
        geometry_.list(group, primitives);
        made = std::make_unique<LazyGrid>(make_entries(geometry_, primitives, nullptr), shape_of(primitives.size()),
                                          ledger_, nullptr, choice_in(group));
    } catch (const std::bad_alloc&) {
        ledger_.note_refused();
        ledger_.give_back(guess);
        return nullptr;
    }
    ledger_.correct(guess, made->bytes());
    ledger_.note_built(static_cast<std::uint64_t>((Clock::now() - start).count()));
    return made;
}

template <typename Real>
std::uint64_t GroupGrids<Real>::gather(const PrimitiveList& primitives, const Aabb& room, const Executor* executor)
{
    gathered_ = true;
    MadeOnce<LazyGrid>& place = grids_[everything_that_moves];
    const std::unique_ptr<LazyGrid> old = place.take();
    GridEntries entries = make_entries(geometry_, primitives, executor);
    entries.room = room;
    auto grid = std::make_unique<LazyGrid>(std::move(entries), options_, ledger_, executor);
    ledger_.correct(0, grid->bytes());
    std::uint64_t renewed = 0;
    if (old) {
        renewed = grid->adopt(*old, [&](PrimitiveId id) { return !geometry_.has_moved(scene_.part(id).group); });
        ledger_.give_back(old->bytes());
    }
    place.put(std::move(grid));
    return renewed;
}

/// What is in the only voxel of a group is built with its grid.
template <typename Real>
VoxelChoice GroupGrids<Real>::choice_in(std::uint32_t group) const
{
    if (!chooser_ || chooser_->voxels_of(group).count == 0) return {};
    return {chooser_, chooser_->voxels_of(group), false};
}

/// A group that would not be split as a voxel is one voxel: its packs have boxes, which are grid enough.
template <typename Real>
GridOptions GroupGrids<Real>::shape_of(std::size_t primitives) const
{
    GridOptions shape = options_;
    if (primitives <= static_cast<std::size_t>(shape.max_list)) shape.density = 1e-30f;
    return shape;
}

template <typename Real>
std::uint64_t GroupGrids<Real>::keep(std::uint32_t group)
{
    grids_[group].forget_refusal();
    LazyGrid* grid = grids_[group].get_alone();
    return grid ? grid->keep() : 0;
}

template <typename Real>
std::uint64_t GroupGrids<Real>::drop(std::uint32_t group)
{
    const std::unique_ptr<LazyGrid> taken = grids_[group].take();
    if (!taken) return 0;
    ledger_.give_back(taken->bytes());
    return taken->counts().built;
}

template class GroupGrids<float>;
template class GroupGrids<double>;

}  // namespace firstray::inline v0::lazy
