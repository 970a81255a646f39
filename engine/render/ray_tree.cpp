#include "engine/render/ray_tree.h"

#include <algorithm>
#include <numeric>
#include <type_traits>
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
      errands_(capacity)
{
    surfaces_.reserve(capacity);
    surface_errands_.reserve(capacity);
    light_.reserve(capacity);
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
    apexes.clear();
}

template <typename Real>
void RayTree<Real>::trace(std::span<glm::vec3> colours)
{
    search_.reset();
    next_.clear();
    std::iota(slots_.begin(), slots_.end(), std::uint16_t{0});
    for (std::uint32_t i = 0; i < capacity; ++i) errands_[i] = {i, glm::vec3(1.0f)};
    counts_.primary += static_cast<std::uint64_t>(primary_.count);
    seen_.resize(static_cast<std::size_t>(primary_.count));
    trace_tile(primary_, depth_ > 0);
    light_and_spawn(depth_ > 0);
    for (std::size_t i = 0; i < seen_.size(); ++i) colours[i] += seen_[i];
    for (int level = 1; level <= depth_ && !next_.empty(); ++level) {
        std::swap(current_, next_);
        next_.clear();
        auto& [reflected, transmitted, apexes] = current_;
        // Surfaces were lit family by family: back into an order that knows nothing of families.
        sort_by_parent(reflected, seen_.size());
        sort_by_parent(transmitted, seen_.size());
        counts_.reflected += reflected.size();
        counts_.transmitted += transmitted.size();
        seen_.resize(reflected.size() + transmitted.size());
        trace_queue(reflected, 0, level < depth_);
        trace_queue(transmitted, static_cast<std::uint32_t>(reflected.size()), level < depth_);
        light_and_spawn(level < depth_);
        for (std::size_t i = 0; i < reflected.size(); ++i) colours[reflected[i].slot] += seen_[i];
        for (std::size_t i = 0; i < transmitted.size(); ++i)
            colours[transmitted[i].slot] += seen_[reflected.size() + i];
    }
}

/// parents  how many rays were in the generation before; each has one child in a queue at most
template <typename Real>
void RayTree<Real>::sort_by_parent(std::vector<QueuedRay>& queue, std::size_t parents)
{
    order_.assign(parents, none);
    for (std::size_t i = 0; i < queue.size(); ++i) order_[queue[i].parent] = static_cast<std::uint32_t>(i);
    sorted_.clear();
    for (const std::uint32_t place : order_)
        if (place != none) sorted_.push_back(queue[place]);
    std::swap(queue, sorted_);
}

/// first_number  of the queue's rays in their generation
template <typename Real>
void RayTree<Real>::trace_queue(std::span<QueuedRay> queue, std::uint32_t first_number, bool spawn)
{
    sort_by_family(queue);
    for (std::size_t begin = 0, end; begin < queue.size(); begin = end) {
        end = end_of_tile(queue, begin);
        const std::span<const std::uint32_t> chosen(order_.data() + begin, end - begin);
        load(queue, chosen);
        for (std::size_t lane = 0; lane < chosen.size(); ++lane)
            errands_[lane] = {first_number + chosen[lane], queue[chosen[lane]].weight};
        trace_tile(secondary_, spawn);
    }
}

/// Family by family, then those that are alone; families too small for beams are as good as that.
template <typename Real>
void RayTree<Real>::sort_by_family(std::span<QueuedRay> queue)
{
    constexpr std::uint32_t least = 8;
    family_sizes_.assign(current_.apexes.size(), 0);
    for (const QueuedRay& ray : queue)
        if (ray.family != alone) ++family_sizes_[ray.family];
    for (QueuedRay& ray : queue)
        if (ray.family != alone && family_sizes_[ray.family] < least) ray.family = alone;
    std::uint32_t alone_from = 0;
    for (std::uint32_t& size : family_sizes_) {  // from here on: where its next ray goes
        const std::uint32_t begin = alone_from;
        if (size >= least) alone_from += size;
        size = begin;
    }
    order_.resize(queue.size());
    for (std::size_t i = 0; i < queue.size(); ++i) {
        std::uint32_t& place = queue[i].family == alone ? alone_from : family_sizes_[queue[i].family];
        order_[place++] = static_cast<std::uint32_t>(i);
    }
}

/// Where rays of another family begin, or the tile is full; by place in `order_`.
template <typename Real>
std::size_t RayTree<Real>::end_of_tile(std::span<const QueuedRay> queue, std::size_t begin) const
{
    const std::size_t most = std::min(queue.size(), begin + capacity);
    std::size_t end = begin + 1;
    while (end < most && queue[order_[end]].family == queue[order_[begin]].family) ++end;
    return end;
}

