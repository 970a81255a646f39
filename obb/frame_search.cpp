#include "obb/frame_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace firstray::obb {
namespace {

constexpr int sweep_steps = 8;  ///< about each axis: 11 degrees apart at most

double cost_of(const glm::dvec3& size)
{
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// The rotation about `turn` whose half angle's tangent is its length (Rodrigues, Cayley).
glm::dmat3 turned(const glm::dmat3& axes, const glm::dvec3& turn)
{
    const double scale = 2.0 / (1.0 + glm::dot(turn, turn));
    glm::dmat3 result;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[i] = 1.0;
        result[i] = unit + scale * glm::cross(turn, unit + glm::cross(turn, unit));
    }
    return axes * result;
}

/// Any unit vector at right angles to a unit vector.
glm::dvec3 any_perpendicular(const glm::dvec3& v)
{
    const glm::dvec3 size = glm::abs(v);
    glm::dvec3 other(0.0);
    other[size.x <= size.y ? (size.x <= size.z ? 0 : 2) : (size.y <= size.z ? 1 : 2)] = 1.0;
    return glm::normalize(glm::cross(v, other));
}

/// Axes along `edge` and across it towards `across`, both of any length, zero and parallel included.
glm::dmat3 axes_along(const glm::dvec3& edge, const glm::dvec3& across)
{
    const double length = glm::length(edge);
    const glm::dvec3 first = length > 0.0 ? glm::normalize(edge / length) : glm::dvec3(1.0, 0.0, 0.0);
    glm::dvec3 second = across - glm::dot(across, first) * first;
    const double rest = glm::length(second);
    if (rest > 0.0) {  // what is left may be rounding: then it is not at right angles until the second time
        second /= rest;
        second -= glm::dot(second, first) * first;
    }
    second = glm::length(second) > 0.5 ? glm::normalize(second) : any_perpendicular(first);
    return {first, second, glm::cross(first, second)};
}

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

/// A simplex of four turns about a start, ordered by cost.
class Simplex {
public:
    Simplex(const PointSet& points, const Frame& start, const glm::dvec3& step) : points_(points), start_(start)
    {
        corners_[0] = {glm::dvec3(0.0), start.cost};
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 turn = step * -0.25;
            turn[i] = step[i];
            corners_[static_cast<std::size_t>(i) + 1] = at(turn);
        }
        sort();
    }

    int evaluations() const { return evaluations_; }
    bool settled(double precision) const { return corners_[3].cost <= corners_[0].cost * (1.0 + precision); }
    Frame best() const { return {turned(start_.axes, corners_[0].turn), corners_[0].cost}; }

    void move()
    {
        const glm::dvec3 middle = (corners_[0].turn + corners_[1].turn + corners_[2].turn) / 3.0;
        const glm::dvec3 away = middle - corners_[3].turn;
        const Corner mirrored = at(middle + away);
        if (mirrored.cost < corners_[0].cost) {
            const Corner beyond = at(middle + 2.0 * away);
            corners_[3] = beyond.cost < mirrored.cost ? beyond : mirrored;
        } else if (mirrored.cost < corners_[2].cost) {
            corners_[3] = mirrored;
        } else {
            const bool outside = mirrored.cost < corners_[3].cost;
            const Corner nearer = at(middle + (outside ? 0.5 : -0.5) * away);
            if (nearer.cost < std::min(mirrored.cost, corners_[3].cost))
                corners_[3] = nearer;
            else
                shrink();
        }
        sort();
    }

private:
    struct Corner {
        glm::dvec3 turn{0.0};
        double cost = 0.0;
    };

    Corner at(const glm::dvec3& turn)
    {
        ++evaluations_;
        return {turn, cost_of(bounds_along(points_, turned(start_.axes, turn)).size())};
    }
    void shrink()
    {
        for (std::size_t i = 1; i < 4; ++i) corners_[i] = at((corners_[0].turn + corners_[i].turn) * 0.5);
    }
    void sort()
    {
        std::stable_sort(corners_.begin(), corners_.end(),
                         [](const Corner& a, const Corner& b) { return a.cost < b.cost; });
    }

    const PointSet& points_;
    Frame start_;
    std::array<Corner, 4> corners_;
    int evaluations_ = 0;
};

}  // namespace

Frame frame_along(const PointSet& points, const glm::dmat3& axes)
{
    return {axes, cost_of(bounds_along(points, axes).size())};
}

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

glm::dvec3 turn_range(const glm::dvec3& size)
{
    static constexpr double eighth = 0.41421356237309503;  // tan(45 degrees / 2)
    const auto range = [](double a, double b) {
        const double longer = std::max(a, b);
        return longer > 0.0 ? std::min(eighth, 0.75 * std::min(a, b) / longer) : 0.0;
    };
    return {range(size.y, size.z), range(size.z, size.x), range(size.x, size.y)};
}

std::vector<Frame> sweep(const PointSet& points, const Frame& start, const glm::dvec3& range)
{
    constexpr int n = sweep_steps;
    std::vector<Frame> grid;
    grid.reserve(n * n * n);
    for (int i = 0; i < n * n * n; ++i) {
        const glm::dvec3 step(i % n, i / n % n, i / (n * n));
        grid.push_back(
            frame_along(points, turned(start.axes, range * ((2.0 * step + 1.0) / static_cast<double>(n) - 1.0))));
    }
    std::vector<Frame> lowest;
    for (int i = 0; i < n * n * n; ++i) {
        const auto lower_at = [&](int stride, int place) {
            const double cost = grid[static_cast<std::size_t>(i)].cost;
            return (place > 0 && grid[static_cast<std::size_t>(i - stride)].cost < cost) ||
                   (place + 1 < n && grid[static_cast<std::size_t>(i + stride)].cost < cost);
        };
        if (!lower_at(1, i % n) && !lower_at(n, i / n % n) && !lower_at(n * n, i / (n * n)))
            lowest.push_back(grid[static_cast<std::size_t>(i)]);
    }
    std::stable_sort(lowest.begin(), lowest.end(), [](const Frame& a, const Frame& b) { return a.cost < b.cost; });
    return lowest;
}

Frame descend(const PointSet& points, const Frame& start, const Descent& how)
{
    Simplex simplex(points, start, how.step);
    while (simplex.evaluations() < how.evaluations && !simplex.settled(how.precision)) simplex.move();
    return simplex.best();
}

}  // namespace firstray::obb
