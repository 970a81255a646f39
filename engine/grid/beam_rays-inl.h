// How a tile's rays become beams. Included once per instruction set.
#if defined(FIRSTRAY_BEAM_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_RAYS_INL_H_
#undef FIRSTRAY_BEAM_RAYS_INL_H_
#else
#define FIRSTRAY_BEAM_RAYS_INL_H_
#endif

#include "engine/grid/beam_order.h"
#include "engine/grid/grid.h"
#include "engine/grid/packet_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// Whether all rays of a tile can walk in one beam of a direction.
HWY_INLINE bool all_go_along(const RayTile<float>& tile, const BeamAxes& axes)
{
    const PackLanes d;
    const auto sign = hn::Set(d, axes.forward), zero = hn::Zero(d), steepest = hn::Set(d, most_slope);
    const auto shortest = hn::Set(d, shortest_beam_ray), longest = hn::Set(d, longest_beam_ray);
    for (int first = 0; first < tile.count; first += kernel_lanes) {
        const auto speed = hn::Mul(sign, hn::Load(d, tile.direction[axes.k].data() + first));
        const auto side_u = hn::Abs(hn::Load(d, tile.direction[axes.u].data() + first)),
                   side_v = hn::Abs(hn::Load(d, tile.direction[axes.v].data() + first));
        const auto t_min = hn::Load(d, tile.t_min.data() + first);
        const auto end = hn::Mul(speed, steepest);
        auto good = hn::And(hn::And(hn::Ge(speed, shortest), hn::Lt(speed, longest)),
                            hn::And(hn::Le(side_u, end), hn::Le(side_v, end)));
        good = hn::And(good, hn::And(hn::Ge(t_min, zero), hn::Lt(t_min, hn::Load(d, tile.t_max.data() + first))));
        const int left = std::min(tile.count - first, kernel_lanes);
        const std::uint32_t wanted = (2u << (left - 1)) - 1;
        if ((bits_of(d, good) & wanted) != wanted) return false;
    }
    return true;
}

/// Loads rays of a tile into packets, in order; the last packet is filled up with rays that are done.
/// lanes  the tile's, `count` of them, [1, 1024], as BeamPart says; null: the first
HWY_INLINE void load_rays(const RayTile<float>& tile, const std::int32_t* lanes, int count, BeamRays& rays)
{
    const PackLanes d;
    const hn::RebindToSigned<PackLanes> di;
    const hn::RebindToUnsigned<PackLanes> du;
    rays.apex = tile.apex;
    rays.packets = (count + packet_size - 1) / packet_size;
    rays.may_pass = 0;
    alignas(64) std::int32_t padded[packet_size];
    for (int first = 0; first < rays.packets * packet_size; first += kernel_lanes) {
        const auto to = static_cast<std::size_t>(first);
        const bool is_whole = first + kernel_lanes <= count;
        const std::int32_t* from = lanes ? lanes + first : nullptr;
        if (!is_whole) {
            for (int i = 0; i < kernel_lanes; ++i) {
                const int ray = std::min(first + i, count - 1);
                padded[i] = lanes ? lanes[ray] : ray;
            }
            from = padded;
        }
        const bool in_order = !lanes && is_whole;
        const auto lane = in_order ? hn::Zero(di) : hn::LoadU(di, from);
        const auto fills = hn::Lt(lane, hn::Zero(di));
        const auto index = hn::IfThenElse(fills, hn::Not(lane), lane);
        const auto take = [&](const RayTile<float>::Lane& values) HWY_ATTR {
            return in_order ? hn::Load(d, values.data() + to) : hn::GatherIndex(d, values.data(), index);
        };
        auto length = hn::Zero(d);
        for (int axis = 0; axis < 3; ++axis) {
            const auto component = take(tile.direction[axis]);
            hn::Store(component, d, rays.direction[axis].data() + to);
            length = hn::Max(length, hn::Abs(component));
        }
        hn::Store(length, d, rays.length.data() + to);
        hn::Store(hn::Div(hn::Set(d, 1.0f), length), d, rays.inverse_length.data() + to);
        hn::Store(take(tile.t_min), d, rays.t_min.data() + to);
        const auto end = take(tile.t_max);
        const auto is_ray =
            hn::AndNot(hn::RebindMask(d, fills),
                       hn::FirstN(d, static_cast<std::size_t>(std::clamp(count - first, 0, kernel_lanes))));
        hn::Store(hn::IfThenElse(is_ray, end, hn::Set(d, -std::numeric_limits<float>::infinity())), d,
                  rays.t.data() + to);
        hn::Store(hn::Set(du, no_primitive), du, rays.id.data() + to);
    }
}

