#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/precision.h"
#include "engine/core/ray_tile.h"
#include "engine/scene/pose.h"
#include "engine/strategy/outline.h"

namespace firstray::inline v0 {

/// What a strategy that chooses between lists and grids, place by place, has chosen; what that took by its own model,
/// and what the best choice in hindsight would have. A place counts from when it came to be: what moves, since the
/// update; what stands, since the first.
struct ChoiceReport {
    bool is_made = false;                                 ///< the strategy chooses
    std::uint64_t lists = 0, grids = 0, not_entered = 0;  ///< places
    double spent_ms = 0.0, hindsight_ms = 0.0;            ///< summed over threads

    double ratio() const { return hindsight_ms > 0.0 ? spent_ms / hindsight_ms : 1.0; }  ///< 1 is best
};

/// What a structure consists of and what it took. Counts are totals after update, lazily built parts included.
struct StructureReport {
    std::uint64_t grids = 0;           ///< top grids and supergrids
    std::uint64_t subgrids = 0;        ///< grids inside voxels
    std::uint64_t voxels = 0;          ///< cells of all grids
    std::uint64_t filled_voxels = 0;   ///< those that list something
    std::uint64_t built_voxels = 0;    ///< lazy: of the filled ones of top grids, those that a ray has had built by now
    std::uint64_t kept_voxels = 0;     ///< lazy: of those, built in earlier frames
    std::uint64_t dropped_voxels = 0;  ///< lazy: given up by the last update, because what is in them moved
    std::uint64_t refused_builds = 0;  ///< lazy: for want of budget or memory, since update; obb: boxes without a grid for that
    std::uint64_t references = 0;      ///< listings of primitives in voxels
    std::uint64_t primitives = 0;      ///< visible ones, each once
    std::uint64_t bytes = 0;           ///< held now, vertices in the root system included
    std::uint64_t peak_bytes = 0;      ///< most held at once since the strategy was made, building included
    std::uint64_t depth = 0;           ///< levels of grids, 1 without subgrids
    std::uint64_t largest_list = 0;    ///< primitives in one voxel
    std::uint64_t regridded = 0;       ///< primitives that the last update put into grids
    double lazy_build_ms = 0.0;        ///< spent building while rays flew, summed over threads, since update
    ChoiceReport choices;              ///< between lists and grids
};

/// A way to find hits in an animated scene. update() runs alone; between two updates any number of threads may search.
/// Real is float for the precisions fast and robust, double for double_.
///
/// A hit is the smallest (t, group, primitive) among all hits with t in (t_min, t_max) on visible primitives that the
/// tile's mask admits. All strategies of one precision find the same hit, bit for bit.
template <typename Real>
class Strategy {
public:
    virtual ~Strategy() = default;
    /// Brings the structure to a pose of the scene that the strategy was made for. The pose must live until the next
    /// update.
    virtual void update(const Pose& pose) = 0;
    /// Finds each ray's nearest hit: t_max, primitive, u, v are set; t_max stays where nothing is hit.
    virtual void closest(RayTile<Real>& rays) const = 0;
    /// Finds out whether each ray meets anything: primitive is set to one that it meets, or no_primitive.
    virtual void occluded(RayTile<Real>& rays) const = 0;
    virtual StructureReport report() const = 0;  ///< as things are now
    /// The boxes and grids as they stand since the last update, outer before inner; none where there is nothing to
    /// show.
    virtual std::vector<StructureBox> outline() const { return {}; }
};

/// What the user chooses about structures; each field has a flag of the command.
struct StrategyOptions {
    Precision precision = Precision::robust;  ///< of the test
    float grid_density = 0.0f;                ///< cells of the top grid per primitive, > 0; 0 means the default
    int max_list = 0;                    ///< primitives in a voxel above which it gets a subgrid, >= 1; 0: the default
    std::uint64_t structure_budget = 0;  ///< bytes that may be built while rays fly, and held; 0: no limit
    int grid_depth = 3;                  ///< levels of grids, >= 1; 1 means no subgrids
    std::vector<std::pair<std::string, std::string>> own{};  ///< what one strategy alone knows: flag, e.g. "obb-top",
                                                             ///< and word
    const Executor* executor = nullptr;  ///< runs updates; must outlive the strategy; null: one thread
};

}  // namespace firstray::inline v0
