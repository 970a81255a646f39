// What a beam does in the voxels it walks through. Included once per instruction set.
#if defined(FIRSTRAY_BEAM_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_SEARCH_INL_H_
#undef FIRSTRAY_BEAM_SEARCH_INL_H_
#else
#define FIRSTRAY_BEAM_SEARCH_INL_H_
#endif

#include "engine/grid/beam_quest-inl.h"
#include "engine/grid/beam_rays-inl.h"
#include "engine/grid/beam_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// A beam's search of one structure.
/// Primitives  what is tested, in the root system: `quadric(id)`, and `triangle(id)` unless `stand_in_packs` says that
///             triangles are, bit for bit, those of the packs
template <class BeamQuest, class Primitives>
struct BeamSearch {
    BeamQuest& quest;
    Beam& beam;  ///< in the structure's system
    const Primitives& primitives;
    const GridStructure* structure;
    float loose;        ///< see make_filter_ray
    float wide = 0.0f;  ///< by how much cells and boxes are widened for the beam's rounding

    /// Searches everything for packets.
    template <class Resolver>
    HWY_INLINE void run(PacketMask packets, const Resolver& resolve)
    {
        begin();
        list(structure->large, packets);
        walk_slices(structure->grids[0], beam, packets, wide, resolve, *this);
    }

    void begin() { wide = 0x1p-21f * (structure->largest + beam.farthest); }

    template <class Resolver>
    HWY_INLINE void visit(const Voxel& voxel, PacketMask packets, const Resolver& resolve)
    {
        if (voxel.subgrid)
            walk_slices(*voxel.subgrid, beam, packets, wide, resolve, *this);
        else
            list(*voxel.list, packets);
    }

    HWY_NOINLINE void list(const VoxelList& voxel, PacketMask packets)
    {
        if (!may_admit(quest.mask, voxel.may_transmit)) return;
        const TrianglePack* packs = structure->packs.data() + voxel.first_pack;
        if (voxel.packs < boxed_packs) {
            if (voxel.packs == 1) pack(packs[0], packets);
        } else {
            for (std::uint32_t block = 0; block < voxel.box_blocks(); ++block)
                boxed(structure->boxes[voxel.first_boxes + block], packs + block * pack_size, packets);
        }
        for (std::uint32_t q = 0; q < voxel.quadrics; ++q)
            quadric(primitives.quadric(structure->quadrics[voxel.first_quadric + q]), packets);
    }

    HWY_INLINE void boxed(const PackBoxes& boxes, const TrianglePack* packs, PacketMask packets)
    {
        for (std::uint32_t met = boxes_meeting(boxes, beam, wide); met != 0; met &= met - 1) {
            const int lane = __builtin_ctz(met);
            const Aabb around = boxes.box(static_cast<std::size_t>(lane));
            const BeamBox box = beam_box(beam, around.lo, around.hi, wide);
            if (const PacketMask inside = packets_meeting(beam, box, packets)) pack(packs[lane], inside);
        }
    }

    HWY_NOINLINE void pack(const TrianglePack& pack, PacketMask packets)
    {
        BeamTriangles triangles;
        std::uint32_t met =
            make_beam_triangles(pack, beam, bounds_of(beam, packets), wide, structure->blur, loose, triangles);
        if constexpr (Primitives::stand_in_packs) {
            for (; met != 0; met &= met - 1) {
                const int lane = __builtin_ctz(met);
                if (const PacketMask maybe = untested(pack, lane, packets, triangles))
                    test(pack, lane, triangles, maybe);
            }
        } else {
            PacketMask maybe[pack_size];
            std::uint32_t here = 0;
            for (; met != 0; met &= met - 1) {
                const int lane = __builtin_ctz(met);
                maybe[lane] = untested(pack, lane, packets, triangles);
                if (maybe[lane] != 0) here |= 1u << lane;
            }
            if (here != 0) test_in_root(pack, here, maybe, triangles);
        }
    }

    /// The packets that may have a ray that meets a triangle, and have not been tested against it.
    HWY_INLINE PacketMask untested(const TrianglePack& pack, int lane, PacketMask packets,
                                   const BeamTriangles& triangles)
    {
        const std::uint32_t marked = pack.id[lane];
        if (!admits(quest.mask, (marked & transmitting_bit) != 0)) {
            if constexpr (BeamQuest::query == Query::any)
                quest.rays.may_pass |= meeting(pack, lane, packets & ~quest.rays.may_pass, triangles);
            return 0;
        }
        return meeting(pack, lane, quest.mailbox.untested(marked & ~transmitting_bit, packets), triangles);
    }

    /// The packets of those asked that may have a ray that meets a triangle.
    HWY_INLINE PacketMask meeting(const TrianglePack& pack, int lane, PacketMask asked, const BeamTriangles& triangles)
    {
        if (asked == 0) return 0;
        if (std::isfinite(triangles.error[lane])) return packets_meeting(beam, triangles, lane, asked);
        // Its sides tell nothing: it is seen edge-on, or from so far away that float does not tell them apart.
        // Precision::fast may take for a hit what passes beside it.
        const Aabb box = pack.box(lane);
        const float beside = wide + structure->pad + loose * pack.edge[lane];
        return packets_meeting(beam, beam_box(beam, box.lo, box.hi, beside), asked);
    }

