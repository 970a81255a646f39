// What a single ray does in the voxels it walks through. Included once per instruction set.
#if defined(FIRSTRAY_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_SEARCH_INL_H_
#undef FIRSTRAY_SEARCH_INL_H_
#else
#define FIRSTRAY_SEARCH_INL_H_
#endif

#include <chrono>

#include "engine/grid/entries.h"
#include "engine/grid/search.h"
#include "engine/grid/traverse-inl.h"
#include "engine/primitive/intersect-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

enum class Query { closest, any };

/// Counts nothing, at no cost.
struct NoCost {
    void add_cell() {}
    void add_tests(const TrianglePack&) {}
    void add_test() {}
};

/// Counts what a ray does.
struct CountCost {
    RayCost* cost;
    void add_cell() { ++cost->cells; }
    void add_tests(const TrianglePack& pack)
    {
        for (const std::uint32_t id : pack.id) cost->tests += id != no_primitive;
    }
    void add_test() { ++cost->tests; }
};

/// A ray on its way: what it looks for and what it has found, in whatever structures it meets.
template <Query looks_for, typename RealType, class Cost>
struct Quest {
    using Real = RealType;
    static constexpr Query query = looks_for;

    const SearchRay<Real>& ray;
    RayMask mask;
    Cost cost;
    Hit<Real> hit;
    bool may_pass = false;  ///< something that the mask excludes, if nothing is hit

    /// Whether the mask admits a primitive that the ray may meet.
    bool sees(bool transmits)
    {
        const bool is_admitted = admits(mask, transmits);
        may_pass |= !is_admitted;
        return is_admitted;
    }

    /// Takes a hit if it counts; returns whether it does.
    bool take(Real t, Real u, Real v, PrimitiveId id)
    {
        if (!(t > ray.t_min) || !hit.is_beaten_by(t, id)) return false;
        hit = {t, u, v, id};
        return true;
    }
};

/// Three doubles, an axis each, as two pairs of lanes: x and y, z and z.
struct AxisPairs {
    using Pair = hn::FixedTag<double, 2>;
    hn::Vec<Pair> xy, zz;

    HWY_INLINE AxisPairs(hn::Vec<Pair> first, hn::Vec<Pair> last) : xy(first), zz(last) {}
    HWY_INLINE explicit AxisPairs(const glm::dvec3& v)
        : xy(hn::InterleaveLower(hn::Set(Pair(), v.x), hn::Set(Pair(), v.y))), zz(hn::Set(Pair(), v.z))
    {
    }
    /// The result of an operation on each axis.
    template <class Operation, class... Others>
    HWY_INLINE AxisPairs each(const Operation& operation, const Others&... others) const
    {
        return {operation(xy, others.xy...), operation(zz, others.zz...)};
    }
    HWY_INLINE double least() const { return hn::GetLane(hn::MinOfLanes(Pair(), hn::Min(xy, zz))); }
    HWY_INLINE double most() const { return hn::GetLane(hn::MaxOfLanes(Pair(), hn::Max(xy, zz))); }
    /// Rounded, in four lanes.
    HWY_INLINE auto as_floats() const
    {
        const hn::FixedTag<float, 2> d2;
        return hn::Combine(hn::FixedTag<float, 4>(), hn::DemoteTo(d2, zz), hn::DemoteTo(d2, xy));
    }
};

/// Where a ray is in a box, given by its distance from two opposite corners: raises `enter` and lowers `leave`; false
/// when it is not.
HWY_INLINE bool cut_to_box(const AxisPairs& to_lo, const AxisPairs& to_hi, const AxisPairs& inverse, double& enter,
                           double& leave)
{
    const auto product = [](auto a, auto b) HWY_ATTR { return hn::Mul(a, b); };
    const AxisPairs a = to_lo.each(product, inverse), b = to_hi.each(product, inverse);
    enter = std::max(enter, a.each([](auto x, auto y) HWY_ATTR { return hn::Min(x, y); }, b).most());
    leave = std::min(leave, a.each([](auto x, auto y) HWY_ATTR { return hn::Max(x, y); }, b).least());
    return enter <= leave;
}

