#include "engine/strategy/root_geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/search_ray.h"

namespace firstray::inline v0 {
namespace {

/// What is in a group, hidden or not, or listed one by one, because some of it cannot be hit.
enum Listed : std::uint8_t { not_at_all, wholly, one_by_one };

}  // namespace

template <typename Real>
RootGeometry<Real>::RootGeometry(const Scene& scene)
    : scene_(scene),
      placed_(scene.quadrics.size()),
      transmits_(scene.primitive_count()),
      group_transmits_(scene.groups.size()),
      carried_(scene.groups.size()),
      stood_(scene.groups.size()),
      is_there_(scene.groups.size()),
      moved_(scene.groups.size()),
      in_range_(scene.groups.size()),
      was_listed_(scene.groups.size())
{
    vertices_.resize(scene.vertex_count() + scene.groups.size());
    corners_.resize(scene.primitive_count());
    for (const Part& part : scene.parts) {
        const Group& group = scene.groups[part.group];
        const PrimitiveId end = part.first + part.count,
                          quadrics = std::clamp(group.first + group.triangles, part.first, end);
        const bool transmits = scene.materials[part.material].transmits();
        std::fill(transmits_.begin() + part.first, transmits_.begin() + end, transmits);
        if (transmits) group_transmits_[part.group] = 1;
        for (PrimitiveId id = part.first; id < quadrics; ++id)
            corners_[id] = scene.triangles[id - group.first + group.first_triangle].vertex + part.group;
        for (PrimitiveId id = quadrics; id < end; ++id)
            corners_[id] = glm::uvec3(id - group.first - group.triangles + group.first_quadric);
    }
}

template <typename Real>
void RootGeometry<Real>::carry(const Pose& pose, std::uint32_t group, const Executor* executor) const
{
    const Group& g = scene_.groups[group];
    bool in_range = carry_vertices(pose, g, vertices_.data() + g.first_vertex + group, executor);
    for (std::uint32_t i = 0; i < g.quadrics; ++i) {
        const PrimitiveId id = g.first + g.triangles + i;
        RootQuadric& placed = placed_[g.first_quadric + i];
        placed = place_quadric(scene_.quadrics[g.first_quadric + i], pose.root_from_node[g.node], id, transmits(id));
        in_range = in_range && !placed.bounds.empty();
    }
    in_range_[group].store(in_range, std::memory_order_relaxed);
    carried_[group].store(Carried::yes, std::memory_order_release);
}

template <typename Real>
void RootGeometry<Real>::update(const Pose& pose, const Executor* executor)
{
    update_on_touch(pose);
    std::vector<std::uint32_t> to_carry;
    for (std::uint32_t group = 0; group < scene_.groups.size(); ++group)
        if (pose.is_visible(scene_.groups[group]) && carried_[group].load() != Carried::yes) to_carry.push_back(group);
    const auto carry_one = [&](std::size_t i) { carry(pose, to_carry[i], executor); };
    if (executor)
        executor->for_each(to_carry.size(), carry_one);
    else
        for (std::size_t i = 0; i < to_carry.size(); ++i) carry_one(i);
    list_visible(pose);
}

template <typename Real>
void RootGeometry<Real>::update_on_touch(const Pose& pose)
{
    static std::atomic<std::uint64_t> versions{0};
    version_ = ++versions;
    const bool is_first = pose_ == nullptr;
    for (std::uint32_t i = 0; i < scene_.groups.size(); ++i) {
        const Group& group = scene_.groups[i];
        const Transform& stands = pose.root_from_node[group.node];
        const bool is_there = pose.is_visible(group);
        const bool same = stood_[i].linear == stands.linear && stood_[i].offset == stands.offset &&
                          is_there_[i] == is_there && !(group.deforming && (group.live || time_ != pose.time));
        moved_[i] = is_first || !same;
        is_there_[i] = is_there;
        stood_[i] = stands;
        if (moved_[i]) carried_[i].store(Carried::no, std::memory_order_relaxed);
    }
    pose_ = &pose;
    time_ = pose.time;
}

template <typename Real>
bool RootGeometry<Real>::carry_if_first(std::uint32_t group, const Executor* executor) const
{
    Carried expected = Carried::no;
    if (!carried_[group].compare_exchange_strong(expected, Carried::begun, std::memory_order_acquire))
        return expected == Carried::yes;
    try {
        carry(*pose_, group, executor);
    } catch (...) {  // no memory for the threads' shares: another may try again
        carried_[group].store(Carried::no, std::memory_order_relaxed);
        throw;
    }
    return true;
}

template <typename Real>
RootTriangle<Real> RootGeometry<Real>::carried_alone(PrimitiveId id) const
{
    const std::array<glm::dvec3, 3> corners = triangle_corners(*pose_, id);
    const Vec v0(corners[0]), v1(corners[1]), v2(corners[2]);
    return {{v0, v1, v2}, longest_edge<Real>(v0, v1, v2)};
}

template <typename Real>
RootQuadric RootGeometry<Real>::quadric_of(std::uint32_t group, PrimitiveId id) const
{
    touch(group);
    return quadric_alone(group, id);
}

template <typename Real>
RootQuadric RootGeometry<Real>::quadric_alone(std::uint32_t group, PrimitiveId id) const
{
    if (carried_[group].load(std::memory_order_acquire) == Carried::yes) return quadric(id);
    return place_quadric(scene_.quadrics[corners_[id].x], pose_->root_from_node[scene_.groups[group].node], id,
                         transmits(id));
}

template <typename Real>
void RootGeometry<Real>::list_visible(const Pose& pose)
{
    bool same = visible_.size() > 0;
    for (std::size_t g = 0; g < scene_.groups.size(); ++g) {
        const std::uint8_t listed = !pose.is_visible(scene_.groups[g])             ? not_at_all
                                    : in_range_[g].load(std::memory_order_relaxed) ? wholly
                                                                                   : one_by_one;
        same = same && listed == was_listed_[g] && listed != one_by_one;
        was_listed_[g] = listed;
    }
    if (same) return;
    visible_ = {};
    for (std::uint32_t g = 0; g < scene_.groups.size(); ++g)
        if (was_listed_[g] != not_at_all) list(g, visible_);
}

template <typename Real>
void RootGeometry<Real>::list(std::uint32_t index, PrimitiveList& list) const
{
    const Group& group = scene_.groups[index];
    const PrimitiveId quadrics = group.first + group.triangles;
    if (in_range_[index].load(std::memory_order_relaxed)) {
        const std::size_t before = list.triangles.size();
        list.triangles.resize(before + group.triangles);
        std::iota(list.triangles.begin() + static_cast<std::ptrdiff_t>(before), list.triangles.end(), group.first);
    } else {
        for (PrimitiveId id = group.first; id < quadrics; ++id)
            if (is_in_range(triangle(id).v)) list.triangles.push_back(id);
    }
    for (PrimitiveId id = quadrics; id < group.first + group.primitives(); ++id)
        if (!quadric(id).bounds.empty()) list.quadrics.push_back(id);
}

template <typename Real>
std::uint64_t RootGeometry<Real>::bytes() const
{
    return vertices_.capacity() * sizeof(Vec) + corners_.capacity() * sizeof(glm::uvec3) + transmits_.capacity() +
           group_transmits_.capacity() +
           (visible_.triangles.capacity() + visible_.quadrics.capacity()) * sizeof(PrimitiveId) +
           placed_.capacity() * sizeof(RootQuadric);
}

template class RootGeometry<float>;
template class RootGeometry<double>;

}  // namespace firstray::inline v0
