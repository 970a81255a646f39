#include "bench/micro/frame_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace firstray {
namespace {

constexpr int tile_size = 32, block_size = 4;  // pixels
constexpr float shadow_end = 1.0f - 1e-4f;     // stops short of the surface that is lit
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

static_assert(tile_size * tile_size <= RayTile<float>::capacity);

/// Pixel of a lane in a full tile, relative to the tile's corner: blocks row by row, pixels of a block row by row.
glm::ivec2 pixel_of_lane(int lane)
{
    constexpr int block_pixels = block_size * block_size, blocks_across = tile_size / block_size;
    const int block = lane / block_pixels, inside = lane % block_pixels;
    return {block % blocks_across * block_size + inside % block_size,
            block / blocks_across * block_size + inside / block_size};
}

}  // namespace

FrameRays::FrameRays(Pose pose, int width, int height, RayMask shadow_mask)
    : pose_(std::move(pose)),
      width_(width),
      height_(height),
      tiles_across_((width + tile_size - 1) / tile_size),
      shadow_mask_(shadow_mask),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      first_{0},
      hits_(pixels_, glm::vec3(nan))
{
    for (int y = 0; y < height; y += tile_size)
        for (int x = 0; x < width; x += tile_size) {
            const int pixels = std::min(tile_size, width - x) * std::min(tile_size, height - y);
            first_.push_back(first_.back() + static_cast<std::size_t>(pixels));
        }
}

std::size_t FrameRays::batches(Phase phase) const
{
    const std::size_t tiles = first_.size() - 1;
    return phase == Phase::primary ? tiles : tiles * pose_.lights.size();
}

void FrameRays::load(Phase phase, std::size_t batch, RayTile<float>& tile) const
{
    if (phase == Phase::primary) return load_primary(batch, tile);
    const std::size_t lights = pose_.lights.size();
    load_shadow(batch / lights, pose_.lights[batch % lights], tile);
}

void FrameRays::load_primary(std::size_t tile_index, RayTile<float>& tile) const
{
    const View& view = pose_.scene->view;
    const CameraPose& camera = pose_.camera;
    const double tangent = std::tan(glm::radians(view.angle) / 2.0);
    const int tile_number = static_cast<int>(tile_index);
    const glm::ivec2 corner = tile_size * glm::ivec2(tile_number % tiles_across_, tile_number / tiles_across_);

    tile.count = 0;
    tile.common_apex = true;
    tile.apex = glm::vec3(camera.eye);
    tile.mask = RayMask::all;
    for (int lane = 0; lane < tile_size * tile_size; ++lane) {
        const glm::ivec2 pixel = corner + pixel_of_lane(lane);
        if (pixel.x >= width_ || pixel.y >= height_) continue;
        const double x = (2.0 * (pixel.x + 0.5) - width_) / height_, y = 1.0 - 2.0 * (pixel.y + 0.5) / height_;
        tile.set_direction(tile.count, camera.forward + tangent * (x * camera.right + y * camera.up));
        tile.set_interval(tile.count++, static_cast<float>(view.hither));  // t is the distance along the view axis
    }
}

void FrameRays::load_shadow(std::size_t tile_index, const glm::dvec3& light, RayTile<float>& tile) const
{
    tile.count = 0;
    tile.common_apex = true;
    tile.apex = glm::vec3(light);
    tile.mask = shadow_mask_;
    for (std::size_t pixel = first_[tile_index]; pixel < first_[tile_index + 1]; ++pixel) {
        if (std::isnan(hits_[pixel].x)) continue;
        tile.set_direction(tile.count, glm::vec3(glm::dvec3(hits_[pixel]) - light));
        tile.set_interval(tile.count++, 0.0f, shadow_end);
    }
}

void FrameRays::set_hits(std::span<const float> t)
{
    const auto tile = std::make_unique<RayTile<float>>();
    std::size_t hit_pixels = 0;
    for (std::size_t batch = 0; batch + 1 < first_.size(); ++batch) {
        load_primary(batch, *tile);
        for (int lane = 0; lane < tile->count; ++lane) {
            const std::size_t pixel = first_[batch] + static_cast<std::size_t>(lane);
            const bool hit = std::isfinite(t[pixel]);
            hits_[pixel] = hit ? tile->apex + t[pixel] * tile->direction_of(lane) : glm::vec3(nan);
            hit_pixels += hit;
        }
    }
    shadow_rays_ = hit_pixels * pose_.lights.size();
}

}  // namespace firstray
