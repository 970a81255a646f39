#include "scenes/generator/arcade.h"

#include <cmath>
#include <vector>

#include "scenes/generator/looks.h"
#include "scenes/generator/mesh.h"
#include "scenes/generator/random.h"
#include "scenes/generator/texture_maker.h"

namespace firstray::scenes {
namespace {

constexpr double half_width = 6.0, wall_height = 9.0, shop_height = 4.2;
constexpr int posters = 4;

/// The meshes of the street, one to a material.
struct StreetParts {
    Mesh stone, floor, mirrors, panes, frames, trim, columns, glass, steel, lamps, awnings[3];
};

/// A column of 3.9 m with base and capital.
Mesh column()
{
    const glm::dvec2 profile[] = {{0.34, 0.0}, {0.34, 0.3}, {0.28, 0.36}, {0.24, 0.45},
                                  {0.21, 3.4}, {0.25, 3.5}, {0.30, 3.75}, {0.32, 3.9}};
    return lathe(profile, 12);
}

/// A quadrilateral in the plane of a wall that faces the street; `z` runs towards the back.
void add_wall(Mesh& mesh, double side, double x, double z0, double z1, double y0, double y1, bool textured)
{
    const glm::dvec2 size = textured ? glm::dvec2((z1 - z0) / 4, (y1 - y0) / 4) : glm::dvec2(0.0);
    const double a = side < 0.0 ? -z0 : -z1, b = side < 0.0 ? -z1 : -z0;
    add_quad(mesh, {side * x, y0, a}, {side * x, y0, b}, {side * x, y1, b}, {side * x, y1, a}, size);
}

/// A box along a wall that stands out by `depth` from `x`.
void add_ledge(Mesh& mesh, double side, double x, double depth, double z0, double z1, double y0, double y1)
{
    const double a = side * x, b = side * (x - depth);
    add_box(mesh, {std::min(a, b), y0, -z1}, {std::max(a, b), y1, -z0});
}

void add_shop(StreetParts& parts, double side, double z, Random& random)
{
    const double w = half_width, end = z + bay_length;
    add_wall(parts.stone, side, w, z, z + 0.6, 0.0, wall_height, true);
    add_wall(parts.stone, side, w, end - 0.6, end, 0.0, wall_height, true);
    add_wall(parts.stone, side, w, z + 0.6, end - 0.6, shop_height, wall_height, true);
    add_wall(parts.mirrors, side, w + 0.25, z + 0.6, end - 0.6, 0.5, shop_height, false);
    add_ledge(parts.trim, side, w + 0.25, 0.35, z + 0.6, end - 0.6, 0.0, 0.5);
    for (const double at : {0.6, 1.82, 3.1, 4.3})
        add_ledge(parts.frames, side, w + 0.25, 0.1, z + at, z + at + 0.1, 0.5, shop_height);
    add_ledge(parts.frames, side, w + 0.25, 0.1, z + 0.6, end - 0.6, 3.1, 3.2);
    for (const double at : {1.0, 2.9}) {  // windows above
        add_wall(parts.panes, side, w - 0.02, z + at, z + at + 1.1, 5.4, 7.6, false);
        add_ledge(parts.trim, side, w, 0.12, z + at - 0.15, z + at, 5.3, 7.6);
        add_ledge(parts.trim, side, w, 0.12, z + at + 1.1, z + at + 1.25, 5.3, 7.6);
        add_ledge(parts.trim, side, w, 0.2, z + at - 0.2, z + at + 1.3, 7.6, 7.8);
        add_ledge(parts.trim, side, w, 0.25, z + at - 0.2, z + at + 1.3, 5.15, 5.3);
        add_ledge(parts.frames, side, w, 0.06, z + at + 0.52, z + at + 0.58, 5.3, 7.6);
    }
    add_ledge(parts.trim, side, w, 0.3, z, end, shop_height + 0.35, shop_height + 0.6);
    add_ledge(parts.trim, side, w, 0.4, z, end, wall_height - 0.4, wall_height);
    Mesh& awning = parts.awnings[random.below(3)];
    const double a = side < 0.0 ? -(z + 0.5) : -(end - 0.5), b = side < 0.0 ? -(end - 0.5) : -(z + 0.5), x = side * w;
    add_quad(awning, {x - side * 1.3, 3.25, a}, {x - side * 1.3, 3.25, b}, {x, 3.95, b}, {x, 3.95, a});
    add_quad(awning, {x - side * 1.3, 3.0, a}, {x - side * 1.3, 3.0, b}, {x - side * 1.3, 3.25, b},
             {x - side * 1.3, 3.25, a});
}

/// Glass over a bay and the rib at its start.
void add_roof(StreetParts& parts, double z)
{
    const auto vault = [](double angle, double radius) {
        return glm::dvec3(-radius * std::cos(angle), wall_height + 0.75 * radius * std::sin(angle), 0.0);
    };
    append(parts.glass, surface(10, 1, [&](double u, double v) {
               return vault(M_PI * u, half_width) + glm::dvec3(0, 0, -z - v * bay_length);
           }));
    std::vector<glm::dvec3> rib;
    for (int i = 0; i <= 14; ++i) rib.push_back(vault(M_PI * i / 14, half_width - 0.06) + glm::dvec3(0, 0, -z));
    append(parts.steel, tube(rib, std::vector<double>(rib.size(), 0.09), 6));
    for (int i = 1; i < 6; ++i) {
        const glm::dvec3 at = vault(M_PI * i / 6, half_width - 0.06),
                         purlin[] = {at - glm::dvec3(0, 0, z), at - glm::dvec3(0, 0, z + bay_length)};
        append(parts.steel, tube(purlin, std::vector<double>(2, 0.05), 5));
    }
}

void add_lamp(StreetParts& parts, double z)
{
    append(parts.lamps, ball(0.28, 7, 12), shift({0.0, 7.2, -z}));
    const glm::dvec3 rod[] = {{0.0, 7.4, -z}, {0.0, wall_height + 0.75 * half_width - 0.1, -z}};
    append(parts.steel, tube(rod, std::vector<double>(2, 0.025), 5));
}

/// What stands beyond the street's end.
void add_end(StreetParts& parts, double z)
{
    add_quad(parts.stone, {-16, 0, -z - 14}, {16, 0, -z - 14}, {16, 13, -z - 14}, {-16, 13, -z - 14}, {8.0, 3.25});
    for (int row = 0; row < 3; ++row)
        for (int i = -3; i <= 3; ++i) {
            const double x = 2.4 * i, y = 1.2 + 4.0 * row;
            add_box(parts.trim, {x - 0.75, y - 0.2, -z - 14}, {x + 0.75, y + 2.4, -z - 13.85});
            add_quad(parts.panes, {x - 0.55, y, -z - 13.84}, {x + 0.55, y, -z - 13.84}, {x + 0.55, y + 2.2, -z - 13.84},
                     {x - 0.55, y + 2.2, -z - 13.84});
        }
    add_box(parts.trim, {-16, 12.6, -z - 14}, {16, 13.2, -z - 13.5});
    for (const double x : {-half_width, half_width}) {  // the ends of the side walls
        add_quad(parts.stone, {x - 2.0 * (x < 0), 0, 0.01}, {x + 2.0 * (x > 0), 0, 0.01},
                 {x + 2.0 * (x > 0), wall_height, 0.01}, {x - 2.0 * (x < 0), wall_height, 0.01}, {0.5, 2.25});
    }
}

void add_posters(AffWriter& out, const Request& request, int bays, Random& random)
{
    out.material(matt({0.95f, 0.95f, 0.95f}));
    for (int bay = 0; bay <= bays; ++bay)
        for (const double side : {-1.0, 1.0}) {
            Mesh poster;
            const double z = bay * bay_length, x = side * (half_width - 0.012), a = -z + side * 0.42,
                         b = -z - side * 0.42;
            add_quad(poster, {x, 1.2, a}, {x, 1.2, b}, {x, 2.4, b}, {x, 2.4, a}, {1.0, 1.0});
            if (bay > 0 && bay < bays)
                out.mesh(poster, request.name("poster_" + std::to_string(random.below(posters)) + ".ppm"));
        }
}

void put(AffWriter& out, const Material& material, Mesh& mesh, const std::string& texture = {})
{
    snap(mesh, 1e-3);
    out.material(material);
    out.mesh(mesh, texture);
}

StreetParts build_street(int bays, Random& random)
{
    StreetParts parts;
    const double floor = half_width + 0.3, end = -bays * bay_length;
    for (int bay = 0; bay < bays; ++bay) {
        const double z = bay * bay_length;
        for (const double side : {-1.0, 1.0}) add_shop(parts, side, z, random);
        add_roof(parts, z);
        if (bay % 2) add_lamp(parts, z);
        add_quad(parts.floor, {-floor, 0, -z}, {floor, 0, -z}, {floor, 0, -z - bay_length},
                 {-floor, 0, -z - bay_length}, {2.52, 1.0});
    }
    for (int bay = 0; bay <= bays; ++bay)
        for (const double side : {-1.0, 1.0})
            append(parts.columns, column(), shift({side * (half_width - 0.42), 0.0, -bay * bay_length}));
    add_end(parts, -end);
    add_quad(parts.floor, {-30, -0.01, 30}, {30, -0.01, 30}, {30, -0.01, end - 15}, {-30, -0.01, end - 15},
             {12.0, 9 - end / 5});
    return parts;
}

void write_textures(const Request& request)
{
    write_slabs(request.beside("slabs.ppm"), request.seed);
    write_masonry(request.beside("masonry.ppm"), request.seed);
    for (int i = 0; i < posters; ++i)
        write_painting(request.beside("poster_" + std::to_string(i) + ".ppm"),
                       Random::mixed(request.seed) + static_cast<std::uint64_t>(i));
}

}  // namespace

void write_arcade(AffWriter& out, const Request& request, int bays)
{
    write_textures(request);
    Random random(request.seed, 1, 0);
    StreetParts parts = build_street(bays, random);
    Material floor = matt({0.86f, 0.82f, 0.78f});
    floor.specular = glm::vec3(0.10f);
    floor.shine = 20.0f;
    put(out, floor, parts.floor, request.name("slabs.ppm"));
    put(out, matt({0.94f, 0.86f, 0.72f}), parts.stone, request.name("masonry.ppm"));
    put(out, matt({0.90f, 0.86f, 0.78f}), parts.trim);
    put(out, matt({0.88f, 0.82f, 0.72f}), parts.columns);
    put(out, glossy({0.16f, 0.26f, 0.22f}, 0.05f), parts.frames);
    put(out, glossy({0.05f, 0.07f, 0.09f}, 0.55f, 90.0f), parts.mirrors);
    put(out, glossy({0.10f, 0.13f, 0.17f}, 0.30f, 90.0f), parts.panes);
    put(out, glossy({0.20f, 0.30f, 0.28f}, 0.05f), parts.steel);
    put(out, {.ambient = {1.6f, 1.5f, 1.2f}, .diffuse = {0.4f, 0.4f, 0.35f}}, parts.lamps);
    const glm::vec3 cloths[] = {{0.66f, 0.18f, 0.15f}, {0.16f, 0.36f, 0.44f}, {0.88f, 0.70f, 0.32f}};
    for (std::size_t i = 0; i < 3; ++i)
        if (!parts.awnings[i].triangles.empty()) put(out, matt(cloths[i]), parts.awnings[i]);
    put(out, pane({0.10f, 0.13f, 0.14f}, 0.70f, 0.06f), parts.glass);
    add_posters(out, request, bays, random);
}

}  // namespace firstray::scenes
