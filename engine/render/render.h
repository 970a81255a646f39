#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "engine/render/frame.h"
#include "engine/render/texture.h"
#include "engine/scene/pose.h"
#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// What the user chooses about pictures.
struct RenderOptions {
    int width = 800, height = 600;  ///< >= 1
    int depth = 4;                  ///< rays in a row after the primary one, >= 0; 0 shades primary hits only
    int samples = 1;                ///< per pixel, >= 1; 1 is the pixel's centre
    bool costs = false;             ///< also fill the cells, tests and time layers (slower)
    bool (*cancelled)() = nullptr;  ///< asked before every tile, on any thread: true ends rendering with Cancelled
};

/// How many rays were traced, by kind.
struct RayCounts {
    std::uint64_t primary = 0, shadow = 0, reflected = 0, transmitted = 0;              ///< rays
    std::uint64_t total() const { return primary + shadow + reflected + transmitted; }  ///< of all kinds
    RayCounts& operator+=(const RayCounts& other);                                      ///< kind by kind
};

/// Renders the pose that the strategy was last updated to: Whitted's ray tree, tile by tile on the executor's threads.
/// The picture does not depend on the number of threads or on the strategy.
/// textures  by Scene::textures
/// frame     resized; every layer that the options ask for is filled
/// throws    std::invalid_argument for options out of range or textures that are not as many as the scene's;
///           what the strategy throws; Cancelled. The frame is then of no use
template <typename Real>
RayCounts render(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures,
                 const RenderOptions& options, const Executor& executor, Frame& frame);

/// Traces some pixels anew; the others keep what they have and grow older by a frame (Frame::age). A pixel that is
/// traced is the same, bit for bit, as in a frame that is rendered whole.
/// pixels  distinct; near ones beside each other trace fastest
/// frame   as a render with the same options left it
/// throws  as above, and std::invalid_argument for a frame of other options or a pixel outside of it
template <typename Real>
RayCounts render_pixels(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures,
                        const RenderOptions& options, const Executor& executor, std::span<const glm::ivec2> pixels,
                        Frame& frame);

}  // namespace firstray::inline v0
