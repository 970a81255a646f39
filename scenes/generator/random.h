#pragma once
#include <glm/glm.hpp>

#include <cstdint>

namespace firstray::scenes {

/// Reproducible random numbers, the same with every standard library and compiler.
/// source  S. Vigna's splitmix64 (public domain): a counter and a mix of its bits
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// A stream of its own for thing `index` of kind `kind`, so that things may be made in any order.
    Random(std::uint64_t seed, std::uint64_t kind, std::uint64_t index)
        : state_(mixed(seed + step * (kind + 1)) + step * (index + 1))
    {
    }

    std::uint64_t bits() { return mixed(state_ += step); }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< in [0, 1)
    double between(double low, double high) { return low + (high - low) * unit(); }
    int below(int n) { return static_cast<int>(unit() * n); }  ///< in [0, n)
    bool chance(double probability) { return unit() < probability; }
    glm::dvec3 in_cube(double half)
    {
        const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
        return {x, y, z};
    }

    /// 64 bits that depend on every bit of x.
    static std::uint64_t mixed(std::uint64_t x)
    {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

private:
    static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u;  // odd, so that the counter meets every value
    std::uint64_t state_;
};

}  // namespace firstray::scenes
