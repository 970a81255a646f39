#include "engine/strategy/root_geometry.h"

namespace firstray {
namespace {

bool has_finite_corners(const auto& triangle)
{
    for (const auto& corner : triangle.v)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(corner[axis])) return false;
    return true;
}

}  // namespace

template <typename Real>
RootGeometry<Real>::RootGeometry(const Scene& scene)
    : scene_(scene),
      corners_(scene.primitive_count()),
      transmits_(scene.primitive_count()),
      is_carried_(scene.groups.size()),
      was_visible_(scene.groups.size())
{
    vertices_.resize(scene.positions.size());
    for (const Part& part : scene.parts) {
        const Group& group = scene.groups[part.group];
        for (PrimitiveId id = part.first; id < part.first + part.count; ++id) {
            transmits_[id] = scene.materials[part.material].transmits();
            if (id - group.first < group.triangles)
                corners_[id] = scene.triangles[id - group.first + group.first_triangle].vertex;
        }
    }
}

template <typename Real>
void RootGeometry<Real>::update(const Pose& pose, const Executor* executor)
{
    std::vector<const Group*> to_carry;
    for (const Group& group : scene_.groups)
        if (pose.is_visible(group) && !is_carried_[static_cast<std::size_t>(&group - scene_.groups.data())])
            to_carry.push_back(&group);

    const auto carry = [&](std::size_t i) {
        carry_vertices(pose, *to_carry[i], vertices_.data() + to_carry[i]->first_vertex);
    };
    if (executor)
        executor->for_each(to_carry.size(), carry);
    else
        for (std::size_t i = 0; i < to_carry.size(); ++i) carry(i);
    list_visible(pose);
}

template <typename Real>
void RootGeometry<Real>::list_visible(const Pose& pose)
{
    bool same_groups = !triangles_.empty() || !quadrics_.empty();
    bool quadrics_move = false;
    for (std::size_t g = 0; g < scene_.groups.size(); ++g) {
        const Group& group = scene_.groups[g];
        const std::uint8_t visible = pose.is_visible(group);
        same_groups = same_groups && visible == was_visible_[g];
        was_visible_[g] = visible;
        quadrics_move = quadrics_move || (group.quadrics > 0 && !is_carried_[g]);
        is_carried_[g] = visible && group.node == 0 && !group.deforming;
    }
    if (!same_groups) triangles_.clear();
    if (!same_groups || quadrics_move) quadrics_.clear();
    for (const Group& group : scene_.groups) {
        if (!pose.is_visible(group)) continue;
        if (!same_groups)
            for (PrimitiveId id = group.first; id < group.first + group.triangles; ++id)
                if (has_finite_corners(triangle(id))) triangles_.push_back(id);
        if (same_groups && !quadrics_move) continue;
        for (std::uint32_t i = 0; i < group.quadrics; ++i) {
            const PrimitiveId id = group.first + group.triangles + i;
            quadrics_.push_back(place_quadric(scene_.quadrics[group.first_quadric + i], pose.root_from_node[group.node],
                                              id, transmits(id)));
        }
    }
}

template <typename Real>
std::uint64_t RootGeometry<Real>::bytes() const
{
    return vertices_.capacity() * sizeof(Vec) + corners_.capacity() * sizeof(glm::uvec3) + transmits_.capacity() +
           triangles_.capacity() * sizeof(PrimitiveId) + quadrics_.capacity() * sizeof(RootQuadric);
}

template class RootGeometry<float>;
template class RootGeometry<double>;

}  // namespace firstray
