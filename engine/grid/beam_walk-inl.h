// The one walk of a beam through grids. Included once per instruction set.
#if defined(FIRSTRAY_BEAM_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_WALK_INL_H_
#undef FIRSTRAY_BEAM_WALK_INL_H_
#else
#define FIRSTRAY_BEAM_WALK_INL_H_
#endif

#include "engine/grid/beam_kernels-inl.h"
#include "engine/grid/grid.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// Where a beam's packets pass a slice of cells: ranges along u and v, relative to the apex.
struct BeamSlice {
    alignas(64) float lo_u[max_packets], hi_u[max_packets], lo_v[max_packets], hi_v[max_packets];
    PacketMask packets = 0;  ///< those that reach the slice
    float lo[2], hi[2];      ///< ranges of all of them
};

/// Cuts the packets asked for with a slice between two depths, 0 <= near <= far.
HWY_INLINE void cut(const Beam& beam, PacketMask asked, float near, float far, BeamSlice& slice)
{
    const PackLanes d;
    const auto at_near = hn::Set(d, near), at_far = hn::Set(d, far);
    const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
    auto least_u = infinite, most_u = hn::Neg(infinite), least_v = infinite, most_v = most_u;
    slice.packets = packets_where(beam.count, asked, [&](int first) HWY_ATTR {
        const auto lo_u = hn::Load(d, beam.lo_u + first), hi_u = hn::Load(d, beam.hi_u + first);
        const auto lo_v = hn::Load(d, beam.lo_v + first), hi_v = hn::Load(d, beam.hi_v + first);
        const auto from_u = hn::Min(hn::Mul(lo_u, at_near), hn::Mul(lo_u, at_far));
        const auto to_u = hn::Max(hn::Mul(hi_u, at_near), hn::Mul(hi_u, at_far));
        const auto from_v = hn::Min(hn::Mul(lo_v, at_near), hn::Mul(lo_v, at_far));
        const auto to_v = hn::Max(hn::Mul(hi_v, at_near), hn::Mul(hi_v, at_far));
        hn::Store(from_u, d, slice.lo_u + first);
        hn::Store(to_u, d, slice.hi_u + first);
        hn::Store(from_v, d, slice.lo_v + first);
        hn::Store(to_v, d, slice.hi_v + first);
        const auto reaches = hn::Ge(hn::Load(d, beam.reach + first), at_near);
        least_u = hn::IfThenElse(reaches, hn::Min(least_u, from_u), least_u);
        most_u = hn::IfThenElse(reaches, hn::Max(most_u, to_u), most_u);
        least_v = hn::IfThenElse(reaches, hn::Min(least_v, from_v), least_v);
        most_v = hn::IfThenElse(reaches, hn::Max(most_v, to_v), most_v);
        return reaches;
    });
    slice.lo[0] = hn::GetLane(hn::MinOfLanes(d, least_u));
    slice.hi[0] = hn::GetLane(hn::MaxOfLanes(d, most_u));
    slice.lo[1] = hn::GetLane(hn::MinOfLanes(d, least_v));
    slice.hi[1] = hn::GetLane(hn::MaxOfLanes(d, most_v));
}

/// The packets of a slice whose range along one axis overlaps [lo, hi].
HWY_INLINE PacketMask packets_between(const float* range_lo, const float* range_hi, int count, PacketMask asked,
                                      float lo, float hi)
{
    const PackLanes d;
    const auto at_lo = hn::Set(d, lo), at_hi = hn::Set(d, hi);
    return packets_where(count, asked, [&](int first) HWY_ATTR {
        return hn::And(hn::Le(hn::Load(d, range_lo + first), at_hi), hn::Ge(hn::Load(d, range_hi + first), at_lo));
    });
}

/// Cells, along one axis, that a range relative to the apex reaches; none where first > last.
struct CellSpan {
    int first, last;
};
HWY_INLINE CellSpan cells_between(float lo, float hi, float start, float cell, int cells)
{
    const float from = (lo - start) / cell, to = (hi - start) / cell, end = static_cast<float>(cells);
    if (!(from < end) || !(to >= 0.0f)) return {0, -1};
    return {static_cast<int>(std::max(from, 0.0f)), static_cast<int>(std::min(to, end - 1.0f))};
}

/// Walks a beam through the cells of a grid, and of the grids in them, slice by slice along the beam's major axis.
/// asked    the packets that walk
/// wide     by how much cells are widened: what the beam's and the planes' rounding comes to
/// resolve  see traverse()
/// search   `search.visit(voxel, packets, resolve)` does what is to be done in a voxel for the packets that go through
///          it; it may shorten the beam's reach
/// source   slices: I. Wald, T. Ize, A. Kensler, A. Knoll, S. Parker, "Ray Tracing Animated Scenes using Coherent Grid
///          Traversal", 2006
template <class Resolver, class Search>
HWY_NOINLINE void walk_slices(const Grid& grid, const Beam& beam, PacketMask asked, float wide, const Resolver& resolve,
                              Search& search)
{
    const int strides[3] = {1, grid.dims.x, grid.dims.x * grid.dims.y};
    const glm::vec3 hi = grid.hi();
    const float cell_k = grid.cell[beam.k], cell_u = grid.cell[beam.u], cell_v = grid.cell[beam.v];
    const float start_u = grid.lo[beam.u] - beam.apex[0], start_v = grid.lo[beam.v] - beam.apex[1];
    const bool up = beam.forward > 0.0f;
    const float begin = up ? grid.lo[beam.k] - beam.apex[2] : beam.apex[2] - hi[beam.k];
    const int slices = grid.dims[beam.k];
    const float behind = (-begin - wide) / cell_k;  // slices that lie behind the apex
    if (!(behind < static_cast<float>(slices))) return;

    BeamSlice slice;
    for (int s = behind > 0.0f ? static_cast<int>(behind) : 0; s < slices; ++s) {
        const float near = std::max(begin + static_cast<float>(s) * cell_k - wide, 0.0f),
                    far = std::max(begin + static_cast<float>(s + 1) * cell_k + wide, near);
        cut(beam, asked, near, far, slice);
        asked &= slice.packets;  // reach never grows
        if (asked == 0) return;
        const CellSpan across_u =
                           cells_between(slice.lo[0] - wide, slice.hi[0] + wide, start_u, cell_u, grid.dims[beam.u]),
                       across_v =
                           cells_between(slice.lo[1] - wide, slice.hi[1] + wide, start_v, cell_v, grid.dims[beam.v]);
        const std::int32_t layer =
            static_cast<std::int32_t>(grid.first_cell) + strides[beam.k] * (up ? s : slices - 1 - s);
        for (int v = across_v.first; v <= across_v.last; ++v) {
            const float cell_lo_v = start_v + static_cast<float>(v) * cell_v;
            PacketMask row = 0;
            bool has_row = false;
            for (int u = across_u.first; u <= across_u.last; ++u) {
                const std::int32_t index = layer + v * strides[beam.v] + u * strides[beam.u];
                const CellWord word = resolve.word(index);
                if (HWY_LIKELY(word.is_empty())) continue;
                if (!has_row) {
                    row = packets_between(slice.lo_v, slice.hi_v, beam.count, asked, cell_lo_v - wide,
                                          cell_lo_v + cell_v + wide);
                    has_row = true;
                }
                const float cell_lo_u = start_u + static_cast<float>(u) * cell_u;
                const PacketMask here = packets_between(slice.lo_u, slice.hi_u, beam.count, row, cell_lo_u - wide,
                                                        cell_lo_u + cell_u + wide);
                if (here != 0) search.visit(resolve.voxel(word, index), here, resolve);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
