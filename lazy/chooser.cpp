#include "lazy/chooser.h"

#include <algorithm>

namespace firstray::inline v0::lazy {
namespace {

/// A thread looks at what the others counted each time its own count has grown by this part of what is waited for:
/// so many threads together wait at most so much too long, and hardly ever read each other's counters.
constexpr std::uint64_t looks = 8;

/// Places for the voxels of a top grid that is not there yet: more than it is likely to have cells.
std::uint32_t voxels_expected(std::uint64_t primitives)
{
    return static_cast<std::uint32_t>(primitives / 4 + 64);
}

}  // namespace

Chooser::Chooser(const Scene& scene, const Rule& rule, std::uint64_t one_voxel)
    : rule_(rule), forecast_(scene.groups.size()), before_(scene.groups.size()), counts_(2 * lay_out(scene, one_voxel))
{
}

/// Gives every group its places; returns how many there are.
std::size_t Chooser::lay_out(const Scene& scene, std::uint64_t one_voxel)
{
    auto next = static_cast<std::uint32_t>(scene.groups.size());
    for (std::uint32_t i = 0; i < scene.groups.size(); ++i) {
        const std::uint64_t primitives = scene.groups[i].primitives();
        const bool is_one_voxel = i > 0 && primitives <= one_voxel;
        groups_.push_back(group_alternatives(rule_.costs, primitives, is_one_voxel));
        voxels_.push_back({next, is_one_voxel ? 0 : voxels_expected(primitives)});
        next += voxels_.back().count;
    }
    return next;
}

bool Chooser::is_time_to_build(std::uint32_t place, std::uint64_t rays, const Alternatives& choice, double expected)
{
    std::uint64_t needed = rays_to_build(rule_, choice);
    if (needed == never) return false;
    needed -= std::min(needed, static_cast<std::uint64_t>(expected));
    // A forecast is believed as soon as there is one: what moves hardly changes what it shows from frame to frame, and
    // where a camera cuts, a build too many is what a wrong one costs, once.
    if (rule_.forecasts && place < forecast_.size() && forecast_[place] >= needed) return true;
    const std::uint64_t before = counts_.mine(2 * std::size_t{place}), now = before + rays;
    if (now >= needed) return true;
    const std::uint64_t step = needed / looks + 1;
    return now / step != before / step && listed(place) + rays >= needed;
}

void Chooser::begin_frame(std::uint32_t group, bool moved)
{
    const std::uint64_t all = rays(group);
    forecast_[group] = all - before_[group];
    before_[group] = moved ? 0 : all;
    if (!moved) return;
    const auto clear = [&](std::size_t place) {
        counts_.clear(2 * place);
        counts_.clear(2 * place + 1);
    };
    clear(group);
    for (std::size_t i = 0; i < voxels_[group].count; ++i) clear(voxels_[group].first + i);
}

bool Chooser::is_expected_to_pay(std::uint32_t group, const Alternatives& choice) const
{
    const std::uint64_t expected = rule_.forecasts ? forecast_[group] : 0;
    return rule_.choice == ListOrGrid::learned && listed(group) + expected >= rays_to_build(rule_, choice);
}

void Chooser::report(std::uint32_t place, const Alternatives& choice, bool is_built, ChoiceReport& report) const
{
    const std::uint64_t through_list = listed(place), through_grid = gridded(place);
    if (through_list + through_grid == 0)
        ++report.not_entered;
    else
        ++(is_built ? report.grids : report.lists);
    report.spent_ms += 1e-6 * spent(choice, through_list, through_grid, is_built);
    report.hindsight_ms += 1e-6 * least(choice, through_list + through_grid);
}

}  // namespace firstray::inline v0::lazy
