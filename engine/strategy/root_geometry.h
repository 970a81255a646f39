#pragma once
#include <atomic>
#include <cstdint>
#include <vector>

#include "engine/core/aligned.h"
#include "engine/core/executor.h"
#include "engine/primitive/quadric.h"
#include "engine/primitive/triangle.h"
#include "engine/scene/pose.h"

namespace firstray::inline v0 {

/// Ids, each list ascending.
struct PrimitiveList {
    std::vector<PrimitiveId> triangles, quadrics;
    std::size_t size() const { return triangles.size() + quadrics.size(); }
};

/// All visible primitives of a pose, carried into the root system: what is tested, whatever structure chooses it.
/// Groups that cannot move are carried once; the others at every update, or when they are first touched after it.
template <typename Real>
class RootGeometry {
public:
    using Vec = glm::vec<3, Real, glm::defaultp>;

    explicit RootGeometry(const Scene& scene);

    /// Carries every visible group and lists what is visible. Runs alone.
    void update(const Pose& pose, const Executor* executor);

    /// Carries nothing: that is left to touch(). Groups that stand where they stood stay carried. Runs alone. The pose
    /// must live until the next update.
    void update_on_touch(const Pose& pose);

    /// Whether a group stands, or deforms, otherwise than before the last update, or was or is hidden.
    bool has_moved(std::uint32_t group) const { return moved_[group] != 0; }

    /// Has a visible group carried, by the first thread that asks; any number of threads. False while another thread is
    /// at it: nobody waits, carried() makes single primitives.
    /// executor  only for who runs alone
    bool touch(std::uint32_t group, const Executor* executor = nullptr) const
    {
        return carried_[group].load(std::memory_order_acquire) == Carried::yes || carry_if_first(group, executor);
    }

    /// What is visible; valid until the next update. Only after update().
    const PrimitiveList& visible() const { return visible_; }

    /// Appends what there is to hit in a group that is carried.
    void list(std::uint32_t group, PrimitiveList& list) const;

    /// Primitives of groups that are carried.
    RootTriangle<Real> triangle(PrimitiveId id) const
    {
        const glm::uvec3& c = corners_[id];
        const Vec &v0 = vertices_[c.x], &v1 = vertices_[c.y], &v2 = vertices_[c.z];
        return {{v0, v1, v2}, longest_edge<Real>(v0, v1, v2)};
    }
    const RootQuadric& quadric(PrimitiveId id) const { return placed_[corners_[id].x]; }
    /// The same triangles' corners for who reads many: indices into vertices(), by PrimitiveId. Behind every group's
    /// vertices is memory for one more, so that four numbers may be read of each, whoever carries the next group.
    const glm::uvec3* corners() const { return corners_.data(); }
    const Vec* vertices() const { return vertices_.data(); }

    /// The same, the same bits, where the group may not have been touched yet. Only after update_on_touch().
    RootTriangle<Real> triangle_of(std::uint32_t group, PrimitiveId id) const
    {
        return touch(group) ? triangle(id) : carried_alone(id);
    }
    RootQuadric quadric_of(std::uint32_t group, PrimitiveId id) const;

    /// The same, and the group is left as it is.
    RootTriangle<Real> triangle_alone(std::uint32_t group, PrimitiveId id) const
    {
        return carried_[group].load(std::memory_order_acquire) == Carried::yes ? triangle(id) : carried_alone(id);
    }
    RootQuadric quadric_alone(std::uint32_t group, PrimitiveId id) const;

    /// Differs from that of every other geometry and of this one before its last update.
    std::uint64_t version() const { return version_; }

    bool transmits(PrimitiveId id) const { return transmits_[id] != 0; }
    /// Whether anything in a group does.
    bool group_transmits(std::uint32_t group) const { return group_transmits_[group] != 0; }
    std::uint64_t bytes() const;

private:
    enum class Carried : std::uint8_t { no, begun, yes };

    bool carry_if_first(std::uint32_t group, const Executor* executor) const;
    void carry(const Pose& pose, std::uint32_t group, const Executor* executor) const;
    RootTriangle<Real> carried_alone(PrimitiveId id) const;
    void list_visible(const Pose& pose);

    const Scene& scene_;
    const Pose* pose_ = nullptr;               ///< for groups that are carried when touched
    mutable RawVector<Vec> vertices_;          ///< group by group as in Scene::position, and an unused one after each
    mutable std::vector<RootQuadric> placed_;  ///< by index in Scene::quadrics
    RawVector<glm::uvec3> corners_;  ///< by PrimitiveId: of a triangle, into vertices_; of a quadric, x: into placed_
    std::vector<std::uint8_t> transmits_;                ///< by PrimitiveId
    std::vector<std::uint8_t> group_transmits_;          ///< by group
    mutable std::vector<std::atomic<Carried>> carried_;  ///< by group
    std::vector<Transform> stood_;                       ///< by group: root_from_node at the last update
    std::vector<std::uint8_t> is_there_, moved_;         ///< by group: visible at the last update; has_moved
    double time_ = 0.0;                                  ///< of the last update
    mutable std::vector<std::atomic<bool>> in_range_;    ///< by group: everything is, as last carried
    std::vector<std::uint8_t> was_listed_;               ///< by group, at the last update: visible, and finite
    std::uint64_t version_ = 0;
    PrimitiveList visible_;
};

}  // namespace firstray::inline v0
