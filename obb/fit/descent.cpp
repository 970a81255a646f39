#include "obb/fit/descent.h"

#include <algorithm>
#include <array>

namespace firstray::inline v0::obb {
namespace {

/// A simplex of four turns about a start, ordered by cost.
class Simplex {
public:
    Simplex(const NearPoints& points, const Frame& start, const glm::dvec3& step) : points_(points), start_(start)
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
        return {turn, points_.cost_along(turned(start_.axes, turn))};
    }
    void shrink()
    {
        for (std::size_t i = 1; i < 4; ++i) corners_[i] = at((corners_[0].turn + corners_[i].turn) * 0.5);
    }
    void sort()
    {
        std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) { return a.cost < b.cost; });
    }

    const NearPoints& points_;
    Frame start_;
    std::array<Corner, 4> corners_;
    int evaluations_ = 0;
};

}  // namespace

Frame descend(const NearPoints& points, const Frame& start, const Descent& how)
{
    Simplex simplex(points, start, how.step);
    while (simplex.evaluations() < how.evaluations && !simplex.settled(how.precision)) simplex.move();
    return simplex.best();
}

}  // namespace firstray::inline v0::obb