/// Bound on the error of a t at which a plane is crossed, relative to it: 4 half ulps of double, and some.
inline constexpr double crossing_error = 0x1p-50;

/// From this many pads away, double cannot tell where a ray is in a box: it is wrong by more than a 256th of the pad.
inline constexpr double far_away = 0x1p-8 / crossing_error;

/// The same for a ray from so far away that double cannot tell where it enters: goes near the box first, along the ray
/// and with one rounding, so that it stays on it. `o` becomes that place; enter and leave count from there.
/// returns  t of that place
inline HWY_NOINLINE double go_near(glm::dvec3& o, const glm::dvec3& d, double& enter, double& leave)
{
    const double error = std::abs(enter) * crossing_error, near = enter - error;
    for (int axis = 0; axis < 3; ++axis) o[axis] = std::fma(near, d[axis], o[axis]);
    leave += std::abs(leave) * crossing_error - near;
    enter = 0.0;
    return near;
}

/// Moves a ray to where it enters a box, given by its corners; false when it does not.
/// o, d            origin and direction in the box's system
/// t_min, t_max    where hits are of interest
/// pad             by how much the box is widened
HWY_INLINE bool make_walk_ray(glm::dvec3 o, const glm::dvec3& d, double t_min, double t_max, const glm::dvec3& lo,
                              const glm::dvec3& hi, float pad, WalkRay& walk)
{
    const AxisPairs::Pair pair;
    // A hit's t is off by its slack; one that lies outside the interval by that much can still be found inside it.
    double enter = t_min - std::abs(t_min) * t_slack, leave = t_max + std::abs(t_max) * t_slack;
    const double wide = 2.0 * static_cast<double>(pad);
    AxisPairs origin(o);
    const AxisPairs direction(d);
    // A ray along a slab meets it everywhere or nowhere: its planes are crossed at minus and plus very far.
    const AxisPairs inverse = direction.each([&](auto along) HWY_ATTR {
        return hn::IfThenElse(hn::Eq(along, hn::Zero(pair)), hn::Set(pair, 1e300), hn::Div(hn::Set(pair, 1.0), along));
    });
    const AxisPairs wide_lo = AxisPairs(lo).each([&](auto x) HWY_ATTR { return hn::Sub(x, hn::Set(pair, wide)); }),
                    wide_hi = AxisPairs(hi).each([&](auto x) HWY_ATTR { return hn::Add(x, hn::Set(pair, wide)); });
    const auto cut = [&]() HWY_ATTR {
        const auto difference = [](auto a, auto b) HWY_ATTR { return hn::Sub(a, b); };
        return cut_to_box(wide_lo.each(difference, origin), wide_hi.each(difference, origin), inverse, enter, leave);
    };
    const double length = direction.each([](auto along) HWY_ATTR { return hn::Abs(along); }).most();
    const double begin = enter, end = leave;
    const bool is_in = cut();
    double gone = 0.0;
    if (HWY_UNLIKELY(std::abs(enter) * length > far_away * static_cast<double>(pad))) {
        enter = std::max(begin, std::min(enter, leave)), leave = end;
        gone = go_near(o, d, enter, leave);
        origin = AxisPairs(o);
        if (!cut()) return false;
    } else if (!is_in) {
        return false;
    }
    walk.shift = gone + enter;
    walk.t_pad = static_cast<float>(static_cast<double>(pad) / length);
    const AxisPairs start = origin.each(
        [&](auto from, auto along) HWY_ATTR { return hn::Add(from, hn::Mul(hn::Set(pair, enter), along)); }, direction);
    const hn::FixedTag<float, 4> d4;
    const auto rounded = start.as_floats();
    const AxisPairs as_rounded(hn::PromoteTo(pair, hn::LowerHalf(rounded)),
                               hn::PromoteTo(pair, hn::UpperHalf(hn::FixedTag<float, 2>(), rounded)));
    const double off =
        start.each([](auto exact, auto r) HWY_ATTR { return hn::Abs(hn::Sub(exact, r)); }, as_rounded).most();
    walk.origin_error = static_cast<float>(off + std::abs(enter) * length * crossing_error) * (1.0f + 0x1p-20f);
    const auto steepest = hn::Set(d4, 1e18f);
    const auto limited = hn::Min(hn::Max(inverse.as_floats(), hn::Neg(steepest)), steepest);
    hn::Store(rounded, d4, walk.origin);
    hn::Store(direction.as_floats(), d4, walk.direction);
    hn::Store(limited, d4, walk.inverse);
    hn::Store(hn::Neg(hn::Mul(rounded, limited)), d4, walk.box_shift);
    const hn::RebindToUnsigned<decltype(d4)> du;
    hn::Store(hn::ShiftRight<31>(hn::BitCast(du, limited)), du, walk.near_side);
    hn::Store(direction.xy, pair, walk.exact_direction);
    hn::Store(direction.zz, pair, walk.exact_direction + 2);
    hn::Store(inverse.xy, pair, walk.exact_inverse);
    hn::Store(inverse.zz, pair, walk.exact_inverse + 2);
    return true;
}

