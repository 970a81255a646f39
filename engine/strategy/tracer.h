#pragma once
#include <glm/glm.hpp>

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "engine/core/executor.h"
#include "engine/core/ray_tile.h"
#include "engine/scene/pose.h"
#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// Traces batches of rays through a scene that moves: says where things are each frame, then asks, as often as wanted
/// and from any number of threads. Rays and transforms are in the root system; for scenes made of meshes that is the
/// world, for others the world minus Scene::origin.
/// Real  float for Precision::fast and robust, double for double_, as the strategy's
template <typename Real>
class BasicTracer {
public:
    using Vec = glm::vec<3, Real, glm::defaultp>;  ///< a point or direction
    /// No end. (Called in a default of Ray, which is nested in a template, the function would crash g++ 12.)
    static constexpr Real infinity = std::numeric_limits<Real>::infinity();

    /// origin + t * direction, t in the open interval (t_min, t_max); the direction may have any length but zero.
    struct Ray {
        Vec origin{0};          ///< where it starts
        Vec direction{0};       ///< what t counts
        Real t_min = 0;         ///< near end
        Real t_max = infinity;  ///< far end
    };

    /// The nearest thing along a ray. Of meshes: `group`, `mesh` and `triangle` are numbers that Meshes gave or was
    /// given.
    struct Hit {
        Real t = infinity;                     ///< in lengths of the ray's direction
        Real u = 0, v = 0;                     ///< weights of a triangle's second and third corner
        std::uint32_t group = none;            ///< node in Scene::nodes
        std::uint32_t mesh = none;             ///< none too where the scene was read from a file
        std::uint32_t triangle = none;         ///< in the mesh (Part), from 0
        PrimitiveId primitive = no_primitive;  ///< in the scene

        explicit operator bool() const { return primitive != no_primitive; }  ///< something is hit
    };

    /// scene     outlives the tracer
    /// strategy  made for this scene
    /// executor  shares the rays of a batch among its threads; outlives the tracer; null: the caller's thread alone
    BasicTracer(const Scene& scene, std::unique_ptr<Strategy<Real>> strategy, const Executor* executor = nullptr);

    /// Says where the groups of Meshes are now, in order of their numbers from 1; reads live vertices. A transform that
    /// flattens its group hides it.
    /// visible  0 hides a group; empty: all are visible
    /// throws   Error (Fault::usage) while rays are traced, for another number of transforms than groups, for a
    ///          transform or a live vertex that is not finite: all stays as it was. If anything else is thrown, the
    ///          next update must succeed before rays are traced.
    void update(std::span<const Transform> root_from_group, std::span<const std::uint8_t> visible = {});

    /// The same with a pose of the scene, e.g. pose(scene, time) of one that was read from a file.
    void update(Pose pose);

    /// Finds each ray's nearest hit. Rays from one point are fastest together, neighbours beside each other.
    /// hits    as many as rays
    /// throws  Error (Fault::usage) before the first update, during one, and for another number of hits than rays
    void closest(std::span<const Ray> rays, std::span<Hit> hits, RayMask mask = RayMask::all) const;

    /// Finds out whether each ray meets anything: 1 if it does, else 0.
    /// throws  as closest
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> answers, RayMask mask = RayMask::all) const;

    /// What the structure consists of now. Not during an update.
    StructureReport report() const { return strategy_->report(); }

private:
    class Tracing;
    using Tile = RayTile<Real>;

    template <typename Answer>
    void for_tiles(std::span<const Ray> rays, std::size_t answers, RayMask mask, const Answer& answer) const;
    Hit hit_of(const Tile& tile, std::size_t lane) const;

    const Scene& scene_;
    std::unique_ptr<Strategy<Real>> strategy_;
    const Executor* executor_;
    Pose pose_;
    bool is_ready_ = false;              ///< the last update succeeded
    mutable std::atomic<int> users_{0};  ///< batches that are traced; -1 during an update
};

using Tracer = BasicTracer<float>;         ///< Precision::fast and robust
using DoubleTracer = BasicTracer<double>;  ///< Precision::double_

}  // namespace firstray::inline v0
