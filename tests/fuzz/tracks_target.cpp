#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "engine/scene/track.h"
#include "tests/fuzz/targets.h"

namespace firstray::fuzz {
namespace {

/// Any number that the reader lets pass: finite, in the range of float; many of them small and round.
double number(Taking& in)
{
    const unsigned kind = in.byte();
    if (kind < 200) return 0.25 * (static_cast<double>(kind) - 100.0);
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | in.byte();
    const double value = std::bit_cast<double>(bits);
    return std::abs(value) <= std::numeric_limits<float>::max() ? value : 0.0;
}

std::vector<Key> keys(Taking& in)
{
    std::vector<Key> result(4 + in.below(12));
    double time = 0.0;
    for (Key& key : result) {
        key.time = in.below(8) == 0 ? number(in) : time += 0.5 * in.below(4);
        key.value = {number(in), number(in), number(in)};
        key.angle = number(in);
        if (in.below(2) == 0) continue;
        key.tension = number(in);
        key.continuity = number(in);
        key.bias = number(in);
    }
    return result;
}

bool same(const Transform& a, const Transform& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

bool is_finite(const Transform& t)
{
    const glm::dvec3 sum = t.linear[0] + t.linear[1] + t.linear[2] + t.offset;
    return std::isfinite(sum.x + sum.y + sum.z);
}

}  // namespace

void tracks(Bytes input)
{
    Taking in(input);
    Animation animation;
    const unsigned has = in.byte();
    if (has & 1) animation.translation = VectorTrack(keys(in));
    if (has & 2) animation.rotation = RotationTrack(keys(in));
    if (has & 4) animation.scale = VectorTrack(keys(in));
    for (unsigned i = has >> 3; i > 0; --i) animation.visibility.push_back({number(in), in.below(2) == 1});
    for (int i = 0; i < 16; ++i) {
        const double time = number(in);
        const Transform now = animation.at(time);
        animation.visible_at(time);
        animation.at(number(in));
        if (is_finite(now) && !same(now, animation.at(time))) throw Finding("a pose depends on those before it");
    }
    if (animation.translation.empty()) return;
    const std::vector<Key>& path = animation.translation.keys();
    const double before = std::nextafter(path[1].time, -std::numeric_limits<double>::infinity());
    const glm::dvec3 first = animation.translation.at(path[1].time);  // not finite where tangents are beyond double
    if (std::isfinite(first.x + first.y + first.z) && animation.translation.at(before) != first)
        throw Finding("the first value is not held");
}

}  // namespace firstray::fuzz
