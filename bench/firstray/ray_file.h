#pragma once
#include <glm/glm.hpp>

#include <istream>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace firstray::command {

/// A ray in world coordinates, t in (t_min, t_max) in lengths of `direction`.
struct WorldRay {
    glm::dvec3 origin{0.0}, direction{0.0};
    double t_min = 0.0, t_max = 0.0;  ///< t_max may be infinite
};

/// What was found along a ray, as the search gave it: `Real` decides how many digits there are.
template <typename Real>
struct RayAnswer {
    Real t{0}, u{0}, v{0};
    PrimitiveId primitive = no_primitive;
};

/// Reads rays, "ox,oy,oz,dx,dy,dz,tmin,tmax" one a line. A first line of just these names, blank lines and lines that
/// begin with # are skipped.
/// name    of the file, for messages
/// throws  SceneError with line and column for a malformed line, FileError
std::vector<WorldRay> parse_rays(std::istream& in, const std::string& name);

/// As above, from a file; "-" is standard input.
std::vector<WorldRay> read_rays(const std::string& file);

/// "t,group,primitive,u,v\n" in the shortest digits that read back to the same bits; "inf,-1,-1,0,0\n" for a miss.
template <typename Real>
std::string format_answer(const Scene& scene, const RayAnswer<Real>& answer);

}  // namespace firstray::command
