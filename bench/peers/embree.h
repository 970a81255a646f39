#pragma once
#include <memory>

#include "engine/strategy/strategy.h"

/// Intel Embree 3.13 as a benchmark peer. Compiled where CMake finds it: FIRSTRAY_HAVE_EMBREE is then defined.
///
/// What to know when numbers are compared:
/// - Rays are traced one by one, rtcIntersect1 and rtcOccluded1, in the order of the tile's lanes. Packets, ray streams
///   and filter callbacks are not used; a RayMask is Embree's own ray mask, whose test is compiled in for all queries.
/// - The precision robust sets RTC_SCENE_FLAG_ROBUST, fast does not. The sign of an edge is still decided in float:
/// hits
///   agree with ours up to rounding, not to the last bit, and ties between primitives are resolved arbitrarily.
/// - Hits are tested where our interval (t_min, t_max) overlaps t >= 0, which is all that Embree knows.
/// - Coordinates and directions beyond 1.8e18 are out of Embree's range.
/// - occluded() answers whether, not what: a ray that meets something names the lowest visible primitive's id.
/// - Embree limits TBB for the whole process: while any of these strategies lives, loops of all executors get at most
/// as
///   many threads as the largest executor that an Embree strategy was made with.
namespace firstray::peers {

/// Everything in one scene in the root system, rebuilt every frame with RTC_BUILD_QUALITY_MEDIUM (binned SAH).
std::unique_ptr<Strategy<float>> make_embree_medium(const Scene& scene, const StrategyOptions& options);

/// Likewise with RTC_BUILD_QUALITY_LOW and RTC_SCENE_FLAG_DYNAMIC (Morton codes): builds faster, traces slower.
std::unique_ptr<Strategy<float>> make_embree_low(const Scene& scene, const StrategyOptions& options);

/// An instanced scene per group, built once with medium quality; a frame moves instances and rebuilds the tree over
/// them and the scenes of deforming groups.
std::unique_ptr<Strategy<float>> make_embree_two_level(const Scene& scene, const StrategyOptions& options);

}  // namespace firstray::peers