/// The beam of loaded rays, in the root system.
HWY_INLINE void make_root_beam(const BeamRays& rays, const BeamAxes& axes, Beam& beam)
{
    const PackLanes d;
    beam.u = axes.u;
    beam.v = axes.v;
    beam.k = axes.k;
    beam.forward = axes.forward;
    beam.apex[0] = rays.apex[axes.u];
    beam.apex[1] = rays.apex[axes.v];
    beam.apex[2] = rays.apex[axes.k];
    beam.farthest = largest_component<float>(rays.apex);
    beam.count = rays.packets;
    beam.packets = first_packets(rays.packets);
    const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity()), sign = hn::Set(d, axes.forward);
    for (int packet = 0; packet < rays.packets; ++packet) {
        auto lo_u = infinite, lo_v = infinite, hi_u = hn::Neg(infinite), hi_v = hi_u;
        for (int first = packet * packet_size; first < (packet + 1) * packet_size; first += kernel_lanes) {
            const auto to = static_cast<std::size_t>(first);
            const auto inverse = hn::Div(sign, hn::Load(d, rays.direction[axes.k].data() + to));
            const auto u = hn::Mul(hn::Load(d, rays.direction[axes.u].data() + to), inverse);
            const auto v = hn::Mul(hn::Load(d, rays.direction[axes.v].data() + to), inverse);
            lo_u = hn::Min(lo_u, u);
            hi_u = hn::Max(hi_u, u);
            lo_v = hn::Min(lo_v, v);
            hi_v = hn::Max(hi_v, v);
        }
        beam.lo_u[packet] = hn::GetLane(hn::MinOfLanes(d, lo_u));
        beam.hi_u[packet] = hn::GetLane(hn::MaxOfLanes(d, hi_u));
        beam.lo_v[packet] = hn::GetLane(hn::MinOfLanes(d, lo_v));
        beam.hi_v[packet] = hn::GetLane(hn::MaxOfLanes(d, hi_v));
        beam.reach[packet] = reach_of(rays, beam, packet);
        beam.scale[packet] = 1.0f;
    }
}

/// Fills up what lanes beyond the last packet hold, widens the slopes, and finds what bounds all of them.
HWY_INLINE void finish_beam(Beam& beam)
{
    const PackLanes d;
    const auto pad = hn::Set(d, slope_pad), zero = hn::Zero(d);
    for (int packet = beam.count; packet % kernel_lanes != 0; ++packet) {
        beam.lo_u[packet] = beam.lo_v[packet] = beam.hi_u[packet] = beam.hi_v[packet] = 0.0f;
        beam.reach[packet] = -1.0f;
        beam.scale[packet] = 1.0f;
    }
    float* const lo[2] = {beam.lo_u, beam.lo_v};
    float* const hi[2] = {beam.hi_u, beam.hi_v};
    beam.steepest = 1.0f;
    for (int side = 0; side < 2; ++side) {
        auto least = hn::Set(d, std::numeric_limits<float>::infinity()), most = hn::Neg(least);
        for (int first = 0; first < beam.count; first += kernel_lanes) {
            auto from = hn::Load(d, lo[side] + first), to = hn::Load(d, hi[side] + first);
            from = hn::Sub(from, hn::MulAdd(hn::Abs(from), pad, pad));
            to = hn::Add(to, hn::MulAdd(hn::Abs(to), pad, pad));
            hn::Store(from, d, lo[side] + first);
            hn::Store(to, d, hi[side] + first);
            const auto here = hn::Ge(hn::Load(d, beam.reach + first), zero);
            least = hn::IfThenElse(here, hn::Min(least, from), least);
            most = hn::IfThenElse(here, hn::Max(most, to), most);
        }
        beam.lo[side] = hn::GetLane(hn::MinOfLanes(d, least));
        beam.hi[side] = hn::GetLane(hn::MaxOfLanes(d, most));
        beam.steepest = std::max(beam.steepest, std::max(std::abs(beam.lo[side]), std::abs(beam.hi[side])));
    }
}

/// Finds the slopes between which all of a beam's are, as they are.
HWY_INLINE void find_extent(Beam& beam)
{
    beam.lo[0] = beam.lo[1] = std::numeric_limits<float>::infinity();
    beam.hi[0] = beam.hi[1] = -std::numeric_limits<float>::infinity();
    for (int packet = 0; packet < beam.count; ++packet) {
        beam.lo[0] = std::min(beam.lo[0], beam.lo_u[packet]);
        beam.hi[0] = std::max(beam.hi[0], beam.hi_u[packet]);
        beam.lo[1] = std::min(beam.lo[1], beam.lo_v[packet]);
        beam.hi[1] = std::max(beam.hi[1], beam.hi_v[packet]);
    }
}

