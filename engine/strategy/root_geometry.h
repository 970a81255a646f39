#pragma once
#include <cstdint>
#include <vector>

#include "engine/core/aligned.h"
#include "engine/core/executor.h"
#include "engine/primitive/quadric.h"
#include "engine/primitive/triangle.h"
#include "engine/scene/pose.h"

namespace firstray {

/// All visible primitives of a pose, carried into the root system: what is tested, whatever structure chooses it.
/// Groups that cannot move are carried once; the others at every update.
template <typename Real>
class RootGeometry {
public:
    using Vec = glm::vec<3, Real, glm::defaultp>;

    explicit RootGeometry(const Scene& scene);

    /// Runs alone. The pose is not kept.
    void update(const Pose& pose, const Executor* executor);

    /// Ids of visible triangles and quadrics, ascending; valid until the next update.
    const std::vector<PrimitiveId>& triangles() const { return triangles_; }
    const std::vector<RootQuadric>& quadrics() const { return quadrics_; }

    RootTriangle<Real> triangle(PrimitiveId id) const
    {
        const glm::uvec3& c = corners_[id];
        const Vec &v0 = vertices_[c.x], &v1 = vertices_[c.y], &v2 = vertices_[c.z];
        return {{v0, v1, v2}, longest_edge<Real>(v0, v1, v2)};
    }
    bool transmits(PrimitiveId id) const { return transmits_[id] != 0; }
    std::uint64_t bytes() const;

private:
    void list_visible(const Pose& pose);

    const Scene& scene_;
    RawVector<Vec> vertices_;                ///< by index in Scene::positions
    std::vector<glm::uvec3> corners_;        ///< by PrimitiveId, into vertices_
    std::vector<std::uint8_t> transmits_;    ///< by PrimitiveId
    std::vector<std::uint8_t> is_carried_;   ///< by group: already where it will always be
    std::vector<std::uint8_t> was_visible_;  ///< by group, at the last update
    std::vector<PrimitiveId> triangles_;
    std::vector<RootQuadric> quadrics_;
};

}  // namespace firstray
