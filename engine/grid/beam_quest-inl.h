// What a beam looks for and has found. Included once per instruction set.
#if defined(FIRSTRAY_BEAM_QUEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FIRSTRAY_BEAM_QUEST_INL_H_
#undef FIRSTRAY_BEAM_QUEST_INL_H_
#else
#define FIRSTRAY_BEAM_QUEST_INL_H_
#endif

#include "engine/grid/packet_kernels-inl.h"
#include "engine/grid/search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

/// A beam on its way: what its rays look for and what they have found, in whatever structures it meets.
template <Query looks_for>
struct BeamQuest {
    static constexpr Query query = looks_for;

    BeamRays& rays;
    Beam& root;
    Mailbox& mailbox;
    Occluders& occluders;
    RayMask mask;
    Precision precision;

    /// Tests a triangle against packets, `beam` being the one that walks now.
    /// seen         the triangle that `triangle()` gives
    /// id_and_bit   with transmitting_bit
    template <class Triangle>
    HWY_NOINLINE void test(const ApexTriangle& seen, std::uint32_t id_and_bit, PacketMask packets, Beam& beam,
                           const Triangle& triangle)
    {
        const PrimitiveId id = id_and_bit & ~transmitting_bit;
        bool is_met = false, has_plane = false, has_sides = false;
        ApexPlane plane;
        const auto plane_of = [&]() -> const ApexPlane& {
            if (!has_plane) plane = make_apex_plane(triangle(), rays.apex);
            has_plane = true;
            return plane;
        };
        ApexSides sides;
        const auto sides_of = [&]() -> const ApexSides& {
            if (!has_sides) sides = make_apex_sides(triangle(), rays.apex);
            has_sides = true;
            return sides;
        };
        for (; packets != 0; packets &= packets - 1) {
            const int packet = __builtin_ctzll(packets);
            const PacketHits found = test_packet<query == Query::any>(seen, id, precision != Precision::fast, rays,
                                                                      packet * packet_size, plane_of, sides_of);
            std::uint32_t hits = found.hits;
            for (std::uint32_t rest = found.uncertain; rest != 0; rest &= rest - 1) {
                const int lane = __builtin_ctz(rest);
                const auto ray = static_cast<std::size_t>(packet * packet_size + lane);
                const TriangleHit<float> hit = intersect_precisely(triangle(), search_ray(ray), precision, rays.t[ray]);
                if (hit.hit && take(ray, hit.t, hit.u, hit.v, id)) hits |= 1u << lane;
            }
            if (hits == 0) continue;
            note_hits(packet, hits, beam);
            is_met = true;
        }
        if (query == Query::any && is_met) occluders.remember(triangle(), id_and_bit);
    }

    /// Sends each ray of the packets that still looks for something on a search of its own.
    /// search  `search(quest)`, a quest of one ray
    template <class Search>
    HWY_NOINLINE void each_ray(PacketMask packets, Beam& beam, const Search& search)
    {
        for (; packets != 0; packets &= packets - 1) {
            const int packet = __builtin_ctzll(packets);
            std::uint32_t hits = 0;
            for (int lane = 0; lane < packet_size; ++lane) {
                const auto ray = static_cast<std::size_t>(packet * packet_size + lane);
                if (!(rays.t_min[ray] < rays.t[ray])) continue;
                const SearchRay<float> single = search_ray(ray);
                Quest<query, float, NoCost> quest{
                    single, mask, {}, {rays.t[ray], rays.u[ray], rays.v[ray], rays.id[ray]}};
                search(quest);
                if (quest.may_pass) rays.may_pass |= PacketMask{1} << packet;
                if (quest.hit.id == rays.id[ray] && quest.hit.t == rays.t[ray]) continue;
                put(ray, quest.hit.t, quest.hit.u, quest.hit.v, quest.hit.id);
                hits |= 1u << lane;
            }
            if (hits != 0) note_hits(packet, hits, beam);
        }
    }

private:
    SearchRay<float> search_ray(std::size_t ray) const
    {
        return {rays.apex, rays.direction_of(ray), rays.t_min[ray], rays.t[ray]};
    }
    void put(std::size_t ray, float t, float u, float v, PrimitiveId id)
    {
        rays.t[ray] = t;
        rays.u[ray] = u;
        rays.v[ray] = v;
        rays.id[ray] = id;
    }
    bool take(std::size_t ray, float t, float u, float v, PrimitiveId id)
    {
        if (!(t > rays.t_min[ray]) || !Hit<float>{rays.t[ray], 0, 0, rays.id[ray]}.is_beaten_by(t, id)) return false;
        put(ray, t, u, v, id);
        return true;
    }
    /// Rays of a packet have hit something: it needs to reach less far, or they are done.
    void note_hits(int packet, std::uint32_t hits, Beam& beam)
    {
        if constexpr (query == Query::any)
            for (; hits != 0; hits &= hits - 1)
                rays.t[static_cast<std::size_t>(packet * packet_size + __builtin_ctz(hits))] =
                    -std::numeric_limits<float>::infinity();
        root.reach[packet] = reach_of(rays, root, packet);
        beam.reach[packet] = root.reach[packet] * beam.scale[packet];
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#endif  // include guard per instruction set