/// The walk t beyond which no primitive can beat a hit at t.
template <typename Real>
HWY_INLINE float stop_of(Real t, const WalkRay& walk)
{
    const double at = static_cast<double>(t);
    return static_cast<float>(at + std::abs(at) * t_slack - walk.shift) + walk.t_pad;
}

/// A quest's search of one structure.
/// Primitives  what is tested: `triangle(pack, lane, id, t_last)` and `quadric(id)` give hits, in the system and the
///             precision that decide them
template <class Quest, class Primitives>
struct Search {
    using Real = typename Quest::Real;

    Quest& quest;
    const Primitives& primitives;
    const GridStructure* structure;
    WalkRay walk{};
    FilterRay filter{};
    float stop = 0.0f;  ///< walk t beyond which no primitive can beat the hit

    /// Moves the ray to where it enters the structure; false when it does not.
    /// o, d   origin and direction in the structure's system
    /// loose  see make_filter_ray
    HWY_INLINE bool begin(const glm::dvec3& o, const glm::dvec3& d, float loose)
    {
        const Grid& top = structure->grids[0];
        if (!make_walk_ray(o, d, static_cast<double>(quest.ray.t_min), static_cast<double>(quest.hit.t),
                           glm::dvec3(top.lo), glm::dvec3(top.hi()), structure->pad, walk))
            return false;
        filter = make_filter_ray(walk, structure->largest, structure->blur, loose, largest_component<double>(o));
        update_stop();
        return true;
    }

    /// Searches from there on; returns whether the ray is done.
    template <class Resolver>
    HWY_INLINE bool run(const Resolver& resolve)
    {
        return large() || traverse(structure->grids[0], walk, 0.0f, stop, resolve, *this);
    }

    /// Tests what is kept out of the cells; returns whether the ray is done.
    bool large() { return list(structure->large, 0.0f); }

    float t_stop() const { return stop; }
    void count_cell() { quest.cost.add_cell(); }

    void update_stop()
    {
        stop = stop_of(quest.hit.t, walk);
        filter.set_far_end(stop, structure->pad);
    }

    /// Takes a hit if it counts; returns whether the ray is done.
    bool offer(Real t, Real u, Real v, PrimitiveId id)
    {
        if (!quest.take(t, u, v, id)) return false;
        if constexpr (Quest::query == Query::any) return true;
        update_stop();
        return false;
    }

