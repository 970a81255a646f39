#include "engine/render/shadow_tracer.h"

#include <algorithm>

#include "engine/render/shade.h"

namespace firstray::inline v0 {
namespace {

bool transmits_anywhere(const Scene& scene)
{
    return std::any_of(scene.parts.begin(), scene.parts.end(),
                       [&](const Part& part) { return scene.materials[part.material].transmits(); });
}

}  // namespace

template <typename Real>
ShadowTracer<Real>::ShadowTracer(MeteredSearch<Real>& search, const Scene& scene)
    : search_(search), scene_(scene), any_transmitting_(transmits_anywhere(scene))
{
}

template <typename Real>
auto ShadowTracer<Real>::trace(std::span<const Surface> surfaces, const Slots& slots, const glm::dvec3& light)
    -> const Visibility&
{
    std::fill_n(visibility_.begin(), surfaces.size(), 0.0f);
    aim(surfaces, slots, light);
    if (rays_.count == 0) return visibility_;
    rays_.mask = any_transmitting_ ? RayMask::opaque : RayMask::all;
    rays_traced_ += static_cast<std::uint64_t>(rays_.count);
    may_pass_.fill(any_transmitting_ ? 1 : 0);
    rays_.may_pass = any_transmitting_ ? may_pass_.data() : nullptr;
    search_.occluded(rays_, slots_);
    rays_.may_pass = nullptr;
    drop_finished();
    follow_through_transmitting();
    return visibility_;
}

/// One ray for each surface that responds to the light.
template <typename Real>
void ShadowTracer<Real>::aim(std::span<const Surface> surfaces, const Slots& slots, const glm::dvec3& light)
{
    using Vec = typename RayTile<Real>::Vec;
    rays_.common_apex = true;
    rays_.apex = Vec(light);
    const glm::dvec3 apex(rays_.apex);  // as rounded, so that the ray ends where it should all the same
    int count = 0;
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        if (!responds_to(surfaces[k], light - surfaces[k].point)) continue;
        rays_.set_direction(count, Vec(end_of_shadow_ray<Real>(surfaces[k], light) - apex));
        rays_.set_interval(count, Real(0), Real(1));
        surface_[static_cast<std::size_t>(count)] = static_cast<std::uint16_t>(k);
        slots_[static_cast<std::size_t>(count++)] = slots[k];
    }
    rays_.count = count;
}

/// Lets the light through to the surfaces of rays that met nothing, and keeps those that may meet what transmits, in
/// order.
template <typename Real>
void ShadowTracer<Real>::drop_finished()
{
    int kept = 0;
    for (int i = 0; i < rays_.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        if (rays_.primitive[lane] != no_primitive) continue;
        visibility_[surface_[lane]] = 1.0f;
        rays_traced_ += any_transmitting_;
        if (may_pass_[lane] != 0) keep(kept++, i);
    }
    rays_.count = kept;
}

/// Dims the light at one transmitting surface after the other, from the light on. Each search begins where the last one
/// ended, exclusively: t grows with every hit, so this ends, and surfaces that a ray meets at exactly the same t, such
/// as two triangles at their common edge, dim it once.
template <typename Real>
void ShadowTracer<Real>::follow_through_transmitting()
{
    rays_.mask = RayMask::transmitting;
    while (rays_.count > 0) {
        search_.closest(rays_, slots_);
        int kept = 0;
        for (int i = 0; i < rays_.count; ++i) {
            const auto lane = static_cast<std::size_t>(i);
            if (rays_.primitive[lane] == no_primitive) continue;
            visibility_[surface_[lane]] *= scene_.material(rays_.primitive[lane]).transmittance;
            rays_.set_interval(i, rays_.t_max[lane], Real(1));
            keep(kept++, i);
        }
        rays_.count = kept;
        rays_traced_ += static_cast<std::uint64_t>(kept);
    }
}

/// Moves a ray to an earlier or the same place.
template <typename Real>
void ShadowTracer<Real>::keep(int to, int from)
{
    const auto target = static_cast<std::size_t>(to), source = static_cast<std::size_t>(from);
    rays_.set_direction(to, rays_.direction_of(from));
    rays_.set_interval(to, rays_.t_min[source], rays_.t_max[source]);
    surface_[target] = surface_[source];
    slots_[target] = slots_[source];
}

template class ShadowTracer<float>;
template class ShadowTracer<double>;

}  // namespace firstray::inline v0
