#include "obb/fit/start_frames.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "obb/fit/width_table.h"

namespace firstray::inline v0::obb {
namespace {

constexpr int sweep_steps = 16;       ///< about each axis: 5 degrees apart at most
constexpr double least_range = 1e-7;  ///< no steps about an axis that has less to offer

struct Pair {
    glm::dvec3 from, to;
};

Pair farthest_pair(const PointSet& points)
{
    Pair pair{points[0], points[0]};
    double farthest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = i + 1; k < points.size(); ++k) {
            const glm::dvec3 d = points[k] - points[i];
            if (const double distance = glm::dot(d, d); distance > farthest) {
                farthest = distance;
                pair = {points[i], points[k]};
            }
        }
    return pair;
}

glm::dvec3 farthest_from_line(const PointSet& points, const Pair& line)
{
    const glm::dmat3 axes = axes_along(line.to - line.from, glm::dvec3(0.0));
    glm::dvec3 result = line.from;
    double farthest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 d = points[i] - line.from;
        const double u = glm::dot(d, axes[1]), v = glm::dot(d, axes[2]);
        if (u * u + v * v > farthest) {
            farthest = u * u + v * v;
            result = points[i];
        }
    }
    return result;
}

/// A turn of the start's frame, and its cost by the table.
struct Turn {
    glm::dvec3 turn{0.0};
    double cost = 0.0;
};

/// Turns within a range about no turn, and how many there are about each axis; x runs fastest.
struct TurnGrid {
    glm::ivec3 steps{1};
    std::vector<Turn> turns;

    bool is_lowest(int index) const
    {
        const auto cost_at = [&](int i) { return turns[static_cast<std::size_t>(i)].cost; };
        for (int axis = 0, stride = 1; axis < 3; stride *= steps[axis++]) {
            const int place = index / stride % steps[axis];
            // of equal ones, the first
            if (place > 0 && cost_at(index - stride) <= cost_at(index)) return false;
            if (place + 1 < steps[axis] && cost_at(index + stride) < cost_at(index)) return false;
        }
        return true;
    }
};

TurnGrid grid_of_turns(const WidthTable& table, const glm::dvec3& range)
{
    TurnGrid grid;
    for (int axis = 0; axis < 3; ++axis) grid.steps[axis] = range[axis] >= least_range ? sweep_steps : 1;
    const int count = grid.steps.x * grid.steps.y * grid.steps.z;
    grid.turns.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const glm::ivec3 place(i % grid.steps.x, i / grid.steps.x % grid.steps.y, i / (grid.steps.x * grid.steps.y));
        const glm::dvec3 turn = range * ((2.0 * glm::dvec3(place) + 1.0) / glm::dvec3(grid.steps) - 1.0);
        const glm::dmat3 axes = turned(glm::dmat3(1.0), turn);
        grid.turns.push_back({turn, cost_of({table.width(axes[0]), table.width(axes[1]), table.width(axes[2])})});
    }
    return grid;
}

}  // namespace

std::vector<Frame> triangle_frames(const PointSet& points)
{
    const Pair line = farthest_pair(points);
    const glm::dvec3 third = farthest_from_line(points, line);
    const glm::dvec3 normal = glm::cross(line.to - line.from, third - line.from);
    const ExtremePair tips = extreme_pair(points, normal);
    const glm::dvec3 corners[5] = {line.from, line.to, third, points[tips.least], points[tips.most]};
    std::vector<Frame> frames;
    for (const auto& [a, b, c] :
         {std::array{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}})
        for (const auto& [from, to, other] : {std::array{a, b, c}, {b, c, a}, {c, a, b}})
            frames.push_back(
                frame_along(points, axes_along(corners[to] - corners[from], corners[other] - corners[from])));
    return frames;
}

std::vector<Frame> sweep(const PointSet& points, const Frame& start, const glm::dvec3& range, std::size_t count)
{
    const TurnGrid grid = grid_of_turns(WidthTable(points, start.axes), range);
    std::vector<Turn> lowest;
    for (std::size_t i = 0; i < grid.turns.size(); ++i)
        if (grid.is_lowest(static_cast<int>(i))) lowest.push_back(grid.turns[i]);
    std::sort(lowest.begin(), lowest.end(), [](const Turn& a, const Turn& b) { return a.cost < b.cost; });
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < std::min(count, lowest.size()); ++i)
        frames.push_back(frame_along(points, turned(start.axes, lowest[i].turn)));
    return frames;
}

}  // namespace firstray::inline v0::obb
