#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// For each ray of a tile, the pixel (an index below RayTile::capacity) that it works for.
using Slots = std::array<std::uint16_t, RayTile<float>::capacity>;

/// Searches, and where it is asked to, books what each ray costs to the ray's pixel.
template <typename Real>
class MeteredSearch {
public:
    MeteredSearch(const Strategy<Real>& strategy, bool metered)
        : strategy_(strategy), per_ray_(metered ? RayTile<Real>::capacity : 0), per_slot_(per_ray_.size())
    {
    }

    void closest(RayTile<Real>& rays, const Slots& slots)
    {
        run(rays, slots, [&] { strategy_.closest(rays); });
    }
    void occluded(RayTile<Real>& rays, const Slots& slots)
    {
        run(rays, slots, [&] { strategy_.occluded(rays); });
    }

    /// Costs by slot since `reset`; empty where nothing is metered.
    const std::vector<RayCost>& costs() const { return per_slot_; }
    void reset() { std::fill(per_slot_.begin(), per_slot_.end(), RayCost{}); }

private:
    template <typename Search>
    void run(RayTile<Real>& rays, const Slots& slots, const Search& search)
    {
        if (per_ray_.empty()) return search();
        std::fill_n(per_ray_.begin(), rays.count, RayCost{});
        rays.cost = per_ray_.data();
        search();
        for (std::size_t i = 0; i < static_cast<std::size_t>(rays.count); ++i) {
            RayCost& sum = per_slot_[slots[i]];
            sum.cells += per_ray_[i].cells;
            sum.tests += per_ray_[i].tests;
            sum.nanoseconds += per_ray_[i].nanoseconds;
        }
    }

    const Strategy<Real>& strategy_;
    std::vector<RayCost> per_ray_, per_slot_;
};

}  // namespace firstray::inline v0