/// Whether the packets of a beam lie in its extent as neighbours in a picture do; if not, its rays end on several
/// surfaces and are better sorted.
HWY_INLINE bool is_well_packed(const Beam& beam)
{
    float sum = 0.0f;
    for (int packet = 0; packet < beam.count; ++packet)
        sum += (beam.hi_u[packet] - beam.lo_u[packet]) * (beam.hi_v[packet] - beam.lo_v[packet]);
    const float all = (beam.hi[0] - beam.lo[0]) * (beam.hi[1] - beam.lo[1]);
    return beam.count <= 1 || (sum < 0.75f * all && sum > 0.2f * all);
}

/// Rays that reach this depth have no end.
inline constexpr float endless = 1e30f;

/// The depth at which a beam leaves a grid.
HWY_INLINE float depth_of_grid(const Beam& beam, const Grid& grid)
{
    const float side = beam.forward > 0.0f ? grid.hi()[beam.k] : grid.lo[beam.k];
    return std::max(beam.forward * (side - beam.apex[2]), 0.0f);
}

/// Where the loaded rays lie in the beam's extent.
/// top   null: there is no grid
/// cell  length of one of its cells
HWY_INLINE void find_places(const BeamRays& rays, const Beam& root, const Grid* top, float cell, BeamPlaces& places)
{
    const PackLanes d;
    const hn::RebindToUnsigned<PackLanes> du;
    const hn::RebindToSigned<PackLanes> di;
    const int axes[2] = {root.u, root.v};
    const auto spread = [&](auto x) HWY_ATTR {
        x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(du, 0x0f0fu));
        x = hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(du, 0x3333u));
        return hn::And(hn::Or(x, hn::ShiftLeft<1>(x)), hn::Set(du, 0x5555u));
    };
    places.wide_u = std::max(root.hi[0] - root.lo[0], 1e-20f);
    places.wide_v = std::max(root.hi[1] - root.lo[1], 1e-20f);
    const float scales[2] = {256.0f / places.wide_u, 256.0f / places.wide_v};
    float* const slopes[2] = {places.u, places.v};
    const float per_length = top ? 1.0f / cell : 0.0f;
    const auto farthest = hn::Set(d, top ? depth_of_grid(root, *top) * per_length : 0.0f);
    auto longest = hn::Zero(d);
    for (int first = 0; first < rays.packets * packet_size; first += kernel_lanes) {
        const auto at = static_cast<std::size_t>(first);
        const auto speed = hn::Mul(hn::Set(d, root.forward), hn::Load(d, rays.direction[root.k].data() + at));
        const auto inverse = hn::Div(hn::Set(d, 1.0f), speed);
        const auto reach = hn::Mul(speed, hn::Load(d, rays.t.data() + at));
        longest = hn::Max(longest, reach);
        hn::Store(hn::Min(hn::Mul(reach, hn::Set(d, per_length)), farthest), d, places.depth + first);
        auto key = hn::Iota(du, static_cast<std::uint32_t>(first));
        for (int side = 0; side < 2; ++side) {
            const auto slope = hn::Mul(hn::Load(d, rays.direction[axes[side]].data() + at), inverse);
            hn::Store(slope, d, slopes[side] + first);
            const auto square = hn::Mul(hn::Sub(slope, hn::Set(d, root.lo[side])), hn::Set(d, scales[side]));
            const auto clamped = hn::Min(hn::Max(square, hn::Zero(d)), hn::Set(d, 255.0f));
            const auto spread_out = spread(hn::BitCast(du, hn::ConvertTo(di, clamped)));
            key = hn::Or(key, side == 0 ? hn::ShiftLeft<16>(spread_out) : hn::ShiftLeft<17>(spread_out));
        }
        hn::Store(key, du, places.key + first);
    }
    const bool has_end = hn::GetLane(hn::MaxOfLanes(d, longest)) < endless;
    places.most_columns = has_end ? most_columns : most_columns_without_end;
}

/// Of the packets asked for, those whose rays are so far apart, where they end or leave the grid, that each goes
/// through cells of its own.
/// cell  length of one of them
/// most  columns of cells for a packet whose rays have an end
HWY_INLINE PacketMask too_wide(const Beam& beam, PacketMask asked, const Grid& grid, float cell, float most)
{
    PacketMask wide = 0;
    const float farthest = depth_of_grid(beam, grid);
    for (; asked != 0; asked &= asked - 1) {
        const int packet = __builtin_ctzll(asked);
        const float depth = std::min(beam.reach[packet], farthest) / cell;
        const float columns =
            columns_at(depth, beam.hi_u[packet] - beam.lo_u[packet], beam.hi_v[packet] - beam.lo_v[packet]);
        if (columns > (beam.reach[packet] < endless ? most : most_columns_without_end)) wide |= PacketMask{1} << packet;
    }
    return wide;
}

