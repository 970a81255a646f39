#pragma once
#include <memory>
#include <string>

#include "engine/strategy/strategy.h"

/// Intel Embree 3.13 as a benchmark peer. Compiled where CMake finds it: FIRSTRAY_HAVE_EMBREE is then defined.
///
/// What to know when numbers are compared:
/// - Rays with a common apex are traced as packets with RTC_INTERSECT_CONTEXT_FLAG_COHERENT, in the order of the tile's
///   lanes, which for a picture's rays are blocks of 4 x 4 pixels: 16 at once with AVX-512, 8 with AVX2, 4 with SSE.
///   The time to lay them out as Embree wants them, and to bring the hits back, is in the trace's. Other rays are
///   traced one by one, rtcIntersect1 and rtcOccluded1. Ray streams are not used; a RayMask is Embree's own ray
///   mask, whose test is compiled in for all queries.
/// - RayTile::may_pass, which our own searches fill by the way, is filled by a filter callback of what transmits. It is
///   called only where such a thing is met, and only in queries that ask for it.
/// - Shadow packets through instances (embree-two-level) go without that flag: with it Embree 3.13.5 does not return on
///   some scenes. Why is not known.
/// - Spheres, cones and cylinders are user geometry that the engine's own test intersects, in double, ray by ray.
/// - Embree keeps to the instruction set that our kernels use when the strategy is made (engine/core/simd.h).
/// - The precision robust sets RTC_SCENE_FLAG_ROBUST, fast does not. The sign of an edge is still decided in float, so
///   hits agree with ours up to rounding, not to the last bit, and ties between primitives are resolved arbitrarily.
///   Packets and single rays, too, agree up to rounding.
/// - Hits are tested where our interval (t_min, t_max) overlaps t >= 0, which is all that Embree knows.
/// - Coordinates and directions beyond 1.8e18 are out of Embree's range.
/// - occluded() answers whether, not what: a ray that meets something names the lowest visible primitive's id.
/// - Embree limits TBB for the whole process: while any of these strategies lives, loops of all executors get at most
///   as many threads as the largest executor that an Embree strategy was made with.
namespace firstray::peers {

/// How rays are handed to Embree.
enum class Rays {
    packets,  ///< as many at once as the device has native packets for, where they have a common apex
    single    ///< one by one
};

struct Options {
    Rays rays = Rays::packets;
};

/// Everything in one scene in the root system, rebuilt every frame with RTC_BUILD_QUALITY_MEDIUM (binned SAH).
std::unique_ptr<Strategy<float>> make_embree_medium(const Scene& scene, const StrategyOptions& options, Options own);

/// Likewise with RTC_BUILD_QUALITY_LOW and RTC_SCENE_FLAG_DYNAMIC (Morton codes): builds faster, traces slower.
std::unique_ptr<Strategy<float>> make_embree_low(const Scene& scene, const StrategyOptions& options, Options own);

/// Likewise with geometries of RTC_BUILD_QUALITY_REFIT in a dynamic scene: their trees are of medium quality and built
/// once, their boxes then follow what moves, and the few nodes over them are made anew. All is built anew when groups
/// appear or vanish. Traces the slower the farther things have gone from where they were when it was built, so that
/// unlike the others' its speed depends on the frames before.
std::unique_ptr<Strategy<float>> make_embree_refit(const Scene& scene, const StrategyOptions& options, Options own);

/// An instanced scene per group, built once with medium quality; a frame moves instances and rebuilds the tree over
/// them and the scenes of deforming groups.
std::unique_ptr<Strategy<float>> make_embree_two_level(const Scene& scene, const StrategyOptions& options, Options own);

/// Rays that a strategy made now would trace at once: 16, 8 or 4, by the machine and the instruction set in use; 1
/// where Embree has no packets.
int embree_packet_width();

/// The version in use, e.g. "3.13.5".
std::string embree_version();

}  // namespace firstray::peers