    HWY_INLINE void test(const TrianglePack& pack, int lane, const BeamTriangles& triangles, PacketMask packets)
    {
        quest.test(take_apex_triangle(triangles, pack, lane), pack.id[lane], packets, beam,
                   [&] { return pack.triangle(lane); });
    }

    /// Tests triangles of a pack as they stand in the root system.
    HWY_NOINLINE void test_in_root(const TrianglePack& pack, std::uint32_t lanes, const PacketMask (&maybe)[pack_size],
                                   BeamTriangles& triangles)
    {
        const PackLanes d;
        TrianglePack root{};
        PacketMask any = 0;
        for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            root.set_corners(lane, primitives.triangle(pack.id[lane] & ~transmitting_bit).v);
            root.id[lane] = pack.id[lane];
            any |= maybe[lane];
        }
        for (int first = 0; first < pack_size; first += kernel_lanes) {
            hn::Vec<PackLanes> v[3][3];
            for (int corner = 0; corner < 3; ++corner)
                for (int axis = 0; axis < 3; ++axis) v[corner][axis] = hn::Load(d, root.v[corner][axis] + first);
            hn::Store(longest_edges(v), d, root.edge + first);
        }
        // No depth is known here to be beyond anything.
        lanes &=
            make_beam_triangles(root, quest.root, bounds_of(quest.root, any), std::numeric_limits<float>::infinity(),
                                0.0f, loose > 0.0f ? 1.0f : 0.0f, triangles);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int lane = __builtin_ctz(lanes);
            test(root, lane, triangles, maybe[lane]);
        }
    }

    HWY_NOINLINE void quadric(const RootQuadric& quadric, PacketMask packets)
    {
        if (!admits(quest.mask, quadric.transmits)) {
            quest.rays.may_pass |= packets;
            return;
        }
        quest.each_ray(packets, beam, [&](auto& single) {
            const float t = intersect_rounded(quadric, single.ray);
            if (std::isfinite(t)) single.take(t, 0.0f, 0.0f, quadric.id);
        });
    }
};

/// Triangles of the root system, for beams.
struct PackedTriangles {
    static constexpr bool stand_in_packs = true;
};

/// The primitives of a structure in the root system, for beams.
struct BeamRootPrimitives : PackedTriangles {
    explicit BeamRootPrimitives(const RootGeometry<float>& g) : geometry(g) {}
    const RootGeometry<float>& geometry;
    const RootQuadric& quadric(PrimitiveId id) const { return geometry.quadric(id); }
};

/// A pack of triangles that no structure has put together.
class PackOfPieces {
public:
    bool is_empty() const { return count_ == 0; }
    bool is_full() const { return count_ == pack_size; }
    void add(const RootTriangle<float>& triangle, std::uint32_t id_and_bit)
    {
        pack_.set(count_++, triangle, id_and_bit);
    }
    const TrianglePack& take()
    {
        while (count_ < pack_size) pack_.clear(count_++);
        count_ = 0;
        return pack_;
    }

private:
    TrianglePack pack_;
    int count_ = 0;
};

/// Tests the triangles that have lately kept a light's rays from where they ran.
template <class Quest>
HWY_INLINE void try_occluders(Quest& quest)
{
    const TrianglePack& pack = quest.occluders.pack();
    static const GridStructure none_at_all;
    const PackedTriangles primitives;
    BeamSearch<Quest, PackedTriangles> search{quest, quest.root, primitives, &none_at_all,
                                              quest.precision == Precision::fast ? 1.0f : 0.0f};
    search.wide = std::numeric_limits<float>::infinity();  // no depth is known here to be beyond anything
    if (quest.occluders.has_any()) search.pack(TrianglePack(pack), quest.root.packets);
}

/// Whether rays of a tile may walk as beams: they have a common apex, and nobody asks what each of them costs.
inline bool may_make_beams(const RayTile<float>& tile)
{
    const auto is_in_range = [](float x) { return std::abs(x) <= static_cast<float>(farthest_place); };
    return tile.common_apex && tile.cost == nullptr && tile.count >= fewest_rays && is_in_range(tile.apex.x) &&
           is_in_range(tile.apex.y) && is_in_range(tile.apex.z);
}

/// Sends every ray of a tile on its quest, in beams where that is possible.
/// searcher  `searcher(quest)` searches whatever there is for one ray, `searcher.beam(quest)` for a beam
template <Query query, typename Real, class Searcher>
HWY_INLINE void search_tile(RayTile<Real>& tile, Precision precision, const Searcher& searcher)
{
    std::fill_n(tile.primitive.begin(), tile.count, no_primitive);
    const auto one = [&](int lane) HWY_ATTR { search_ray<query>(tile, lane, searcher); };
    if constexpr (std::is_same_v<Real, float>) {
        if (may_make_beams(tile)) {
            Mailbox& mailbox = Mailbox::of_this_thread();
            Occluders& occluders = Occluders::of_this_thread();
            if (query == Query::any) occluders.begin_tile(tile.apex, searcher.version());
            search_by_beams(
                tile, searcher.top(),
                [&](BeamRays& rays, Beam& root) HWY_ATTR {
                    mailbox.begin_beam();
                    BeamQuest<query> quest{rays, root, mailbox, occluders, tile.mask, precision};
                    if (query == Query::any) try_occluders(quest);
                    searcher.beam(quest);
                },
                one);
            return;
        }
    }
    for (int lane = 0; lane < tile.count; ++lane) one(lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
