#include <cmath>
#include <vector>

#include "scenes/generator/generate.h"
#include "scenes/generator/looks.h"
#include "scenes/generator/random.h"
#include "scenes/generator/texture_maker.h"
#include "scenes/generator/walker.h"

namespace firstray::scenes {
namespace {

// Metres, y up; the pitch lies around the origin, its long side along x.
constexpr double pitch_x = 105.0, pitch_z = 68.0, stadium_length = 240.0, walker_height = 1.9;
constexpr double seconds = 8.0, speed = 1.15, ball_radius = 0.16;  // the last two in the walker's own metres
constexpr int around = 72;                                         // segments of the stands

/// A point of the ring of stands: `out` metres from the pitch's edge, an oval that becomes rounder outwards.
glm::dvec3 ring(double angle, double out, double y)
{
    const double c = std::cos(angle), s = std::sin(angle), power = 2.0 / 3.2;
    const auto bent = [&](double x) { return std::copysign(std::pow(std::abs(x), power), x); };
    return {(pitch_x / 2 + 9.0 + out) * bent(c), y, (pitch_z / 2 + 9.0 + out) * bent(s)};
}

/// A strip around the stadium between two places of its cross-section.
Mesh band(const glm::dvec2& low, const glm::dvec2& high, double from = 0.0, double to = 1.0, int segments = around)
{
    Mesh mesh;
    const auto angle = [&](int i) { return -2.0 * M_PI * (from + (to - from) * i / segments); };
    for (int i = 0; i < segments; ++i)
        add_quad(mesh, ring(angle(i + 1), low.x, low.y), ring(angle(i), low.x, low.y), ring(angle(i), high.x, high.y),
                 ring(angle(i + 1), high.x, high.y));
    return mesh;
}

void put(AffWriter& out, const Material& material, Mesh mesh, const std::string& texture = {})
{
    snap(mesh, 1e-3);
    out.material(material);
    out.mesh(mesh, texture);
}

/// A tier of the stands: where its cross-section begins and ends.
struct Tier {
    glm::dvec2 low, high;
    int rows;
};

/// Rows of seats in blocks of two colours, and the steps that show between them.
void add_tier(const Tier& tier, Mesh (&colours)[2], Mesh& steps)
{
    constexpr int blocks = 36;
    const glm::dvec2 off(-0.25, 0.12);  // seats stand clear of the steps, whose chords are longer
    const glm::dvec2 step = (tier.high - tier.low) / static_cast<double>(tier.rows);
    for (int row = 0; row < tier.rows; ++row) {
        const glm::dvec2 a = tier.low + step * static_cast<double>(row), b = a + glm::dvec2(0.0, step.y),
                         c = b + glm::dvec2(step.x, 0.0);
        for (int i = 0; i < blocks; ++i) {
            const double from = (i + 0.06) / blocks, to = (i + 0.94) / blocks;
            Mesh& seats = colours[(i / 2 + (row > tier.rows / 2)) % 2];
            append(seats, band(a + off, b + off, from, to, 2));
            append(seats, band(b + off, c + off, from, to, 2));
        }
        append(steps, band(a, b));
        append(steps, band(b + glm::dvec2(0, -0.03), c + glm::dvec2(0, -0.03)));
    }
}

void write_stands(AffWriter& out)
{
    Mesh colours[2], steps, concrete;
    add_tier({{0, 1.2}, {17, 9.5}, 8}, colours, steps);
    add_tier({{18, 13.0}, {36, 27.0}, 9}, colours, steps);
    append(concrete, band({17, 9.5}, {18, 9.5}));
    append(concrete, band({18, 9.5}, {18, 13.0}));
    append(concrete, band({0, 0.0}, {0, 1.2}));
    append(concrete, band({44, 30.0}, {44, -0.5}));
    append(concrete, band({36, 27.0}, {36, 30.0}));
    put(out, matt({0.70f, 0.16f, 0.14f}), colours[0]);
    put(out, matt({0.86f, 0.84f, 0.80f}), colours[1]);
    put(out, matt({0.52f, 0.52f, 0.52f}), steps);
    put(out, matt({0.66f, 0.65f, 0.63f}), concrete);
}

void write_roof(AffWriter& out)
{
    Mesh canopy, masts;
    append(canopy, band({14, 36.5}, {30, 35.0}));
    append(canopy, band({30, 35.0}, {45, 32.0}));
    append(canopy, band({14, 36.5}, {14, 35.6}));
    for (int i = 0; i < 24; ++i) {
        const double angle = 2.0 * M_PI * i / 24;
        const glm::dvec3 beam[] = {ring(angle, 46, 30.0), ring(angle, 38, 39.5), ring(angle, 15, 37.2)};
        append(masts, tube(beam, std::vector<double>{0.7, 0.6, 0.25}, 5));
    }
    put(out, matt({0.92f, 0.93f, 0.95f}), canopy);
    put(out, matt({0.80f, 0.82f, 0.86f}), masts);
}

/// White lines, 12 cm wide.
void write_lines(AffWriter& out)
{
    Mesh lines;
    const double y = 0.004, w = 0.06;
    const auto line = [&](double x0, double z0, double x1, double z1) {
        add_quad(lines, {x0 - w, y, z1 + w}, {x1 + w, y, z1 + w}, {x1 + w, y, z0 - w}, {x0 - w, y, z0 - w});
    };
    const double x = pitch_x / 2, z = pitch_z / 2;
    for (const double s : {-1.0, 1.0}) {
        line(-x, s * z, x, s * z);
        line(s * x, -z, s * x, z);
        for (const glm::dvec2& box : {glm::dvec2(16.5, 20.16), glm::dvec2(5.5, 9.16)}) {
            const double inner = s * (x - box.x);
            line(inner, -box.y, inner, box.y);
            for (const double side : {-1.0, 1.0})
                line(std::min(inner, s * x), side * box.y, std::max(inner, s * x), side * box.y);
        }
    }
    line(0, -z, 0, z);
    for (int i = 0; i < 96; ++i) {
        const auto at = [&](int k, double r) {
            return glm::dvec3(r * std::cos(2 * M_PI * k / 96), y, -r * std::sin(2 * M_PI * k / 96));
        };
        add_quad(lines, at(i, 9.15 - w), at(i, 9.15 + w), at(i + 1, 9.15 + w), at(i + 1, 9.15 - w));
    }
    put(out, matt({0.93f, 0.95f, 0.92f}), lines);
}

void write_goals(AffWriter& out)
{
    const double x = pitch_x / 2;
    Mesh goals;
    for (const double s : {-1.0, 1.0}) {
        const glm::dvec3 frame[] = {{s * x, 0, -3.66}, {s * x, 2.44, -3.66}, {s * x, 2.44, 3.66}, {s * x, 0, 3.66}};
        for (std::size_t i = 0; i < 3; ++i)
            append(goals, tube(std::span(frame).subspan(i, 2), std::vector<double>(2, 0.06), 8));
    }
    put(out, glossy({0.95f, 0.95f, 0.95f}), goals);
}

void write_place(AffWriter& out, const Request& request)
{
    write_turf(request.beside("turf.ppm"), request.seed);
    Mesh turf;
    const double x = pitch_x / 2 + 10.0, z = pitch_z / 2 + 10.0;
    add_quad(turf, {-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z}, {x / 5.0, z / 5.0});
    put(out, matt({0.95f, 0.95f, 0.95f}), turf, request.name("turf.ppm"));
    Mesh outside;
    add_quad(outside, {-400, -0.5, 400}, {400, -0.5, 400}, {400, -0.5, -400}, {-400, -0.5, -400});
    put(out, matt({0.48f, 0.50f, 0.46f}), outside);
    write_stands(out);
    write_roof(out);
    write_lines(out);
    write_goals(out);
    constexpr int boards = 24, pictures = 3;
    for (int i = 0; i < pictures; ++i)
        write_painting(request.beside("board_" + std::to_string(i) + ".ppm"),
                       Random::mixed(request.seed) + static_cast<std::uint64_t>(i));
    for (int i = 0; i < boards; ++i) {
        Mesh board;
        const double from = -2.0 * M_PI * (i + 0.04) / boards, to = -2.0 * M_PI * (i + 0.96) / boards;
        add_quad(board, ring(to, -3, 0), ring(from, -3, 0), ring(from, -3, 1), ring(to, -3, 1), {1.0, 0.15});
        put(out, matt({0.95f, 0.95f, 0.95f}), board, request.name("board_" + std::to_string(i % pictures) + ".ppm"));
    }
}

/// Black where one of twelve directions is near, as on a football.
bool is_black(const glm::dvec3& p)
{
    constexpr double golden = 1.618033988749895;
    const glm::dvec3 n = glm::normalize(p);
    for (int axis = 0; axis < 3; ++axis)
        for (const double a : {-1.0, 1.0})
            for (const double b : {-golden, golden}) {
                glm::dvec3 corner(0.0);
                corner[axis] = a, corner[(axis + 1) % 3] = b;
                if (glm::dot(n, glm::normalize(corner)) > 0.93) return true;
            }
    return false;
}

void write_ball(AffWriter& out, const Walk& walk)
{
    const auto ahead = [=](double t) { return 0.62 + 0.22 * (0.5 - 0.5 * std::cos(2.0 * M_PI * speed * t / 1.12)); };
    const auto place = [=](double t) {
        const double a = glm::radians(walk.heading(t));
        return walk.place(t) + ahead(t) * glm::dvec3(std::sin(a), 0.0, std::cos(a)) + glm::dvec3(0.0, ball_radius, 0.0);
    };
    const auto turn = [=](double t) {
        return rotation_about({0, 1, 0}, glm::radians(walk.heading(t))) *
               rotation_about({1, 0, 0}, (walk.travelled(t) + ahead(t)) / ball_radius);
    };
    out.keys(motion("ball", walk.beat, place, turn));
    out.open("ball");
    const Mesh mesh = ball(ball_radius, 40, 72);
    const auto part = [&](const Material& material, bool black) {
        Mesh half = part_of(mesh, [&](const glm::dvec3& p) { return is_black(p) == black; });
        snap(half, 1e-4);
        out.material(material);
        out.mesh(half);
    };
    part(glossy({0.94f, 0.93f, 0.90f}, 0.06f), false);
    part(glossy({0.10f, 0.10f, 0.11f}, 0.06f), true);
    out.close();
}

/// unit  a walker's metre
void write_settings(AffWriter& out, const Walk& walk, double unit)
{
    const auto eye = [&](double t) {
        const double angle = glm::radians(walk.heading(t) - 30.0 - 3.0 * t);
        return walk.place(t) + glm::dvec3(3.1 * std::sin(angle), 0.62 + 0.05 * t, 3.1 * std::cos(angle));
    };
    const auto target = [&](double t) { return walk.place(t) + glm::dvec3(0.0, 1.05, 0.0); };
    out.view({.from = unit * eye(0.0),
              .at = unit * target(0.0),
              .angle = 52.0,
              .hither = std::max(0.1 * unit, 1e-4),
              .width = 800,
              .height = 600});
    out.frames(0.0, seconds, 192);
    out.background({0.50f, 0.70f, 0.95f});
    out.ambient({0.44f, 0.46f, 0.50f});
    out.light({5000.0, 6300.0, 7000.0}, {0.80f, 0.76f, 0.66f});
    out.keys(motion(
        "camera", walk.beat, [&](double t) { return unit * eye(t); },
        [&](double t) { return looking(eye(t), target(t)); }));
}

}  // namespace

/// A grid over all of this has cells as large as the walker, or larger.
std::uint64_t write_stadium(const Request& request)
{
    const double unit = stadium_length / request.amount / walker_height;  // a walker's metre, in the stadium's
    const Walk walk = circle_walk({0.0, seconds, 110}, 5.0, speed, -40.0);
    AffWriter out(request.file);
    out.comment("A tin robot, " + std::to_string(static_cast<int>(std::lround(request.amount))) +
                " times smaller than the stadium it plays in. Made by firstray's generator; CC0.");
    write_settings(out, walk, unit);
    write_place(out, request);
    out.open({.scale = glm::dvec3(unit)});
    write_walker(out, "robot", walk, {{0.88f, 0.60f, 0.14f}, {0.24f, 0.30f, 0.36f}});
    write_ball(out, walk);
    out.close();
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
