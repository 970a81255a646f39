#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace firstray::inline v0 {

/// Deals the pixels of a picture out into turns, for frameless rendering: frame after frame traces the pixels of one
/// turn and keeps what it has of the others, so that every pixel is at most `turns - 1` frames old.
///
/// A turn's pixels are random but evenly spread: along a Hilbert curve, of every `turns` pixels in a row, which lie
/// close together, each turn gets one at random. They come in the curve's order, so that neighbours in a tile of rays
/// are near each other in the picture.
/// source  G. Bishop et al., "Frameless Rendering: Double Buffering Considered Harmful", SIGGRAPH 1994
class FramelessTurns {
public:
    /// width, height  of the picture, >= 1
    /// turns          >= 1; 1 traces every pixel in every frame
    /// seed           another one deals otherwise
    /// throws         std::invalid_argument
    FramelessTurns(int width, int height, int turns, std::uint64_t seed);

    std::size_t count() const { return first_.size() - 1; }  ///< of turns

    /// The pixels of a turn. Turns repeat: turn `count()` is turn 0 again.
    std::span<const glm::ivec2> pixels(std::size_t turn) const;

private:
    std::vector<glm::ivec2> pixels_;  // turn by turn
    std::vector<std::size_t> first_;  // by turn: where its pixels begin; one entry more than turns
};

/// All pixels of a picture in the order of a Hilbert curve over the smallest enclosing square whose side is a power of
/// two.
std::vector<glm::ivec2> hilbert_order(int width, int height);

}  // namespace firstray::inline v0
