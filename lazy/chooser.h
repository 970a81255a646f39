#pragma once
#include <cstdint>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/strategy/strategy.h"
#include "lazy/entry_counts.h"
#include "lazy/rule.h"

namespace firstray::inline v0::lazy {

/// Chooses list or grid for every place: the scenery, each group that moves, the voxels of their top grids. Counts the
/// rays that come for that, those of a voxel until it is built: what is built is searched without a look at this.
class Chooser {
public:
    /// A range of places. More cells than places share some: their rays then count for each other, and a voxel may be
    /// built a little early; no answer depends on it.
    struct Range {
        std::uint32_t first = 0, count = 0;
        std::uint32_t of(std::uint32_t cell) const { return first + cell % count; }
    };

    /// one_voxel  a group of so many primitives, or fewer, is one voxel: what is in it is built with its grid
    Chooser(const Scene& scene, const Rule& rule, std::uint64_t one_voxel);

    const Rule& rule() const { return rule_; }

    /// Groups' places are their numbers; group 0 is the scenery. Behind them are those of voxels.
    Range voxels_of(std::uint32_t group) const { return voxels_[group]; }  ///< none: built with the group
    /// Of a group that moves; the scenery knows its own.
    const Alternatives& group(std::uint32_t group) const { return groups_[group]; }

    /// Sends rays into a place that is not built: has it built if the rule says so.
    /// expected rays that come besides, as far as one can tell from others
    /// make     builds it, or finds out that it cannot be, or that another thread is at it: then null
    /// returns  what make returns; null where the list is to be searched
    template <class Make>
    auto enter(std::uint32_t place, std::uint64_t rays, const Alternatives& choice, double expected, const Make& make)
        -> decltype(make())
    {
        if (!is_time_to_build(place, rays, choice, expected)) {
            count_listed(place, rays);
            return nullptr;
        }
        const auto made = make();
        made ? count_gridded(place, rays) : count_listed(place, rays);
        return made;
    }
    /// Whether the rays at hand are to have a place built; they are not counted yet.
    bool is_time_to_build(std::uint32_t place, std::uint64_t rays, const Alternatives& choice, double expected);
    void count_gridded(std::uint32_t place, std::uint64_t rays) { counts_.add(2 * std::size_t{place} + 1, rays); }

    /// What a voxel of the scenery can expect when it knows nothing of itself: as many rays as the others have had.
    /// voxels  there are
    double expected_in_voxel(double voxels)
    {
        const auto seen = static_cast<double>(counts_.mine(0) + counts_.mine(1));  // others' count too, but not here
        return rule_.forecasts ? seen * voxels_met / voxels : 0.0;
    }

    /// Between frames: what a group's rays were in the last frame is what is expected in the next.
    /// moved  the group's grid is given up: what its rays did so far counts no longer. What stands keeps its grids, so
    ///        that there rays of all frames have a say
    void begin_frame(std::uint32_t group, bool moved);
    /// Between frames: whether the rays that came, and those that are expected, would have a group built.
    bool is_expected_to_pay(std::uint32_t group, const Alternatives& choice) const;

    std::uint64_t rays(std::uint32_t place) const { return listed(place) + gridded(place); }
    /// Adds a place to the report.
    void report(std::uint32_t place, const Alternatives& choice, bool is_built, ChoiceReport& report) const;
    std::uint64_t bytes() const { return counts_.bytes(); }

private:
    std::size_t lay_out(const Scene& scene, std::uint64_t one_voxel);
    void count_listed(std::uint32_t place, std::uint64_t rays) { counts_.add(2 * std::size_t{place}, rays); }
    std::uint64_t listed(std::uint32_t place) const { return counts_.total(2 * std::size_t{place}); }
    std::uint64_t gridded(std::uint32_t place) const { return counts_.total(2 * std::size_t{place} + 1); }

    Rule rule_;
    std::vector<Alternatives> groups_;
    std::vector<Range> voxels_;                     ///< by group
    std::vector<std::uint64_t> forecast_, before_;  ///< by group: rays of the last frame; of all before it
    EntryCounts counts_;                            ///< by place: through the list, through the grid
};

}  // namespace firstray::inline v0::lazy