    HWY_INLINE bool pack(const TrianglePack& pack)
    {
        quest.cost.add_tests(pack);
        alignas(64) float depths[pack_size];
        std::uint32_t lanes = candidates(pack, filter, depths);
        while (lanes != 0) {
            const int lane = nearest_lane(lanes, depths);
            lanes &= ~(1u << lane);
            const std::uint32_t marked = pack.id[lane];
            const PrimitiveId id = marked & ~transmitting_bit;
            if (id == quest.hit.id || !quest.sees((marked & transmitting_bit) != 0)) continue;
            const TriangleHit<Real> found = primitives.triangle(pack, lane, id, quest.hit.t);
            if (!found.hit) continue;
            if (offer(found.t, found.u, found.v, id)) return true;
            if (lanes != 0) lanes &= candidates(pack, filter, depths);  // many lie behind the hit
        }
        return false;
    }

    bool quadrics(const VoxelList& voxel)
    {
        for (std::uint32_t q = 0; q < voxel.quadrics; ++q) {
            const PrimitiveId id = structure->quadrics[voxel.first_quadric + q];
            quest.cost.add_test();
            const Real t = primitives.quadric(id, quest);
            if (std::isfinite(t) && offer(t, 0, 0, id)) return true;
        }
        return false;
    }

    /// Tests a voxel's primitives; returns whether the ray is done. A function of its own, so that walks have the
    /// registers to themselves.
    HWY_NOINLINE bool list(const VoxelList& voxel, float t_enter)
    {
        if (!may_admit(quest.mask, voxel.may_transmit)) return false;
        const TrianglePack* packs = structure->packs.data() + voxel.first_pack;
        if (voxel.packs < boxed_packs) {
            if (voxel.packs == 1 && pack(packs[0])) return true;
        } else {
            const PackBoxes* boxes = structure->boxes.data() + voxel.first_boxes;
            for (std::uint32_t block = 0; block < voxel.box_blocks(); block += blocks_at_once)
                if (boxed(boxes + block, std::min(voxel.box_blocks() - block, blocks_at_once),
                          packs + block * pack_size, t_enter))
                    return true;
        }
        return voxel.quadrics > 0 && quadrics(voxel);
    }

    /// Blocks whose packs are searched in one order, nearest first.
    static constexpr std::uint32_t blocks_at_once = 4;

    HWY_INLINE bool boxed(const PackBoxes* boxes, std::uint32_t blocks, const TrianglePack* packs, float t_enter)
    {
        alignas(64) float entries[blocks_at_once * pack_size];
        std::uint64_t met = 0;
        for (std::uint32_t block = 0; block < blocks; ++block) {
            const std::uint32_t first = block * pack_size;
            met |= std::uint64_t{boxes_met(boxes[block], walk, t_enter - walk.t_pad, stop, entries + first)} << first;
        }
        while (met != 0) {
            const int lane = nearest_lane(met, entries);
            met &= ~(std::uint64_t{1} << lane);
            if (entries[lane] > stop) break;
            if (pack(packs[lane])) return true;
        }
        return false;
    }

    template <class Resolver>
    HWY_INLINE bool visit(const Voxel& voxel, float t_enter, float t_leave, const Resolver& resolve)
    {
        return voxel.subgrid ? enter(*voxel.subgrid, t_enter, t_leave, resolve) : list(*voxel.list, t_enter);
    }

    template <class Resolver>
    HWY_NOINLINE bool enter(const Grid& grid, float t_begin, float t_end, const Resolver& resolve)
    {
        return traverse(grid, walk, t_begin, std::min(t_end, stop), resolve, *this);
    }
};

/// Everything is there: a cell's word says where.
class EagerResolver {
public:
    explicit EagerResolver(const GridStructure& structure)
        : cells_(structure.cells.data()), lists_(structure.lists.data()), grids_(structure.grids.data())
    {
    }
    CellWord word(std::int32_t cell) const { return cells_[cell]; }
    Voxel voxel(CellWord word, std::int32_t /*cell*/) const
    {
        if (word.is_subgrid()) return {nullptr, &grids_[word.index()]};
        return {&lists_[word.index()], nullptr};
    }

private:
    const CellWord* HWY_RESTRICT cells_;
    const VoxelList* HWY_RESTRICT lists_;
    const Grid* HWY_RESTRICT grids_;
};

