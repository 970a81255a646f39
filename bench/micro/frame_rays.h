#pragma once
#include <span>
#include <vector>

#include "engine/core/ray_tile.h"
#include "engine/render/camera_rays.h"
#include "engine/scene/pose.h"

namespace firstray {

enum class Phase { update, primary, shadow, scattered };

/// The rays of one frame, recorded so that every strategy gets the same ones. They come in batches as a renderer makes
/// them: tiles of 32 x 32 pixels in blocks of 4 x 4, primary rays from the eye through the pixels' centres, then per light
/// the rays from the light to what the tile's primary rays hit. Scattered rays start there, one each, in random
/// directions that turn back towards the eye's side: nothing about them is coherent.
class FrameRays {
public:
    /// pose    has the camera and the lights; kept
    /// width, height  of the picture, pixels
    FrameRays(Pose pose, int width, int height, RayMask shadow_mask);

    const Pose& pose() const { return pose_; }

    /// Tells where the primary rays hit: without it there are no shadow rays.
    /// t  by batch, lane for lane as load() gives them; infinity where nothing is hit
    void set_hits(std::span<const float> t);

    std::size_t batches(Phase phase) const;
    /// Fills `tile` with a batch's rays, no ray at all where a light has nothing to see.
    /// phase  not update
    void load(Phase phase, std::size_t batch, RayTile<float>& tile) const;
    std::size_t count(Phase phase) const;

private:
    void load_primary(std::size_t tile_index, RayTile<float>& tile) const;
    void load_shadow(std::size_t tile_index, const glm::dvec3& light, RayTile<float>& tile) const;
    void load_scattered(std::size_t tile_index, RayTile<float>& tile) const;

    Pose pose_;
    CameraRays camera_;
    RayMask shadow_mask_;
    std::size_t hit_pixels_ = 0;
    std::vector<glm::ivec2> pixels_;  // tile by tile
    std::vector<std::size_t> first_;  // by tile: where its pixels begin; one entry more than tiles
    std::vector<glm::vec3> hits_;     // by pixel, root system; NaN where nothing is hit
};

}  // namespace firstray
