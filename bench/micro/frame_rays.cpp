#include "bench/micro/frame_rays.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace firstray {
namespace {

constexpr float shadow_end = 1.0f - 1e-4f;  // stops short of the surface that is lit
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Uniform over the sphere, another one for each number.
glm::vec3 random_direction(std::uint32_t number)
{
    std::minstd_rand random(number + 1);
    random.discard(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (;;) {
        const float x = uniform(random), y = uniform(random), z = uniform(random);
        const float length = std::sqrt(x * x + y * y + z * z);
        if (length > 0.01f && length <= 1.0f) return glm::vec3(x, y, z) / length;
    }
}

}  // namespace

FrameRays::FrameRays(Pose pose, int width, int height, RayMask shadow_mask)
    : pose_(std::move(pose)), camera_(camera_rays(pose_, width, height)), shadow_mask_(shadow_mask), first_{0}
{
    const glm::ivec2 tiles = tile_counts(width, height);
    std::vector<glm::ivec2> tile;
    for (int y = 0; y < tiles.y; ++y)
        for (int x = 0; x < tiles.x; ++x) {
            tile_pixels({x, y}, width, height, tile);
            pixels_.insert(pixels_.end(), tile.begin(), tile.end());
            first_.push_back(pixels_.size());
        }
    hits_.assign(pixels_.size(), glm::vec3(nan));
}

std::size_t FrameRays::batches(Phase phase) const
{
    const std::size_t tiles = first_.size() - 1;
    return phase == Phase::shadow ? tiles * pose_.lights.size() : tiles;
}

std::size_t FrameRays::count(Phase phase) const
{
    if (phase == Phase::primary) return pixels_.size();
    return phase == Phase::shadow ? hit_pixels_ * pose_.lights.size() : hit_pixels_;
}

void FrameRays::load(Phase phase, std::size_t batch, RayTile<float>& tile) const
{
    if (phase == Phase::primary) return load_primary(batch, tile);
    if (phase == Phase::scattered) return load_scattered(batch, tile);
    const std::size_t lights = pose_.lights.size();
    load_shadow(batch / lights, pose_.lights[batch % lights], tile);
}

void FrameRays::load_primary(std::size_t tile_index, RayTile<float>& tile) const
{
    const std::size_t first = first_[tile_index], count = first_[tile_index + 1] - first;
    aim(camera_, std::span(pixels_).subspan(first, count), glm::dvec2(0.5), tile);
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

void FrameRays::load_scattered(std::size_t tile_index, RayTile<float>& tile) const
{
    tile.count = 0;
    tile.common_apex = false;
    tile.mask = RayMask::all;
    for (std::size_t pixel = first_[tile_index]; pixel < first_[tile_index + 1]; ++pixel) {
        if (std::isnan(hits_[pixel].x)) continue;
        const glm::vec3 back = glm::normalize(glm::vec3(pose_.camera.eye) - hits_[pixel]);
        const glm::vec3 any = random_direction(static_cast<std::uint32_t>(pixel));
        const float distance = glm::distance(glm::vec3(pose_.camera.eye), hits_[pixel]);
        tile.set_origin(tile.count, hits_[pixel] + back * (1e-4f * distance));
        tile.set_direction(tile.count, glm::dot(any, back) < 0.0f ? -any : any);
        tile.set_interval(tile.count++, 0.0f);
    }
}

void FrameRays::set_hits(std::span<const float> t)
{
    const auto tile = std::make_unique<RayTile<float>>();
    hit_pixels_ = 0;
    for (std::size_t batch = 0; batch + 1 < first_.size(); ++batch) {
        load_primary(batch, *tile);
        for (int lane = 0; lane < tile->count; ++lane) {
            const std::size_t pixel = first_[batch] + static_cast<std::size_t>(lane);
            const bool hit = std::isfinite(t[pixel]);
            hits_[pixel] = hit ? tile->apex + t[pixel] * tile->direction_of(lane) : glm::vec3(nan);
            hit_pixels_ += hit;
        }
    }
}

}  // namespace firstray
