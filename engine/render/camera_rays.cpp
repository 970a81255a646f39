#include "engine/render/camera_rays.h"

#include <algorithm>
#include <cmath>

namespace firstray::inline v0 {
namespace {

constexpr int block_width = 4;

/// The pixels of one block that lie in the picture.
void append_block(glm::ivec2 first, glm::ivec2 end, std::vector<glm::ivec2>& pixels)
{
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) pixels.emplace_back(x, y);
}

}  // namespace

CameraRays camera_rays(const Pose& pose, int width, int height)
{
    const CameraPose& camera = pose.camera;
    const double half_height = std::tan(glm::radians(pose.scene->view.angle) / 2.0);
    const double half_width = half_height * width / height;
    const double pixel = 2.0 * half_height / height;
    return {.eye = camera.eye,
            .forward = camera.forward,
            .corner = camera.forward - camera.right * half_width + camera.up * half_height,
            .next_column = camera.right * pixel,
            .next_row = -camera.up * pixel,
            .hither = pose.scene->view.hither};
}

glm::dvec3 direction(const CameraRays& camera, const glm::dvec2& place)
{
    return glm::normalize(camera.corner + place.x * camera.next_column + place.y * camera.next_row);
}

glm::dvec3 project(const CameraRays& camera, const glm::dvec3& point)
{
    const glm::dvec3 from_eye = point - camera.eye;
    const double depth = glm::dot(from_eye, camera.forward);
    const glm::dvec3 from_corner = from_eye - depth * camera.corner;
    return {glm::dot(from_corner, camera.next_column) / glm::dot(camera.next_column, camera.next_column),
            glm::dot(from_corner, camera.next_row) / glm::dot(camera.next_row, camera.next_row), depth};
}

std::vector<glm::dvec2> sample_places(int samples)
{
    std::vector<glm::dvec2> places;
    const int side = static_cast<int>(std::lround(std::sqrt(samples)));
    if (side * side == samples) {
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) places.emplace_back((x + 0.5) / side, (y + 0.5) / side);
        return places;
    }
    const double plastic = 1.32471795724474602596;  // the real root of x^3 = x + 1
    const glm::dvec2 step(1.0 / plastic, 1.0 / (plastic * plastic));
    for (int i = 0; i < samples; ++i) places.push_back(glm::fract(0.5 + static_cast<double>(i) * step));
    return places;
}

glm::ivec2 tile_counts(int width, int height)
{
    return {(width + tile_width - 1) / tile_width, (height + tile_width - 1) / tile_width};
}

void tile_pixels(glm::ivec2 tile, int width, int height, std::vector<glm::ivec2>& pixels)
{
    const glm::ivec2 size(width, height), first = tile * tile_width;
    const glm::ivec2 end = glm::min(first + tile_width, size);
    pixels.clear();
    for (const bool clipped : {false, true})
        for (int y = first.y; y < end.y; y += block_width)
            for (int x = first.x; x < end.x; x += block_width) {
                const glm::ivec2 block(x, y), full_end = block + block_width, block_end = glm::min(full_end, end);
                if ((block_end != full_end) == clipped) append_block(block, block_end, pixels);
            }
}

template <typename Real>
void aim(const CameraRays& camera, std::span<const glm::ivec2> pixels, const glm::dvec2& place_in_pixel,
         RayTile<Real>& rays)
{
    using Vec = typename RayTile<Real>::Vec;
    rays.count = static_cast<int>(pixels.size());
    rays.common_apex = true;
    rays.mask = RayMask::all;
    rays.apex = Vec(camera.eye);
    for (int i = 0; i < rays.count; ++i) {
        const glm::dvec3 d = direction(camera, glm::dvec2(pixels[static_cast<std::size_t>(i)]) + place_in_pixel);
        rays.set_direction(i, Vec(d));
        rays.set_interval(i, static_cast<Real>(camera.hither / glm::dot(d, camera.forward)));
    }
}

template void aim<float>(const CameraRays&, std::span<const glm::ivec2>, const glm::dvec2&, RayTile<float>&);
template void aim<double>(const CameraRays&, std::span<const glm::ivec2>, const glm::dvec2&, RayTile<double>&);

}  // namespace firstray::inline v0
