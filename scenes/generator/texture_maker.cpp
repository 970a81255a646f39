#include "scenes/generator/texture_maker.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/pending_file.h"
#include "scenes/generator/random.h"

namespace firstray::scenes {
namespace {

int wrapped(int i, int period)
{
    return ((i % period) + period) % period;
}

/// A number in [0, 1) for a place of a lattice.
double value_at(int i, int j, std::uint64_t seed)
{
    const auto place = static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint32_t>(j);
    return static_cast<double>(Random::mixed(Random::mixed(place + 1) + seed) >> 11) * 0x1p-53;
}

double smooth(double x)
{
    return x * x * (3.0 - 2.0 * x);
}

/// Cells of a brick pattern: which one a point is in, and how far from its edge, in units of x and y.
struct Brick {
    int column = 0, row = 0;
    double edge = 0.0;
};

/// columns, rows  bricks in the tile; odd rows are shifted by half a brick
Brick brick_at(double u, double v, int columns, int rows)
{
    const double y = v * rows, row = std::floor(y);
    const double x = u * columns + (static_cast<int>(row) % 2 ? 0.5 : 0.0), column = std::floor(x);
    const double dx = std::min(x - column, column + 1.0 - x) / columns;
    const double dy = std::min(y - row, row + 1.0 - y) / rows;
    return {wrapped(static_cast<int>(column), columns), static_cast<int>(row), std::min(dx, dy)};
}

/// Distance to the nearest and second nearest of points strewn one to a cell; which cell the nearest is of.
struct Stone {
    double nearest = 9.0, second = 9.0;
    int cell = 0;
};

Stone stone_at(double x, double y, int period, std::uint64_t seed)
{
    Stone stone;
    const int i0 = static_cast<int>(std::floor(x)), j0 = static_cast<int>(std::floor(y));
    for (int j = j0 - 1; j <= j0 + 1; ++j)
        for (int i = i0 - 1; i <= i0 + 1; ++i) {
            const int wi = wrapped(i, period), wj = wrapped(j, period);
            const double px = i + 0.25 + 0.5 * value_at(wi, wj, seed) + 0.25 * (j & 1);
            const double d = std::hypot(px - x, j + 0.3 + 0.4 * value_at(wi, wj, seed + 7) - y);
            if (d < stone.nearest)
                stone = {d, stone.nearest, wj * period + wi};
            else
                stone.second = std::min(stone.second, d);
        }
    return stone;
}

}  // namespace

void write_texture(const std::filesystem::path& file, int width, int height,
                   const std::function<glm::dvec3(double, double)>& colour)
{
    std::string bytes = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const glm::dvec3 c = glm::clamp(colour((i + 0.5) / width, (j + 0.5) / height), 0.0, 1.0);
            for (int k = 0; k < 3; ++k) bytes += static_cast<char>(static_cast<unsigned char>(c[k] * 255.0 + 0.5));
        }
    write_whole_file(file, bytes);
}

double noise(double x, double y, int period, std::uint64_t seed)
{
    const double fx = std::floor(x), fy = std::floor(y), sx = smooth(x - fx), sy = smooth(y - fy);
    const int i = static_cast<int>(fx), j = static_cast<int>(fy);
    const auto at = [&](int a, int b) { return value_at(wrapped(a, period), wrapped(b, period), seed); };
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), sx), glm::mix(at(i, j + 1), at(i + 1, j + 1), sx), sy);
}

double clouds(double x, double y, int period, int octaves, std::uint64_t seed)
{
    double sum = 0.0, weight = 0.5, total = 0.0;
    for (int k = 0; k < octaves; ++k) {
        sum += weight * noise(x, y, period, seed + static_cast<std::uint64_t>(k));
        total += weight;
        weight *= 0.5, x *= 2.0, y *= 2.0, period *= 2;
    }
    return sum / total;
}

void write_cobbles(const std::filesystem::path& file, std::uint64_t seed)
{
    write_texture(file, 512, 512, [&](double u, double v) {
        const Stone stone = stone_at(u * 18, v * 18, 18, seed);
        const double joint = smooth(std::clamp((stone.second - stone.nearest) * 3.5, 0.0, 1.0));
        const double tone = 0.62 + 0.26 * value_at(stone.cell, 3, seed) - 0.25 * stone.nearest * stone.nearest +
                            0.12 * (clouds(u * 32, v * 32, 32, 2, seed) - 0.5);
        const double warm = value_at(stone.cell, 5, seed) - 0.5;
        return glm::mix(glm::dvec3(0.27, 0.25, 0.22), tone * glm::dvec3(1.0 + 0.08 * warm, 0.96, 0.90 - 0.08 * warm),
                        joint);
    });
}

void write_meadow(const std::filesystem::path& file, std::uint64_t seed)
{
    write_texture(file, 256, 256, [&](double u, double v) {
        const double patch = clouds(u * 5, v * 5, 5, 4, seed), fine = noise(u * 128, v * 128, 128, seed + 9);
        const glm::dvec3 grass = glm::mix(glm::dvec3(0.36, 0.50, 0.20), glm::dvec3(0.66, 0.68, 0.34), patch);
        return grass * (0.85 + 0.25 * fine);
    });
}

