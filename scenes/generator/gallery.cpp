#include "scenes/generator/gallery.h"

#include <cmath>
#include <vector>

#include "scenes/generator/looks.h"
#include "scenes/generator/mesh.h"
#include "scenes/generator/random.h"
#include "scenes/generator/texture_maker.h"

namespace firstray::scenes {
namespace {

constexpr double half = 5.5, height = 4.8, rope_radius = 1.45;
constexpr int pictures = 6, posts = 8;

void put(AffWriter& out, const Material& material, Mesh mesh, const std::string& texture = {})
{
    snap(mesh, 1e-3);
    out.material(material);
    out.mesh(mesh, texture);
}

/// The four walls, each seen from the room with its left end at x = -half: wall_from_front turns the back wall to it.
Transform room_from_wall(int wall)
{
    return turn({0, 1, 0}, 90.0 * wall) * shift({0, 0, -half});
}

void write_shell(AffWriter& out, const Request& request)
{
    write_parquet(request.beside("parquet.ppm"), request.seed);
    write_plaster(request.beside("plaster.ppm"), request.seed);
    Mesh floor, walls, trim, ceiling;
    add_quad(floor, {-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}, {half, half});
    add_quad(ceiling, {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half});
    for (int wall = 0; wall < 4; ++wall) {
        Mesh plain, boards;
        add_quad(plain, {-half, 0, 0}, {half, 0, 0}, {half, height, 0}, {-half, height, 0}, {2.75, 1.2});
        add_box(boards, {-half, 0, 0}, {half, 0.22, 0.05});
        add_box(boards, {-half, 0.22, 0}, {half, 0.26, 0.03});
        add_box(boards, {-half, height - 0.30, 0}, {half, height - 0.16, 0.12});
        add_box(boards, {-half, height - 0.16, 0}, {half, height, 0.22});
        append(walls, plain, room_from_wall(wall));
        append(trim, boards, room_from_wall(wall));
    }
    for (int i = -2; i <= 2; ++i) {
        add_box(trim, {2.2 * i - 0.12, height - 0.2, -half}, {2.2 * i + 0.12, height, half});
        add_box(trim, {-half, height - 0.17, 2.2 * i - 0.12}, {half, height, 2.2 * i + 0.12});
    }
    Material wood = matt({0.92f, 0.86f, 0.80f});
    wood.specular = glm::vec3(0.12f);
    wood.shine = 25.0f;
    put(out, wood, floor, request.name("parquet.ppm"));
    put(out, matt({0.50f, 0.60f, 0.60f}), walls, request.name("plaster.ppm"));
    put(out, matt({0.93f, 0.91f, 0.87f}), trim);
    put(out, {.ambient = {1.5f, 1.48f, 1.44f}, .diffuse = glm::vec3(0.6f)}, ceiling);  // lit from the floor
}

/// A frame of four mitred-looking bars around a picture of w x h, its middle at the origin, facing +z.
Mesh frame(double w, double h)
{
    Mesh mesh;
    const double b = 0.09, d = 0.06;
    add_box(mesh, {-w / 2 - b, -h / 2 - b, 0}, {w / 2 + b, -h / 2, d});
    add_box(mesh, {-w / 2 - b, h / 2, 0}, {w / 2 + b, h / 2 + b, d});
    add_box(mesh, {-w / 2 - b, -h / 2, 0}, {-w / 2, h / 2, d});
    add_box(mesh, {w / 2, -h / 2, 0}, {w / 2 + b, h / 2, d});
    return mesh;
}

void write_pictures(AffWriter& out, const Request& request)
{
    Mesh frames;
    for (int i = 0; i < pictures; ++i)
        write_painting(request.beside("picture_" + std::to_string(i) + ".ppm"),
                       Random::mixed(request.seed) + static_cast<std::uint64_t>(i));
    out.material(matt({0.95f, 0.95f, 0.95f}));
    Random random(request.seed, 1, 0);
    for (int wall = 0; wall < 4; ++wall)
        for (int i = 0; i < 3; ++i) {
            const double w = random.between(1.2, 1.9), h = random.between(1.2, 1.8);
            const Transform place = room_from_wall(wall) * shift({3.4 * (i - 1), 2.15, 0.0});
            Mesh canvas, moved;
            add_quad(canvas, {-w / 2, -h / 2, 0.03}, {w / 2, -h / 2, 0.03}, {w / 2, h / 2, 0.03}, {-w / 2, h / 2, 0.03},
                     {1.0, 1.0});
            append(moved, canvas, place);
            snap(moved, 1e-3);
            out.mesh(moved, request.name("picture_" + std::to_string((3 * wall + i) % pictures) + ".ppm"));
            append(frames, frame(w, h), place);
        }
    put(out, metal({0.72f, 0.54f, 0.26f}, 0.12f, 25.0f), frames);
}

void write_plinth(AffWriter& out)
{
    const double r = 0.42, h = plinth_height;
    const glm::dvec2 profile[] = {{r + 0.1, 0.0}, {r + 0.1, 0.08},      {r + 0.04, 0.14},     {r, 0.18},
                                  {r, h - 0.14},  {r + 0.05, h - 0.08}, {r + 0.07, h - 0.02}, {r + 0.05, h},
                                  {0.0, h}};
    put(out, glossy({0.90f, 0.88f, 0.84f}, 0.05f, 30.0f), lathe(profile, 40));
}

void write_ropes(AffWriter& out)
{
    const glm::dvec2 profile[] = {{0.15, 0.0},   {0.15, 0.02}, {0.05, 0.05}, {0.022, 0.08},
                                  {0.022, 0.86}, {0.04, 0.88}, {0.04, 0.92}, {0.0, 0.96}};
    Mesh metal_parts, ropes;
    const auto at = [](double i, double y) {
        const double angle = 2.0 * M_PI * (i + 0.5) / posts;
        return glm::dvec3(rope_radius * std::sin(angle), y, rope_radius * std::cos(angle));
    };
    for (int i = 0; i < posts; ++i) {
        append(metal_parts, lathe(profile, 12), shift(at(i, 0.0)));
        std::vector<glm::dvec3> path;
        for (int k = 0; k <= 8; ++k) {
            const double s = k / 8.0;
            path.push_back(glm::mix(at(i, 0.84), at(i + 1, 0.84), s) - glm::dvec3(0.0, 0.72 * s * (1.0 - s), 0.0));
        }
        append(ropes, tube(path, std::vector<double>(path.size(), 0.02), 6));
    }
    put(out, metal({0.90f, 0.74f, 0.40f}, 0.35f, 50.0f), metal_parts);
    put(out, matt({0.52f, 0.08f, 0.10f}), ropes);
}

void write_benches(AffWriter& out)
{
    Mesh seats;
    for (const double side : {-1.0, 1.0}) {
        append(seats, rounded_box({0.28, 0.07, 0.9}, 0.05, 2), shift({side * 3.6, 0.45, -0.8}));
        for (const double z : {-0.65, 0.65})
            append(seats, rounded_box({0.22, 0.2, 0.05}, 0.02, 1), shift({side * 3.6, 0.2, z - 0.8}));
    }
    put(out, glossy({0.26f, 0.17f, 0.12f}, 0.05f, 25.0f), seats);
}

}  // namespace

void write_gallery(AffWriter& out, const Request& request)
{
    write_shell(out, request);
    write_pictures(out, request);
    write_plinth(out);
    write_ropes(out);
    write_benches(out);
}

}  // namespace firstray::scenes
