#include <algorithm>
#include <cmath>

#include "scenes/generator/arcade.h"
#include "scenes/generator/generate.h"
#include "scenes/generator/random.h"
#include "scenes/generator/walker.h"

namespace firstray::scenes {
namespace {

constexpr double seconds = 10.0, speed = 1.1, meeting = -11.0;  // metres along z where the two parties meet
constexpr int lanes = 5;

constexpr Paint paints[] = {
    {{0.75f, 0.16f, 0.12f}, {0.92f, 0.86f, 0.72f}}, {{0.14f, 0.36f, 0.52f}, {0.93f, 0.72f, 0.28f}},
    {{0.88f, 0.60f, 0.14f}, {0.30f, 0.28f, 0.28f}}, {{0.24f, 0.46f, 0.34f}, {0.90f, 0.84f, 0.70f}},
    {{0.80f, 0.78f, 0.74f}, {0.70f, 0.22f, 0.16f}}, {{0.42f, 0.26f, 0.46f}, {0.88f, 0.80f, 0.66f}},
    {{0.30f, 0.55f, 0.58f}, {0.95f, 0.93f, 0.88f}}};

/// Even walkers come from the back, odd ones from the front; at the end they stand so close that their boxes overlap.
Walk walk_of(int index, Random& random)
{
    const double way = index % 2 == 0 ? 1.0 : -1.0;
    const int row = index / 2 / lanes, lane = index / 2 % lanes;
    const double pace = speed * random.between(0.98, 1.02), offset = random.between(0.0, 1.1);
    const glm::dvec3 end((lane - 0.5 * (lanes - 1)) * 0.84 + (row % 2) * 0.4 + random.between(-0.08, 0.08), 0.0,
                         meeting - way * (0.35 + 0.95 * row + (lane % 2) * 0.45));
    const double sway = random.between(0.1, 0.3), beat = random.between(0.0, 6.0);
    const auto place = [=](double t) {
        const double side = sway * std::sin(0.5 * t + beat) * (1.0 - ease(5.0, seconds, t));
        return end + glm::dvec3(side, 0.0, way * pace * (t - seconds));
    };
    const auto heading = [=](double t) {
        const glm::dvec3 along = place(t + 0.05) - place(t - 0.05);
        return glm::degrees(std::atan2(along.x, along.z));
    };
    return {{0.0, seconds, 110}, place, heading, [=](double t) { return offset + pace * t; }};
}

void write_settings(AffWriter& out)
{
    const auto eye = [](double t) { return glm::dvec3(3.3 - 0.22 * t, 2.5 - 0.05 * t, -1.2 - 0.33 * t); };
    const auto target = [](double t) { return glm::dvec3(-0.9 + 0.09 * t, 1.75 - 0.05 * t, -13.0); };
    const auto front = [&](double t) { return looking(eye(t), target(t)); };
    out.view({.from = eye(0.0), .at = target(0.0), .angle = 48.0, .hither = 0.1, .width = 800, .height = 600});
    out.frames(0.0, seconds, 240);
    out.background({0.62f, 0.76f, 0.92f});
    out.ambient({0.40f, 0.40f, 0.42f});
    out.light({2600.0, 9000.0, -3000.0}, {0.86f, 0.80f, 0.66f});
    out.light({3.0, 7.0, 8.0}, {0.28f, 0.28f, 0.30f});
    out.keys(motion("camera", {0.0, seconds, 20}, eye, front));
}

}  // namespace

/// Two parties of walkers meet in a street under glass: textures, mirrors, a roof that light passes.
std::uint64_t write_robots(const Request& request)
{
    const int count = static_cast<int>(request.amount), rows = (count + 2 * lanes - 1) / (2 * lanes);
    const int bays = std::max(8, static_cast<int>(std::ceil((speed * seconds + rows - meeting + 4.0) / bay_length)));
    AffWriter out(request.file);
    out.comment("Tin robots meet in a street under a glass roof. Made by firstray's generator; CC0.");
    write_settings(out);
    write_arcade(out, request, bays);
    for (int i = 0; i < count; ++i) {
        Random random(request.seed, 2, static_cast<std::uint64_t>(i));
        const Paint& paint = paints[static_cast<std::size_t>(i) % std::size(paints)];
        write_walker(out, "robot_" + std::to_string(i), walk_of(i, random), paint);
    }
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
