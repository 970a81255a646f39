#pragma once
#include <array>
#include <span>

#include "engine/render/metered_search.h"
#include "engine/render/surface.h"

namespace firstray::inline v0 {

/// Finds how much of a light reaches surfaces, a tile at a time. Shadow rays run from the light (t = 0) to the surface
/// (t = 1), so that a tile of them has a common apex. Large: keep it on the heap.
template <typename Real>
class ShadowTracer {
public:
    static constexpr int capacity = RayTile<Real>::capacity;
    using Visibility = std::array<float, capacity>;

    /// search  must outlive the tracer
    ShadowTracer(MeteredSearch<Real>& search, const Scene& scene);

    /// What is left of the light at each surface, in [0, 1]; 0 for surfaces that do not respond to it.
    /// surfaces  at most `capacity`
    /// slots     the surfaces' pixels
    /// light     root system
    /// returns   by surface, until the next call
    const Visibility& trace(std::span<const Surface> surfaces, const Slots& slots, const glm::dvec3& light);

    /// Rays traced so far: one for each surface that responds to a light, and one for each further look for a
    /// transmitting surface, even if the search before could tell that there is none.
    std::uint64_t rays_traced() const { return rays_traced_; }

private:
    void aim(std::span<const Surface> surfaces, const Slots& slots, const glm::dvec3& light);
    void drop_finished();
    void follow_through_transmitting();
    void keep(int to, int from);

    MeteredSearch<Real>& search_;
    const Scene& scene_;
    bool any_transmitting_;
    std::uint64_t rays_traced_ = 0;
    RayTile<Real> rays_;
    Slots slots_;                                  ///< by ray: its pixel
    std::array<std::uint16_t, capacity> surface_;  ///< by ray: the surface it runs to
    std::array<std::uint8_t, capacity> may_pass_;  ///< by ray: whether it may meet what transmits
    Visibility visibility_;
};

}  // namespace firstray::inline v0
