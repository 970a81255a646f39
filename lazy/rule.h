#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace firstray::inline v0::lazy {

/// What searching and building take on a machine, nanoseconds. calibrate.h measures them.
struct Costs {
    double test = 12.0;        ///< a ray against a primitive of a list, carried
    double test_alone = 60.0;  ///< the same where the group is not carried
    double pack = 8.0;         ///< a ray against a pack of sixteen triangles, or sixteen boxes
    double entry = 60.0;       ///< sending a ray into the grid of a group
    double packing = 20.0;     ///< putting a carried primitive into a flat list
    double carrying = 15.0;    ///< carrying a primitive into the root system
    double listing = 80.0;     ///< putting a carried primitive into a top grid
    double building = 100.0;   ///< putting a primitive that a voxel lists into what is built of it
    double making = 1500.0;    ///< making a grid or a voxel, however small
};

/// A cost as people name it.
struct CostName {
    std::string_view name, meaning;  ///< for people
    double Costs::*cost;             ///< which it is
};
std::span<const CostName> cost_names();  ///< of all of Costs

/// Costs with some replaced: "test=10,pack=7.5".
/// throws  std::invalid_argument for a name that is none or a cost that is not a number > 0
Costs replace_costs(Costs costs, std::string_view text);

/// How a place's rays come to be sent through a list or a grid.
enum class ListOrGrid : std::uint8_t {
    learned,      ///< by the rays that came and those that are expected
    always_grid,  ///< the first ray has the grid made
    always_list,
    threshold  ///< the first ray has the grid made where there are more primitives than so many
};

/// How lists and grids are chosen.
struct Rule {
    ListOrGrid choice = ListOrGrid::learned;  ///< how it is chosen
    std::uint64_t threshold = 64;             ///< for ListOrGrid::threshold
    bool forecasts = true;                    ///< learned: believe that as many rays come as in the last frame
    Costs costs{};                            ///< what is counted with
};

/// Puts "learned", "evidence" (learned, but without forecasts), "always-grid", "always-list" or "threshold=N" into a
/// rule.
/// throws  std::invalid_argument
void set_choice(Rule& rule, std::string_view text);

/// What a place offers: to search a list, or to build a grid and search that.
struct Alternatives {
    std::uint64_t primitives = 0;  ///< that the place holds
    double once = 0.0;             ///< when the first ray enters, whatever is chosen, ns
    double pack = 0.0;             ///< to make the list, which is done before rays come, ns
    double list = 0.0;             ///< per ray, ns
    double grid = 0.0;             ///< per ray, ns
    double build = 0.0;            ///< ns
};

/// The scenery, whose list is a flat list (flat_list.h).
/// packs_met  that a ray is expected to meet in it
Alternatives scenery_alternatives(const Costs& costs, std::uint64_t primitives, double packs_met);
/// A group that moves. is_one_voxel: its grid has one cell, which is built with it.
Alternatives group_alternatives(const Costs& costs, std::uint64_t primitives, bool is_one_voxel);
/// A voxel of a top grid, by how many primitives it lists.
Alternatives voxel_alternatives(const Costs& costs, std::uint64_t listed);
/// Whether a group is best carried by the first ray that enters it even if it gets no grid.
bool is_carried_first(const Costs& costs);

/// Voxels of the scenery that a ray usually goes through to its hit.
inline constexpr double voxels_met = 4.0;

inline constexpr std::uint64_t never = ~std::uint64_t{0};  ///< more rays than there are

/// The rays with which a place gets its grid: those that came, the ones at hand included. Learned: where a list has
/// cost them what building and the same rays in the grid would have. So nobody pays more than twice what is best in
/// hindsight: by then building is what is best, and as much again has been spent.
/// source  A. Karlin et al., "Competitive Snoopy Caching", Algorithmica 3, 1988
std::uint64_t rays_to_build(const Rule& rule, const Alternatives& place);

/// What a place took, ns.
/// listed, gridded  rays that were sent through the list and the grid
double spent(const Alternatives& place, std::uint64_t listed, std::uint64_t gridded, bool is_built);
/// The least that so many rays can take, ns.
double least(const Alternatives& place, std::uint64_t rays);

}  // namespace firstray::inline v0::lazy
