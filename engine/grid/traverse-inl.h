// The one walk of a single ray through grids. Included once per instruction set.
#if defined(FIRSTRAY_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_TRAVERSE_INL_H_
#undef FIRSTRAY_TRAVERSE_INL_H_
#else
#define FIRSTRAY_TRAVERSE_INL_H_
#endif

#include "engine/grid/grid.h"
#include "engine/primitive/pack_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What the usual resolver says of a cell that is not empty: either a list or a grid.
struct Voxel {
    const VoxelList* list;
    const Grid* subgrid;
};

/// Walks a ray through the cells of a grid, and of the grids in them, nearest first, from walk t `t_begin` to `t_end`.
/// resolve  the cells' words by index (`word(cell)`), and what a word stands for (`voxel(word, cell)`)
/// search   `search.visit(voxel, t_enter, t_leave, resolve)` does what is to be done in a voxel and returns whether the
///          ray is done; `search.t_stop()` is the walk t beyond which nothing is of interest
/// returns  whether the ray is done
///
/// The plane between cells i-1 and i of an axis is crossed at i * step + base: computed from i and never accumulated,
/// so that errors do not grow along the way; they stay below the pad by which primitives are registered. The crossing
/// after the next is computed while the next is still to come, which takes it off the critical path.
template <class Resolver, class Search>
HWY_INLINE bool traverse(const Grid& grid, const WalkRay& ray, float t_begin, float t_end, const Resolver& resolve,
                         Search& search)
{
    const hn::FixedTag<float, 4> d;
    const hn::FixedTag<std::int32_t, 4> di;
    const auto origin = hn::Load(d, ray.origin), inverse = hn::Load(d, ray.inverse);
    const auto lo = hn::Load(d, &grid.lo.x), cell = hn::Load(d, &grid.cell.x);
    const auto dims = hn::ConvertTo(d, hn::Load(di, &grid.dims.x));
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const auto far_away = hn::Set(d, std::numeric_limits<float>::infinity());
    const auto axes = hn::FirstN(d, 3);
    const auto up = hn::Gt(inverse, zero);

    const auto step = hn::Mul(cell, inverse), base = hn::Mul(hn::Sub(lo, origin), inverse);
    const auto crossing = [&](auto plane) HWY_ATTR { return hn::MulAdd(plane, step, base); };
    const auto first = crossing(hn::IfThenElse(up, zero, dims)), last = crossing(hn::IfThenElse(up, dims, zero));
    const float t_enter =
        std::max(t_begin, hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElse(axes, first, hn::Neg(far_away)))));
    const float t_leave = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(axes, last, far_away)));
    if (!(t_enter <= std::min(t_end, t_leave) + ray.t_pad)) return false;

    const auto at = hn::MulAdd(hn::Set(d, t_enter), hn::Load(d, ray.direction), origin);
    const auto place = hn::Floor(hn::Div(hn::Sub(at, lo), cell));
    const auto start = hn::Min(hn::Max(place, zero), hn::Sub(dims, one));
    alignas(16) std::int32_t c[4];
    hn::Store(hn::ConvertTo(di, start), di, c);

    const std::int32_t row = grid.dims.x, layer = grid.dims.x * grid.dims.y;
    std::int32_t index = c[0] + row * c[1] + layer * c[2] + static_cast<std::int32_t>(grid.first_cell);
    const std::int32_t sx = ray.inverse[0] > 0.0f ? 1 : -1, sy = ray.inverse[1] > 0.0f ? row : -row,
                       sz = ray.inverse[2] > 0.0f ? layer : -layer;
    const std::int32_t moves[8] = {0, sx, sy, sx + sy, sz, sx + sz, sy + sz, sx + sy + sz};

    const auto forward = hn::IfThenElse(up, one, hn::Neg(one));
    auto plane = hn::Add(start, hn::IfThenElseZero(up, one));
    auto next = hn::IfThenElse(axes, crossing(plane), far_away);
    plane = hn::Add(plane, forward);
    auto after = crossing(plane);
    // Crossings are the same function of the index on both sides, so the step that would leave is met exactly.
    float t_last = std::min(t_leave, search.t_stop()), t = t_enter;
    for (;;) {
        // Most cells are empty: a loop of its own, so that what it works with stays in registers.
        auto nearest = hn::MinOfLanes(d, next);
        CellWord word = resolve.word(index);
        search.count_cell();
        const auto step_on = [&]() HWY_ATTR {
            const auto crossed = hn::Le(next, nearest);
            t = hn::GetLane(nearest);
            index += moves[bits_of(d, crossed) & 7];
            next = hn::IfThenElse(crossed, after, next);
            plane = hn::Add(plane, hn::IfThenElseZero(crossed, forward));
            after = crossing(plane);
        };
        while (word.is_empty()) {
            // Written so that what is not a number, where products overflow, ends the walk too.
            if (!(hn::GetLane(nearest) < t_last)) return false;
            step_on();
            nearest = hn::MinOfLanes(d, next);
            word = resolve.word(index);
            search.count_cell();
        }
        const float t_next = hn::GetLane(nearest);
        if (search.visit(resolve.voxel(word, index), t, t_next, resolve)) return true;
        t_last = std::min(t_leave, search.t_stop());
        if (!(t_next < t_last)) return false;
        step_on();
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