/// t of a quadric that a quest sees; infinite where the ray does not meet it.
template <typename Real, class Quest>
Real test_quadric(const RootQuadric& quadric, const SearchRay<Real>& ray, Quest& quest)
{
    if (!quest.sees(quadric.transmits)) return std::numeric_limits<Real>::infinity();
    return intersect_rounded(quadric, ray);
}

/// The primitives of a structure in the root system, where hits are decided.
template <typename Real>
struct RootPrimitives {
    const RootGeometry<Real>& geometry;
    const SearchRay<Real>& ray;
    Precision precision;

    HWY_INLINE TriangleHit<Real> triangle(const TrianglePack& pack, int lane, PrimitiveId id, Real t_last) const
    {
        if constexpr (std::is_same_v<Real, float>)
            return intersect_in_pack(pack, lane, ray, precision, t_last);
        else
            return intersect_precisely(geometry.triangle(id), ray, precision, t_last);
    }
    /// The same of an entry that no pack holds.
    TriangleHit<Real> triangle_of(const GridEntries& entries, std::uint32_t entry, PrimitiveId id, Real t_last) const
    {
        if constexpr (std::is_same_v<Real, float>)
            return intersect_precisely(entries.triangle(entry), ray, precision, t_last);
        else
            return intersect_precisely(geometry.triangle(id), ray, precision, t_last);
    }
    template <class Quest>
    Real quadric(PrimitiveId id, Quest& quest) const
    {
        return test_quadric(geometry.quadric(id), ray, quest);
    }
};

/// Searches a whole structure in the root system for a quest; returns whether the ray is done.
template <class Quest, class Resolver>
HWY_INLINE void search_root(const SearchTarget<typename Quest::Real>& target, const Resolver& resolve, Quest& quest)
{
    const RootPrimitives<typename Quest::Real> primitives{*target.geometry, quest.ray, target.precision};
    Search<Quest, RootPrimitives<typename Quest::Real>> search{quest, primitives, target.structure};
    const bool loose = target.precision == Precision::fast;
    if (search.begin(glm::dvec3(quest.ray.origin), glm::dvec3(quest.ray.direction), loose ? 1.0f : 0.0f))
        search.run(resolve);
}

template <class Quest, typename Real>
HWY_INLINE void store_may_pass(const Quest& quest, RayTile<Real>& tile, int lane)
{
    if (Quest::query == Query::any && tile.may_pass) tile.may_pass[lane] = quest.may_pass;
}

/// Sends one ray of a tile on its quest.
template <Query query, typename Real, class Searcher>
HWY_INLINE void search_ray(RayTile<Real>& tile, int lane, const Searcher& searcher)
{
    using Clock = std::chrono::steady_clock;
    SearchRay<Real> ray;
    if (!make_search_ray(tile, lane, ray)) return;
    if constexpr (std::is_same_v<Real, float>) {  // counting is a small part of what double costs
        if (tile.cost == nullptr) {
            Quest<query, Real, NoCost> quest{ray, tile.mask, {}, {ray.t_max}};
            searcher(quest);
            store_may_pass(quest, tile, lane);
            return store_hit(ray, quest.hit, tile, lane);
        }
    }
    RayCost unasked;
    const Clock::time_point begin = Clock::now();
    Quest<query, Real, CountCost> quest{ray, tile.mask, {tile.cost ? tile.cost + lane : &unasked}, {ray.t_max}};
    searcher(quest);
    store_may_pass(quest, tile, lane);
    store_hit(ray, quest.hit, tile, lane);
    quest.cost.cost->nanoseconds += static_cast<std::uint64_t>((Clock::now() - begin).count());
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
