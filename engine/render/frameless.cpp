#include "engine/render/frameless.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace firstray::inline v0 {
namespace {

/// SplitMix64: the same numbers on every platform, which the standard's distributions are not.
/// source  G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    /// In [0, end); the bias of the remainder is below 2^-32 for the numbers asked for here.
    std::size_t below(std::size_t end) { return static_cast<std::size_t>(next() % end); }

private:
    std::uint64_t next()
    {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

/// The place at `distance` along the curve through a square of `side` x `side`, from coarse to fine in reverse: what is
/// already placed is turned into the quadrant that the next two bits name.
/// source  D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891
glm::ivec2 hilbert_place(std::uint64_t distance, int side)
{
    glm::ivec2 place(0);
    for (int half = 1; half < side; half *= 2, distance /= 4) {
        const bool right = (distance & 2) != 0, lower = right != ((distance & 1) != 0);
        if (!lower) {
            if (right) place = half - 1 - place;
            std::swap(place.x, place.y);
        }
        place += glm::ivec2(right ? half : 0, lower ? half : 0);
    }
    return place;
}

void shuffle(std::vector<std::size_t>& order, Random& random)
{
    for (std::size_t end = order.size(); end > 1; --end) std::swap(order[end - 1], order[random.below(end)]);
}

/// By pixel of the curve: its turn.
std::vector<std::size_t> deal(std::size_t pixels, std::size_t turns, std::uint64_t seed)
{
    Random random(seed);
    std::vector<std::size_t> order(turns), turn_of;
    std::iota(order.begin(), order.end(), std::size_t{0});
    turn_of.reserve(pixels);
    while (turn_of.size() < pixels) {
        shuffle(order, random);
        const std::size_t run = std::min(turns, pixels - turn_of.size());
        turn_of.insert(turn_of.end(), order.begin(), order.begin() + static_cast<std::ptrdiff_t>(run));
    }
    return turn_of;
}

}  // namespace

std::vector<glm::ivec2> hilbert_order(int width, int height)
{
    const auto side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(width, height))));
    const auto places = static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    std::vector<glm::ivec2> order;
    order.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::uint64_t distance = 0; distance < places; ++distance) {
        const glm::ivec2 place = hilbert_place(distance, side);
        if (place.x < width && place.y < height) order.push_back(place);
    }
    return order;
}

FramelessTurns::FramelessTurns(int width, int height, int turns, std::uint64_t seed)
{
    if (width < 1 || height < 1) throw std::invalid_argument("a picture needs at least one pixel");
    if (turns < 1) throw std::invalid_argument("pixels must be dealt out into at least one turn");
    const std::vector<glm::ivec2> curve = hilbert_order(width, height);
    const std::vector<std::size_t> turn_of = deal(curve.size(), static_cast<std::size_t>(turns), seed);
    first_.assign(static_cast<std::size_t>(turns) + 1, 0);
    for (const std::size_t turn : turn_of) ++first_[turn + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    pixels_.resize(curve.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < curve.size(); ++i) pixels_[next[turn_of[i]]++] = curve[i];
}

std::span<const glm::ivec2> FramelessTurns::pixels(std::size_t turn) const
{
    const std::size_t begin = first_[turn % count()], end = first_[turn % count() + 1];
    return std::span(pixels_).subspan(begin, end - begin);
}

}  // namespace firstray::inline v0
