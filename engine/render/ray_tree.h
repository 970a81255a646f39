#pragma once
#include <cstdint>
#include <optional>
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
/// What a plane mirrors of rays from one point comes from that point's mirror image: such rays are searched together,
/// as beams, and so are those that go straight through surfaces.
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

    static constexpr std::uint32_t alone = 0xffffffffu;
    struct QueuedRay {
        Vec origin{0}, direction{0};
        Real t_min = 0;
        glm::vec3 weight{0.0f};        ///< share of what the ray sees that the pixel gets
        std::uint32_t family = alone;  ///< index of the apex that it has in common with others
        std::uint32_t parent = 0;      ///< its number in the generation before
        std::uint16_t slot = 0;
    };
    struct Generation {
        std::vector<QueuedRay> reflected, transmitted;
        std::vector<Vec> apexes;  ///< of families
        bool empty() const { return reflected.empty() && transmitted.empty(); }
        void clear();
    };
    /// What follows a ray through the tree.
    struct Errand {
        std::uint32_t number;  ///< in its generation
        glm::vec3 weight;
    };

    void trace_queue(std::span<QueuedRay> queue, std::uint32_t first_number, bool spawn);
    void sort_by_parent(std::vector<QueuedRay>& queue, std::size_t parents);
    void sort_by_family(std::span<QueuedRay> queue);
    std::size_t end_of_tile(std::span<const QueuedRay> queue, std::size_t begin) const;
    void load(std::span<const QueuedRay> queue, std::span<const std::uint32_t> chosen);
    void trace_tile(RayTile<Real>& rays, bool spawn);
    void light_and_spawn(bool spawn);
    void spawn_from(std::size_t k);
    QueuedRay leaving(const Surface& surface, const glm::dvec3& direction, const std::optional<glm::dvec3>& apex);
    std::uint32_t family_of(const Vec& apex);

    const Pose& pose_;
    std::span<const Texture> textures_;
    int depth_;
    RayCounts counts_;
    MeteredSearch<Real> search_;
    ShadowTracer<Real> shadows_;

    RayTile<Real> primary_, secondary_;
    Slots slots_;                  ///< by ray of the tile in hand
    std::vector<Errand> errands_;  ///< likewise

    std::vector<Surface> surfaces_;  ///< what rays have met, to be lit together; the three below are by surface
    Slots surface_slots_;
    std::vector<Errand> surface_errands_;
    std::vector<glm::vec3> light_;

    std::vector<QueuedRay> sorted_;
    std::vector<std::uint32_t> family_sizes_;
    std::vector<std::uint32_t> order_;  ///< of a queue
    std::vector<glm::vec3> seen_;       ///< by number in the generation: what a ray brings to its pixel
    Generation current_, next_;
};

}  // namespace firstray::inline v0