void write_plaster(const std::filesystem::path& file, std::uint64_t seed)
{
    write_texture(file, 256, 256, [&](double u, double v) {
        const double stain = clouds(u * 4, v * 4, 4, 5, seed), grain = noise(u * 128, v * 128, 128, seed + 9);
        return glm::dvec3(1.0, 0.99, 0.97) * (0.80 + 0.16 * stain + 0.06 * grain);
    });
}

void write_slabs(const std::filesystem::path& file, std::uint64_t seed)
{
    write_texture(file, 512, 512, [&](double u, double v) {
        const int i = static_cast<int>(u * 4), j = static_cast<int>(v * 4);
        const double x = u * 4 - i, y = v * 4 - j, edge = std::min({x, y, 1.0 - x, 1.0 - y});
        const double diamond = std::abs(x - 0.5) + std::abs(y - 0.5);
        const bool dark = diamond > 0.76;  // the corners: a small square where four slabs meet
        const double vein = std::abs(clouds(u * 8 + i, v * 8 + j, 8, 4, seed) - 0.5);
        const glm::dvec3 stone = dark ? glm::dvec3(0.46, 0.31, 0.25) : glm::dvec3(0.84, 0.78, 0.68);
        return edge < 0.012 ? glm::dvec3(0.52, 0.47, 0.40) : stone * (0.86 + 0.10 * value_at(i, j, seed) + 0.4 * vein);
    });
}

void write_masonry(const std::filesystem::path& file, std::uint64_t seed)
{
    write_texture(file, 256, 256, [&](double u, double v) {
        const Brick brick = brick_at(u, v, 4, 8);
        const double tone =
            0.78 + 0.14 * value_at(brick.column, brick.row, seed) + 0.12 * clouds(u * 16, v * 16, 16, 3, seed);
        const double joint = smooth(std::clamp(brick.edge / 0.012, 0.0, 1.0));
        return glm::mix(glm::dvec3(0.46, 0.42, 0.36), glm::dvec3(1.0, 0.95, 0.86) * tone, joint);
    });
}

void write_parquet(const std::filesystem::path& file, std::uint64_t seed)
{
    // herringbone: planks of 1 x 4 cells; which way a cell's plank runs follows from its place along the diagonal
    write_texture(file, 512, 512, [&](double u, double v) {
        const double x = u * 16, y = v * 16;
        const int i = static_cast<int>(x), j = static_cast<int>(y), k = wrapped(i - j, 8);
        const bool along = k < 4;
        const int head_i = along ? wrapped(i - k, 16) : i, head_j = along ? j : wrapped(j - (7 - k), 16);
        const double s = along ? x - i + k : y - j + (7 - k), t = along ? y - j : x - i;
        const double edge = std::min({s, 4.0 - s, t, 1.0 - t});
        const double grain = clouds((along ? s : t) * (along ? 0.5 : 4.0) + head_i * 3.0,
                                    (along ? t : s) * (along ? 4.0 : 0.5) + head_j * 5.0, 64, 3, seed);
        const double tone = 0.66 + 0.22 * value_at(head_i, head_j * 2 + along, seed) + 0.28 * (grain - 0.5);
        return (edge < 0.05 ? 0.55 : 1.0) * tone * glm::dvec3(1.0, 0.74, 0.47);
    });
}

void write_turf(const std::filesystem::path& file, std::uint64_t seed)
{
    write_texture(file, 512, 512, [&](double u, double v) {
        const double stripe = smooth(std::clamp(0.5 + 12.0 * (std::abs(v - 0.5) - 0.25), 0.0, 1.0));
        const double fine = clouds(u * 128, v * 128, 128, 2, seed), wear = clouds(u * 6, v * 6, 6, 3, seed + 5);
        const glm::dvec3 grass = glm::mix(glm::dvec3(0.22, 0.46, 0.13), glm::dvec3(0.34, 0.60, 0.20), stripe);
        return grass * (0.72 + 0.4 * fine + 0.16 * wear);
    });
}

void write_painting(const std::filesystem::path& file, std::uint64_t seed)
{
    // bands of colour whose borders wander, in a palette of its own: three hues, one of them for accents
    Random random(seed);
    const double hue = random.unit() * 6.28;
    const auto tint = [](double h) { return 0.5 + 0.42 * glm::cos(glm::dvec3(h, h - 2.1, h - 4.2)); };
    const glm::dvec3 ground = tint(hue) * 0.5 + 0.4, main = tint(hue + 0.7) * 0.8, accent = tint(hue + 3.1);
    write_texture(file, 256, 256, [&](double u, double v) {
        const double bend = clouds(u * 3, v * 3, 8, 4, seed) - 0.5,
                     field = clouds(u * 2 + bend, v * 4 + 2 * bend, 8, 3, seed + 3);
        const double brush = 0.9 + 0.2 * noise(u * 8, v * 90, 128, seed + 5);
        const glm::dvec3 paint = field < 0.44 ? ground : field < 0.60 ? main : field < 0.635 ? accent : ground * 0.45;
        return paint * brush;
    });
}

}  // namespace firstray::scenes
