#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/metered_search.h"
#include "engine/render/render.h"
#include "engine/render/shadow_tracer.h"
#include "engine/render/surface.h"

namespace firstray::inline v0 {

/// Follows the rays that spring from a tile of primary rays, all rays of one depth before the next. For one thread;
/// owns all buffers, so that tracing allocates nothing once they have grown. Large: keep it on the heap.
///
/// A pixel's colour is a sum in an order that only its own rays decide: by depth, reflected before transmitted rays,
/// and their parents' order. So it does not depend on which pixels share a tile.
template <typename Real>
class RayTree {
public:
    static constexpr int capacity = RayTile<Real>::capacity;

    /// strategy, pose, textures  must outlive the tree
    RayTree(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures, int depth, bool costs);

    /// To be filled before `trace`; afterwards it holds what the primary rays hit. Ray i stands for slot i.
    RayTile<Real>& primary() { return primary_; }

    /// Traces `primary` and everything that springs from it.
    /// colours  by slot; what the rays bring is added
    void trace(std::span<glm::vec3> colours);

    /// What the last `trace` cost, by slot; empty unless costs are wanted.
    const std::vector<RayCost>& costs() const { return search_.costs(); }

    /// Rays traced since the tree was made.
    RayCounts counts() const;

private:
    using Vec = typename RayTile<Real>::Vec;

    struct QueuedRay {
        Vec origin, direction;
        glm::vec3 weight;  ///< share of what the ray sees that the pixel gets
        std::uint16_t slot;
    };
    struct Generation {
        std::vector<QueuedRay> reflected, transmitted;
        bool empty() const { return reflected.empty() && transmitted.empty(); }
        void clear();
    };

    void trace_queue(std::span<const QueuedRay> queue, bool spawn, std::span<glm::vec3> colours);
    void load(std::span<const QueuedRay> queue);
    void trace_tile(RayTile<Real>& rays, bool spawn, std::span<glm::vec3> colours);
    void find_surfaces(const RayTile<Real>& rays);
    void light_surfaces();
    void spawn_from(const Surface& surface, const glm::vec3& weight, std::uint16_t slot);
    QueuedRay leaving(const Surface& surface, const glm::dvec3& direction, const glm::vec3& weight,
                      std::uint16_t slot) const;

    const Pose& pose_;
    std::span<const Texture> textures_;
    int depth_;
    RayCounts counts_;
    MeteredSearch<Real> search_;
    ShadowTracer<Real> shadows_;

    RayTile<Real> primary_, secondary_;
    Slots slots_;                     ///< by ray of the tile in hand
    std::vector<glm::vec3> weights_;  ///< likewise
    std::vector<glm::vec3> brought_;  ///< likewise: what each sees

    std::vector<Surface> surfaces_;  ///< what the tile in hand met; the three below are by surface
    Slots surface_slots_;
    std::vector<glm::vec3> surface_weights_;
    std::vector<std::size_t> surface_lanes_;

    Generation current_, next_;
};

}  // namespace firstray::inline v0
