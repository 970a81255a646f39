#pragma once
#include <functional>
#include <string>

#include "engine/scene/track.h"

namespace firstray::scenes {

/// Times at which a motion is written down: `steps` equal steps from start to end, and one more key before and after,
/// which the format wants for the tangents.
struct Beat {
    double start = 0.0, end = 1.0;
    int steps = 1;  ///< >= 1
};

/// Keys of a motion; each part is optional (an empty function leaves the track out).
/// turn  a rotation matrix; consecutive keys should differ by far less than 180 degrees
Animation motion(const std::string& name, const Beat& beat, const std::function<glm::dvec3(double)>& place,
                 const std::function<glm::dmat3(double)>& turn = {},
                 const std::function<glm::dvec3(double)>& scale = {});

/// The rotation of a camera (or of anything whose front is -z) at `from` that looks at `at`, y up.
glm::dmat3 looking(const glm::dvec3& from, const glm::dvec3& at);

/// 0 before `low`, 1 after `high`, smooth in between.
double ease(double low, double high, double x);

}  // namespace firstray::scenes
