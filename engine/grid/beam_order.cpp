#include "engine/grid/beam_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace firstray::inline v0 {
namespace {

constexpr int directions = 6;  // an axis, forward or back

BeamAxes axes_of_class(int number)
{
    const int k = number >> 1;
    return {k == 0 ? 1 : 0, k == 2 ? 1 : 2, k, (number & 1) != 0 ? -1.0f : 1.0f};
}

int class_of(const glm::vec3& d)
{
    const glm::vec3 size = glm::abs(d);
    const int k = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    return 2 * k + (d[k] < 0.0f);
}

bool goes_along(const glm::vec3& d, const BeamAxes& axes)
{
    const float speed = d[axes.k] * axes.forward, end = speed * most_slope;
    return speed >= shortest_beam_ray && speed < longest_beam_ray && std::abs(d[axes.u]) <= end &&
           std::abs(d[axes.v]) <= end;
}

/// By the upper half of the keys, eight bits at a time.
void sort(std::uint32_t* keys, int count)
{
    std::uint32_t other[BeamPlaces::capacity];
    std::uint32_t* from = keys;
    std::uint32_t* to = other;
    for (const int shift : {16, 24}) {
        int place[256] = {};
        for (int i = 0; i < count; ++i) ++place[(from[i] >> shift) & 255u];
        for (int digit = 0, sum = 0; digit < 256; ++digit) sum += std::exchange(place[digit], sum);
        for (int i = 0; i < count; ++i) to[place[(from[i] >> shift) & 255u]++] = from[i];
        std::swap(from, to);
    }
}

struct Square {
    float lo_u = 1e30f, lo_v = 1e30f, hi_u = -1e30f, hi_v = -1e30f;
    void add(float u, float v)
    {
        lo_u = std::min(lo_u, u);
        hi_u = std::max(hi_u, u);
        lo_v = std::min(lo_v, v);
        hi_v = std::max(hi_v, v);
    }
    float area(float least) const
    {
        return lo_u > hi_u ? 0.0f : std::max(hi_u - lo_u, least) * std::max(hi_v - lo_v, least);
    }
};

Square around(const BeamPlaces& sorted, int begin, int end)
{
    Square s;
    for (int i = begin; i < end; ++i) {
        const std::uint32_t ray = sorted.key[i] & 0xffffu;
        s.add(sorted.u[ray], sorted.v[ray]);
    }
    return s;
}

/// Calls emit(begin, end) for runs of rays that fill the square around them.
template <typename Emit>
void for_each_cluster(const BeamPlaces& sorted, int begin, int end, int shift, float area, float least,
                      const Emit& emit)
{
    constexpr float worth_cutting = 0.5f;
    if (end - begin <= packet_size || shift < 16) return emit(begin, end);
    int cut[5] = {begin, begin, begin, begin, end};
    for (int quarter = 1; quarter < 4; ++quarter)
        cut[quarter] = static_cast<int>(
            std::partition_point(sorted.key + cut[quarter - 1], sorted.key + end,
                                 [&](std::uint32_t key) { return static_cast<int>((key >> shift) & 3u) < quarter; }) -
            sorted.key);
    float areas[4], sum = 0.0f;
    for (int quarter = 0; quarter < 4; ++quarter)
        sum += areas[quarter] = around(sorted, cut[quarter], cut[quarter + 1]).area(least);
    if (sum > worth_cutting * area) return emit(begin, end);
    for (int quarter = 0; quarter < 4; ++quarter)
        if (cut[quarter] < cut[quarter + 1])
            for_each_cluster(sorted, cut[quarter], cut[quarter + 1], shift - 2, areas[quarter], least, emit);
}

/// How many rays from one on make a packet that is narrow enough.
int rays_in_packet(const BeamPlaces& sorted, int begin, int end)
{
    Square square;
    float deepest = 0.0f;
    int i = begin;
    for (; i < std::min(end, begin + packet_size); ++i) {
        const std::uint32_t ray = sorted.key[i] & 0xffffu;
        square.add(sorted.u[ray], sorted.v[ray]);
        deepest = std::max(deepest, sorted.depth[ray]);
        if (columns_at(deepest, square.hi_u - square.lo_u, square.hi_v - square.lo_v) > sorted.most_columns) break;
    }
    return i - begin;
}

}  // namespace

