#pragma once
#include "obb/fit/near_points.h"

namespace firstray::inline v0::obb {

/// How a search downhill begins and ends.
struct Descent {
    glm::dvec3 step{0.1};    ///< of the first simplex, as turned(); the search ends up within some steps of its start
    int evaluations = 100;   ///< at most about so many
    double precision = 0.0;  ///< ends when its frames' costs differ by less, relatively
};

/// Goes downhill from a frame, with Nelder and Mead's simplex: the cost has kinks wherever a side is flush with an
/// edge, and the best frames lie in them. points   around start's axes; start's cost is theirs returns  a frame that is
/// no worse
Frame descend(const NearPoints& points, const Frame& start, const Descent& how);

}  // namespace firstray::inline v0::obb
