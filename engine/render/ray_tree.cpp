#include "engine/render/ray_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/render/shade.h"

namespace firstray::inline v0 {

template <typename Real>
RayTree<Real>::RayTree(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures, int depth,
                       bool costs)
    : pose_(pose),
      textures_(textures),
      depth_(depth),
      search_(strategy, costs),
      shadows_(search_, *pose.scene),
      weights_(capacity)
{
    surfaces_.reserve(capacity);
    surface_weights_.reserve(capacity);
    surface_lanes_.reserve(capacity);
    brought_.reserve(capacity);
}

template <typename Real>
RayCounts RayTree<Real>::counts() const
{
    RayCounts counts = counts_;
    counts.shadow = shadows_.rays_traced();
    return counts;
}

template <typename Real>
void RayTree<Real>::Generation::clear()
{
    reflected.clear();
    transmitted.clear();
}

template <typename Real>
void RayTree<Real>::trace(std::span<glm::vec3> colours)
{
    search_.reset();
    next_.clear();
    std::iota(slots_.begin(), slots_.end(), std::uint16_t{0});
    std::fill(weights_.begin(), weights_.end(), glm::vec3(1.0f));
    counts_.primary += static_cast<std::uint64_t>(primary_.count);
    trace_tile(primary_, depth_ > 0, colours);
    for (int level = 1; level <= depth_ && !next_.empty(); ++level) {
        std::swap(current_, next_);
        next_.clear();
        counts_.reflected += current_.reflected.size();
        counts_.transmitted += current_.transmitted.size();
        trace_queue(current_.reflected, level < depth_, colours);
        trace_queue(current_.transmitted, level < depth_, colours);
    }
}

template <typename Real>
void RayTree<Real>::trace_queue(std::span<const QueuedRay> queue, bool spawn, std::span<glm::vec3> colours)
{
    while (!queue.empty()) {
        const std::size_t count = std::min<std::size_t>(queue.size(), capacity);
        load(queue.first(count));
        trace_tile(secondary_, spawn, colours);
        queue = queue.subspan(count);
    }
}

template <typename Real>
void RayTree<Real>::load(std::span<const QueuedRay> queue)
{
    secondary_.count = static_cast<int>(queue.size());
    for (int i = 0; i < secondary_.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        secondary_.set_origin(i, queue[lane].origin);
        secondary_.set_direction(i, queue[lane].direction);
        secondary_.set_interval(i, Real(0));
        weights_[lane] = queue[lane].weight;
        slots_[lane] = queue[lane].slot;
    }
}

/// spawn  whether reflected and transmitted rays are wanted
template <typename Real>
void RayTree<Real>::trace_tile(RayTile<Real>& rays, bool spawn, std::span<glm::vec3> colours)
{
    search_.closest(rays, slots_);
    find_surfaces(rays);
    light_surfaces();
    for (std::size_t lane = 0; lane < brought_.size(); ++lane) colours[slots_[lane]] += weights_[lane] * brought_[lane];
    if (!spawn) return;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) spawn_from(surfaces_[k], surface_weights_[k], surface_slots_[k]);
}

/// Rays that met nothing see the background.
template <typename Real>
void RayTree<Real>::find_surfaces(const RayTile<Real>& rays)
{
    brought_.assign(static_cast<std::size_t>(rays.count), pose_.scene->background);
    surfaces_.clear();
    surface_weights_.clear();
    surface_lanes_.clear();
    for (int i = 0; i < rays.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        if (rays.primitive[lane] == no_primitive) continue;
        surface_lanes_.push_back(lane);
        surface_slots_[surfaces_.size()] = slots_[lane];
        surface_weights_.push_back(weights_[lane]);
        surfaces_.push_back(surface_at(pose_, textures_, ray_hit(rays, i)));
    }
}

template <typename Real>
void RayTree<Real>::light_surfaces()
{
    const auto lit = [&](std::size_t k) -> glm::vec3& { return brought_[surface_lanes_[k]]; };
    for (std::size_t k = 0; k < surfaces_.size(); ++k) lit(k) = ambient_term(surfaces_[k], pose_.scene->ambient);
    for (std::size_t light = 0; light < pose_.lights.size(); ++light) {
        const auto& visibility = shadows_.trace(surfaces_, surface_slots_, pose_.lights[light]);
        for (std::size_t k = 0; k < surfaces_.size(); ++k) {
            if (visibility[k] == 0.0f) continue;
            const glm::dvec3 to_light = pose_.lights[light] - surfaces_[k].point;
            lit(k) += visibility[k] * light_term(surfaces_[k], to_light, pose_.scene->lights[light].colour);
        }
    }
}

template <typename Real>
void RayTree<Real>::spawn_from(const Surface& surface, const glm::vec3& weight, std::uint16_t slot)
{
    const glm::vec3 black(0.0f);
    const glm::vec3 reflected = weight * surface.material->specular;
    if (reflected != black) next_.reflected.push_back(leaving(surface, reflected_direction(surface), reflected, slot));
    const glm::vec3 transmitted = weight * surface.material->transmittance;
    if (transmitted != black)
        next_.transmitted.push_back(leaving(surface, transmitted_direction(surface), transmitted, slot));
}

template <typename Real>
auto RayTree<Real>::leaving(const Surface& surface, const glm::dvec3& direction, const glm::vec3& weight,
                            std::uint16_t slot) const -> QueuedRay
{
    return {Vec(start_of_ray<Real>(surface, direction)), Vec(direction), weight, slot};
}

template class RayTree<float>;
template class RayTree<double>;

}  // namespace firstray::inline v0