BeamAxes axes_of(const glm::vec3& direction)
{
    return axes_of_class(class_of(direction));
}

void BeamOrder::take_all(int rays, const BeamAxes& axes)
{
    in_order = true;
    add({0, rays, axes});
}

void BeamOrder::split(const RayTile<float>& tile)
{
    constexpr std::uint8_t alone = directions;
    std::uint8_t number[capacity];
    int rays[directions + 1] = {};
    for (int lane = 0; lane < tile.count; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        const glm::vec3 d = tile.direction_of(lane);
        const int own = class_of(d);
        const bool fits = goes_along(d, axes_of_class(own)) && tile.t_min[i] >= 0.0f && tile.t_min[i] < tile.t_max[i];
        number[i] = fits ? static_cast<std::uint8_t>(own) : alone;
        ++rays[number[i]];
    }
    const int most = static_cast<int>(std::max_element(rays, rays + directions) - rays);
    const BeamAxes main = axes_of_class(most);
    int place[directions + 1] = {};
    std::fill_n(rays, directions + 1, 0);
    for (int lane = 0; lane < tile.count; ++lane) {
        std::uint8_t& own = number[lane];
        if (own != alone && goes_along(tile.direction_of(lane), main)) own = static_cast<std::uint8_t>(most);
        ++rays[own];
    }
    for (int n = 0, first = 0; n < directions; first += rays[n++]) {
        place[n] = first;
        if (rays[n] > 0) add({first, rays[n], axes_of_class(n)});
    }
    for (int lane = 0; lane < tile.count; ++lane) {
        if (number[lane] == alone)
            single[singles++] = lane;
        else
            lanes[place[number[lane]]++] = lane;
    }
    int kept = 0;
    for (int p = 0; p < count; ++p) {
        const BeamPart part = parts[p];
        if (part.count >= fewest_rays)
            parts[kept++] = part;
        else
            for (int i = part.first; i < part.first + part.count; ++i) single[singles++] = lanes[i];
    }
    count = kept;
}

BeamPart BeamOrder::only(const BeamPart& part, PacketMask packets)
{
    BeamPart left{part.first, 0, part.axes};
    for (; packets != 0; packets &= packets - 1) {
        const int begin = __builtin_ctzll(packets) * packet_size, end = std::min(begin + packet_size, part.count);
        for (int i = begin; i < end; ++i) lanes[part.first + left.count++] = in_order ? i : lanes[part.first + i];
    }
    in_order = false;
    return left;
}

void BeamOrder::cluster(const BeamPart& part, BeamPlaces& places)
{
    sort(places.key, part.count);
    std::int32_t sorted[capacity];
    for (int i = 0; i < part.count; ++i) {
        const int ray = static_cast<int>(places.key[i] & 0xffffu);
        sorted[i] = in_order ? ray : lanes[part.first + ray];
    }
    in_order = false;
    packed_ = 0;
    const float least = std::max(places.wide_u, places.wide_v) / 256.0f;
    for_each_cluster(places, 0, part.count, 30, places.wide_u * places.wide_v, least,
                     [&](int begin, int end) { pack(places, sorted, begin, end, part.axes); });
}

/// Rays that would be few in their packet go one by one.
/// begin, end  in the order of `sorted`
void BeamOrder::pack(const BeamPlaces& sorted, const std::int32_t* sorted_lanes, int begin, int end,
                     const BeamAxes& axes)
{
    BeamPart part{capacity + packed_, 0, axes};
    for (int i = begin, rays; i < end; i += rays) {
        rays = rays_in_packet(sorted, i, end);
        if (rays < fewest_rays) {
            rays = 1;
            single[singles++] = sorted_lanes[i];
            continue;
        }
        std::int32_t* const packet = lanes + capacity + packed_;
        std::copy_n(sorted_lanes + i, rays, packet);
        std::fill_n(packet + rays, packet_size - rays, ~sorted_lanes[i]);
        packed_ += packet_size;
        part.count += packet_size;
        if (part.count < capacity) continue;
        add(part);
        part = {capacity + packed_, 0, axes};
    }
    if (part.count > 0) add(part);
}

void BeamOrder::add(const BeamPart& part)
{
    parts[count++] = part;
}

}  // namespace firstray::inline v0
