#include <cmath>

#include "scenes/generator/generate.h"
#include "scenes/generator/random.h"
#include "scenes/generator/walker.h"

namespace firstray::scenes {

/// The paper's first test: 300 x 300 pixels, empty space around one figure of many nested transforms.
std::uint64_t write_robot(const Request& request)
{
    constexpr double seconds = 8.0, radius = 3.0, speed = 1.15;
    Random random(request.seed);
    const Walk walk =
        circle_walk({0.0, seconds, 96}, radius, speed, request.seed == 1 ? 0.0 : random.between(0.0, 360.0));
    // from ahead and outside, so that it comes towards the picture
    const auto eye = [&](double t) {
        const glm::dvec3 out = walk.place(t) / radius;
        const double swing = glm::radians(walk.heading(t) - 38.0 - 14.0 * std::sin(0.7 * t));
        return walk.place(t) + 3.35 * glm::dvec3(std::sin(swing), 0.0, std::cos(swing)) + 0.2 * out +
               glm::dvec3(0.0, 1.55, 0.0);
    };
    const auto front = [&](double t) { return looking(eye(t), walk.place(t) + glm::dvec3(0.0, 0.97, 0.0)); };

    AffWriter out(request.file);
    out.comment(
        "A tin robot walks a circle in empty space, the camera goes with it. Made by firstray's generator; CC0.");
    out.view({.from = eye(0.0), .at = walk.place(0.0), .angle = 37.0, .hither = 0.1, .width = 300, .height = 300});
    out.frames(0.0, seconds, 192);
    out.background({0.56f, 0.66f, 0.70f});
    out.ambient({0.34f, 0.36f, 0.40f});
    out.light({60.0, 90.0, 40.0}, {0.72f, 0.68f, 0.60f});
    out.light({-70.0, 30.0, -50.0}, {0.30f, 0.34f, 0.42f});
    out.keys(motion("camera", walk.beat, eye, front));
    write_walker(out, "robot", walk, {});
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
