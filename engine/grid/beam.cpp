#include "engine/grid/beam.h"

#include <algorithm>
#include <cstring>
#include <memory>

namespace firstray::inline v0 {

Mailbox& Mailbox::of_this_thread()
{
    thread_local Mailbox mailbox;
    return mailbox;
}

void Occluders::begin_tile(const glm::vec3& apex, std::uint64_t version)
{
    std::uint32_t bits[3];
    std::memcpy(bits, &apex, sizeof bits);
    light_ = ((bits[0] ^ bits[1] * 3u ^ bits[2] * 5u) * 2654435761u) >> 28;
    static_assert(lights == 16);
    Light& light = lights_[light_];
    if (light.version == version && light.apex == apex) return;
    light.apex = apex;
    light.version = version;
    light.count = light.next = 0;
    for (int lane = 0; lane < pack_size; ++lane) light.pack.clear(lane);
}

void Occluders::remember(const RootTriangle<float>& triangle, std::uint32_t id_and_bit)
{
    Light& light = lights_[light_];
    for (int lane = 0; lane < light.count; ++lane)
        if (light.pack.id[lane] == id_and_bit) return;
    light.pack.set(light.next, triangle, id_and_bit);
    light.count = std::max(light.count, light.next + 1);
    light.next = (light.next + 1) % most;
}

Occluders& Occluders::of_this_thread()
{
    thread_local const std::unique_ptr<Occluders> occluders = std::make_unique<Occluders>();
    return *occluders;
}

BeamRays& beam_rays_of_this_thread()
{
    thread_local const std::unique_ptr<BeamRays> rays = std::make_unique<BeamRays>();
    return *rays;
}

}  // namespace firstray::inline v0