template <typename Real>
void RayTree<Real>::load(std::span<const QueuedRay> queue, std::span<const std::uint32_t> chosen)
{
    const std::uint32_t family = queue[chosen.front()].family;
    secondary_.common_apex = family != alone;
    if (secondary_.common_apex) secondary_.apex = current_.apexes[family];
    secondary_.count = static_cast<int>(chosen.size());
    for (int i = 0; i < secondary_.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        const QueuedRay& ray = queue[chosen[lane]];
        secondary_.set_origin(i, ray.origin);
        secondary_.set_direction(i, ray.direction);
        secondary_.set_interval(i, ray.t_min);
        slots_[lane] = ray.slot;
    }
}

/// Lights surfaces that were met before if the tile's may be too many beside them. Rays that meet nothing see the
/// background.
/// spawn  whether reflected and transmitted rays are wanted
template <typename Real>
void RayTree<Real>::trace_tile(RayTile<Real>& rays, bool spawn)
{
    if (surfaces_.size() + static_cast<std::size_t>(rays.count) > capacity) light_and_spawn(spawn);
    search_.closest(rays, slots_);
    for (int i = 0; i < rays.count; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        const Errand& errand = errands_[lane];
        seen_[errand.number] = errand.weight * pose_.scene->background;
        if (rays.primitive[lane] == no_primitive) continue;
        surface_slots_[surfaces_.size()] = slots_[lane];
        surface_errands_.push_back(errand);
        surfaces_.push_back(surface_at(pose_, textures_, ray_hit(rays, i)));
    }
}

template <typename Real>
void RayTree<Real>::light_and_spawn(bool spawn)
{
    light_.clear();
    for (Surface& surface : surfaces_) {
        surface.texture = surface.place.colour();
        light_.push_back(ambient_term(surface, pose_.scene->ambient));
    }
    for (std::size_t light = 0; light < pose_.lights.size(); ++light) {
        const auto& visibility = shadows_.trace(surfaces_, surface_slots_, pose_.lights[light]);
        for (std::size_t k = 0; k < surfaces_.size(); ++k) {
            if (visibility[k] == 0.0f) continue;
            const glm::dvec3 to_light = pose_.lights[light] - surfaces_[k].point;
            light_[k] += visibility[k] * light_term(surfaces_[k], to_light, pose_.scene->lights[light].colour);
        }
    }
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
        seen_[surface_errands_[k].number] = surface_errands_[k].weight * light_[k];
        if (spawn) spawn_from(k);
    }
    surfaces_.clear();
    surface_errands_.clear();
}

/// k  number of the surface
template <typename Real>
void RayTree<Real>::spawn_from(std::size_t k)
{
    const Surface& surface = surfaces_[k];
    const Errand& errand = surface_errands_[k];
    const auto add = [&](std::vector<QueuedRay>& queue, const glm::vec3& weight, const glm::dvec3& direction,
                         const std::optional<glm::dvec3>& apex) {
        QueuedRay& ray = queue.emplace_back(leaving(surface, direction, apex));
        ray.weight = weight;
        ray.parent = errand.number;
        ray.slot = surface_slots_[k];
    };
    const glm::vec3 black(0.0f);
    const glm::vec3 reflected = errand.weight * surface.material->specular;
    if (reflected != black) add(next_.reflected, reflected, reflected_direction(surface), reflected_origin(surface));
    const glm::vec3 transmitted = errand.weight * surface.material->transmittance;
    if (transmitted != black)
        add(next_.transmitted, transmitted, transmitted_direction(surface), transmitted_origin(surface));
}

/// apex  where the ray seems to come from, if others may come from there too
template <typename Real>
auto RayTree<Real>::leaving(const Surface& surface, const glm::dvec3& direction, const std::optional<glm::dvec3>& apex)
    -> QueuedRay
{
    QueuedRay leaves;
    if constexpr (std::is_same_v<Real, float>) {  // there are no beams in double, and rounding the apex would show
        if (const auto ray = apex ? ray_from_apex<Real>(surface, *apex) : std::nullopt) {
            leaves.origin = ray->apex;
            leaves.direction = ray->direction;
            leaves.t_min = ray->t_min;
            leaves.family = family_of(ray->apex);
            return leaves;
        }
    }
    leaves.origin = Vec(start_of_ray<Real>(surface, direction));
    leaves.direction = Vec(direction);
    return leaves;
}

/// Families are found again by the very same apex: rays then are what they are whoever else is in the tile. Old ones
/// are forgotten, which costs time where very many planes take turns, and no more.
template <typename Real>
std::uint32_t RayTree<Real>::family_of(const Vec& apex)
{
    constexpr std::size_t remembered = 16;
    std::vector<Vec>& apexes = next_.apexes;
    const std::size_t end = apexes.size() > remembered ? apexes.size() - remembered : 0;
    for (std::size_t i = apexes.size(); i > end; --i)
        if (apexes[i - 1] == apex) return static_cast<std::uint32_t>(i - 1);
    apexes.push_back(apex);
    return static_cast<std::uint32_t>(apexes.size() - 1);
}

template class RayTree<float>;
template class RayTree<double>;

}  // namespace firstray::inline v0
