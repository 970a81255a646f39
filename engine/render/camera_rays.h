#pragma once
#include <glm/glm.hpp>

#include <span>
#include <vector>

#include "engine/core/ray_tile.h"
#include "engine/scene/pose.h"

namespace firstray::inline v0 {

/// The primary rays of a picture: from the eye through a grid of square pixels at depth 1. Root system.
struct CameraRays {
    glm::dvec3 eye{0.0};                         ///< where they start
    glm::dvec3 forward{0.0, 0.0, -1.0};          ///< unit
    glm::dvec3 corner{0.0};                      ///< from the eye to the picture's upper left corner
    glm::dvec3 next_column{0.0}, next_row{0.0};  ///< from a pixel to the one on its right, and to the one below
    double hither = 0.0;                         ///< depth along `forward` where rays begin
};

CameraRays camera_rays(const Pose& pose, int width, int height);  ///< of a picture of this size

/// Unit direction through a place in the picture.
/// place  in pixels from the upper left corner, y down: the centre of pixel (i, j) is (i + 1/2, j + 1/2)
glm::dvec3 direction(const CameraRays& camera, const glm::dvec2& place);

/// Where a point is in the picture, homogeneous: (x * depth, y * depth, depth), with (x, y) a place as direction()
/// takes it and depth along `forward`, which is negative behind the eye. Straight lines stay straight.
glm::dvec3 project(const CameraRays& camera, const glm::dvec3& point);

/// Where in a pixel its samples lie, in [0, 1)^2: its centre for one, the centres of k x k equal cells for k * k,
/// otherwise the start of the R2 sequence.
/// source  M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018
std::vector<glm::dvec2> sample_places(int samples);

/// Pictures are rendered in square tiles; one fills a RayTile.
inline constexpr int tile_width = 32;
static_assert(tile_width * tile_width == RayTile<float>::capacity);

/// Tiles needed to cover a picture, columns and rows.
glm::ivec2 tile_counts(int width, int height);

/// Pixels of a tile, block by block of 4 x 4, so that runs of 16 rays make narrow beams. Blocks that the picture's edge
/// clips come last: every full block then starts at a multiple of 16.
/// pixels  replaced
void tile_pixels(glm::ivec2 tile, int width, int height, std::vector<glm::ivec2>& pixels);

/// Aims rays at one place in each pixel. Directions have unit length, so that t is a distance.
/// pixels  at most RayTile::capacity
template <typename Real>
void aim(const CameraRays& camera, std::span<const glm::ivec2> pixels, const glm::dvec2& place_in_pixel,
         RayTile<Real>& rays);

}  // namespace firstray::inline v0
