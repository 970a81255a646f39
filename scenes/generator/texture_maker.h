#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>

namespace firstray::scenes {

/// Writes a picture as binary PPM.
/// colour  of the point (u, v) in [0, 1)^2, v downwards; clamped to [0, 1]
void write_texture(const std::filesystem::path& file, int width, int height,
                   const std::function<glm::dvec3(double, double)>& colour);

/// Smooth noise in [0, 1] over the plane that repeats every `period` units.
double noise(double x, double y, int period, std::uint64_t seed);
/// Octaves of noise, each of half the size and weight of the one before; in [0, 1].
double clouds(double x, double y, int period, int octaves, std::uint64_t seed);

/// Textures that repeat seamlessly. Lengths: what one tile of texture is meant to cover.
void write_cobbles(const std::filesystem::path& file, std::uint64_t seed);  ///< 4 m of rounded stones
void write_meadow(const std::filesystem::path& file, std::uint64_t seed);   ///< 60 m of grass
void write_plaster(const std::filesystem::path& file, std::uint64_t seed);  ///< 4 m, nearly white
void write_slabs(const std::filesystem::path& file,
                 std::uint64_t seed);  ///< 5 m of stone slabs, small dark ones between
void write_masonry(const std::filesystem::path& file, std::uint64_t seed);   ///< 4 m of ashlar blocks
void write_parquet(const std::filesystem::path& file, std::uint64_t seed);   ///< 2 m of herringbone wood
void write_turf(const std::filesystem::path& file, std::uint64_t seed);      ///< 20 m of mown stripes
void write_painting(const std::filesystem::path& file, std::uint64_t seed);  ///< an abstract picture; does not repeat

}  // namespace firstray::scenes