/// Packets that are too wide for the grid of most cells are left out of the beam.
HWY_INLINE PacketMask leave_out_wide(Beam& beam, BeamRays& rays, const Grid& top, float cell)
{
    const PacketMask wide = too_wide(beam, first_packets(beam.count), top, cell, most_columns);
    for (PacketMask rest = wide; rest != 0; rest &= rest - 1) {
        const int packet = __builtin_ctzll(rest);
        beam.reach[packet] = -std::numeric_limits<float>::infinity();
        std::fill_n(rays.t.begin() + packet * packet_size, packet_size, -std::numeric_limits<float>::infinity());
    }
    beam.packets &= ~wide;
    return wide;
}

/// Puts what was found into the tile.
/// lanes  as load_rays() took them
HWY_INLINE void store_hits(const BeamRays& rays, const std::int32_t* lanes, int count, RayTile<float>& tile)
{
    const PackLanes d;
    const hn::RebindToUnsigned<PackLanes> du;
    int i = 0;
    for (; !lanes && i + kernel_lanes <= count; i += kernel_lanes) {
        const auto at = static_cast<std::size_t>(i);
        const auto id = hn::Load(du, rays.id.data() + at);
        const auto hit = hn::RebindMask(d, hn::Ne(id, hn::Set(du, no_primitive)));
        hn::Store(id, du, tile.primitive.data() + at);
        const auto put = [&](const BeamRays::Lane& from, RayTile<float>::Lane& to)
                             HWY_ATTR { hn::BlendedStore(hn::Load(d, from.data() + at), hit, d, to.data() + at); };
        put(rays.t, tile.t_max);
        put(rays.u, tile.u);
        put(rays.v, tile.v);
    }
    for (; i < count; ++i) {
        const auto from = static_cast<std::size_t>(i), to = static_cast<std::size_t>(lanes ? lanes[i] : i);
        if (rays.id[from] == no_primitive) continue;  // so are those that fill up packets
        tile.primitive[to] = rays.id[from];
        tile.t_max[to] = rays.t[from];
        tile.u[to] = rays.u[from];
        tile.v[to] = rays.v[from];
    }
}

/// Puts down in the tile which rays may meet what the mask excludes.
/// lanes  as load_rays() took them
inline void store_may_pass(const BeamRays& rays, const std::int32_t* lanes, int count, RayTile<float>& tile)
{
    for (int i = 0; i < count; ++i) {
        const int lane = lanes ? lanes[i] : i;
        if (lane < 0) continue;  // it fills up a packet
        tile.may_pass[lane] = rays.may_pass >> (i / packet_size) & 1;
    }
}

/// Sends a tile's rays on their quests as beams, and those that make none one by one.
/// search  `search(rays, root)` searches whatever there is for a beam
/// one     `one(lane)` does for one ray
/// top     the grid of most cells, if there is one
template <class Search, class One>
HWY_NOINLINE void search_by_beams(RayTile<float>& tile, const Grid* top, const Search& search, const One& one)
{
    const float cell = top ? top->fine_length() : 0.0f;
    BeamRays& rays = beam_rays_of_this_thread();
    Beam root;
    BeamOrder order;
    const auto load = [&](const BeamPart& part) HWY_ATTR {
        load_rays(tile, order.lanes_of(part), part.count, rays);
        make_root_beam(rays, part.axes, root);
    };
    const auto send = [&](const BeamPart& part) HWY_ATTR {
        finish_beam(root);
        if (root.packets != 0) search(rays, root);
        store_hits(rays, order.lanes_of(part), part.count, tile);
        if (tile.may_pass) store_may_pass(rays, order.lanes_of(part), part.count, tile);
    };
    const auto send_alone = [&](int first) HWY_ATTR {
        for (int i = first; i < order.singles; ++i) one(order.single[i]);
    };
    const BeamAxes main = axes_of(tile.direction_of(tile.count / 2));
    if (all_go_along(tile, main))
        order.take_all(tile.count, main);
    else
        order.split(tile);
    send_alone(0);
    const int parts = order.count;
    for (int p = 0; p < parts; ++p) {
        BeamPart part = order.parts[p];
        load(part);
        find_extent(root);
        if (is_well_packed(root)) {
            const PacketMask wide = top ? leave_out_wide(root, rays, *top, cell) : 0;
            send(part);
            if (wide == 0) continue;
            part = order.only(part, wide);
            load(part);
            find_extent(root);
        }
        BeamPlaces places;
        find_places(rays, root, top, cell, places);
        const int single = order.singles;
        order.cluster(part, places);
        send_alone(single);
        for (int c = parts; c < order.count; ++c) {
            load(order.parts[c]);
            send(order.parts[c]);
        }
        order.count = parts;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
