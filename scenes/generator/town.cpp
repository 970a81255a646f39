#include "scenes/generator/town.h"

#include <array>
#include <cmath>

#include "scenes/generator/looks.h"
#include "scenes/generator/mesh.h"

namespace firstray::scenes {
namespace {

constexpr double grain = 1e-2;  // metres: finer than anything that is seen, and short to write

void put(AffWriter& out, const Material& material, Mesh mesh, const Transform& place, std::string_view texture = {})
{
    Mesh placed;
    append(placed, mesh, place);
    snap(placed, grain);
    out.material(material);
    out.mesh(placed, texture);
}

glm::vec3 picked(std::span<const glm::vec3> colours, Random& random)
{
    return colours[static_cast<std::size_t>(random.below(static_cast<int>(colours.size())))];
}

constexpr glm::vec3 wall_colours[] = {{0.93f, 0.80f, 0.58f}, {0.90f, 0.66f, 0.48f}, {0.95f, 0.90f, 0.78f},
                                      {0.80f, 0.55f, 0.42f}, {0.72f, 0.78f, 0.74f}, {0.92f, 0.74f, 0.68f},
                                      {0.70f, 0.74f, 0.84f}, {0.97f, 0.86f, 0.50f}};
constexpr glm::vec3 roof_colours[] = {
    {0.66f, 0.30f, 0.20f}, {0.58f, 0.27f, 0.20f}, {0.70f, 0.38f, 0.26f}, {0.48f, 0.30f, 0.27f}};
constexpr glm::vec3 bright_colours[] = {{0.16f, 0.34f, 0.52f}, {0.62f, 0.16f, 0.14f}, {0.20f, 0.42f, 0.30f},
                                        {0.82f, 0.58f, 0.16f}, {0.36f, 0.24f, 0.44f}, {0.18f, 0.46f, 0.50f},
                                        {0.78f, 0.74f, 0.66f}, {0.30f, 0.28f, 0.30f}};
constexpr double storey_height = 3.2, foundation = 2.0, eaves_overhang = 0.5;

/// The meshes of a house, one to a material.
struct HouseParts {
    Mesh walls, wood, shutters, panes, roof;
};

double eaves_of(const House& house)
{
    return house.storeys * storey_height + 0.4;
}

double rise_of(const House& house)
{
    return house.depth * 0.42;
}

void add_walls(Mesh& walls, const House& house)
{
    const double l = -house.width / 2, r = house.width / 2, b = -house.depth, low = -foundation, high = eaves_of(house);
    const glm::dvec2 front(house.width / 4, (high - low) / 4), side(house.depth / 4, (high - low) / 4);
    add_quad(walls, {l, low, 0}, {r, low, 0}, {r, high, 0}, {l, high, 0}, front);
    add_quad(walls, {r, low, b}, {l, low, b}, {l, high, b}, {r, high, b}, front);
    add_quad(walls, {r, low, 0}, {r, low, b}, {r, high, b}, {r, high, 0}, side);
    add_quad(walls, {l, low, b}, {l, low, 0}, {l, high, 0}, {l, high, b}, side);
    const double ridge = high + rise_of(house);  // gables: their upper two corners meet
    add_quad(walls, {r, high, 0}, {r, high, b}, {r, ridge, b / 2}, {r, ridge, b / 2}, side);
    add_quad(walls, {l, high, b}, {l, high, 0}, {l, ridge, b / 2}, {l, ridge, b / 2}, side);
    walls.triangles.erase(walls.triangles.end() - 1);
    walls.triangles.erase(walls.triangles.end() - 2);
}

/// A window in a wall at z, facing `out` (+1 or -1): frame, sill, bars, glass, open shutters.
void add_window(HouseParts& parts, double x, double y, double w, double h, double z, double out)
{
    const auto box = [&](Mesh& mesh, double x0, double x1, double y0, double y1, double depth) {
        add_box(mesh, {x + x0, y + y0, std::min(z, z + out * depth)}, {x + x1, y + y1, std::max(z, z + out * depth)});
    };
    const double e = 0.1;
    box(parts.wood, -w / 2 - e, -w / 2, 0, h, 0.1);
    box(parts.wood, w / 2, w / 2 + e, 0, h, 0.1);
    box(parts.wood, -w / 2 - e, w / 2 + e, h, h + e, 0.14);
    box(parts.wood, -w / 2 - 0.2, w / 2 + 0.2, -e, 0, 0.26);
    box(parts.wood, -0.03, 0.03, 0, h, 0.06);
    box(parts.wood, -w / 2, w / 2, h * 0.62, h * 0.62 + 0.05, 0.06);
    box(parts.shutters, -w * 0.98, -w / 2 - e, 0, h, 0.08);
    box(parts.shutters, w / 2 + e, w * 0.98, 0, h, 0.08);
    const double d = z + out * 0.02, l = x - out * w / 2, r = x + out * w / 2;
    add_quad(parts.panes, {l, y, d}, {r, y, d}, {r, y + h, d}, {l, y + h, d});
}

void add_windows(HouseParts& parts, const House& house)
{
    const int columns = 3;
    for (int storey = 0; storey < house.storeys; ++storey)
        for (int i = 0; i < columns; ++i) {
            const double x = house.width * ((i + 0.5) / columns - 0.5), y = storey * storey_height + 1.0;
            if (storey > 0 || i != 1) add_window(parts, x, y, 1.1, 1.6, 0.0, 1.0);
            if (storey > 0) add_window(parts, x, y, 1.1, 1.6, -house.depth, -1.0);
        }
    // the door
    add_box(parts.shutters, {-0.65, -foundation, 0.0}, {0.65, 2.3, 0.06});
    add_box(parts.wood, {-0.85, -foundation, 0.0}, {-0.65, 2.3, 0.14});
    add_box(parts.wood, {0.65, -foundation, 0.0}, {0.85, 2.3, 0.14});
    add_box(parts.wood, {-0.95, 2.3, 0.0}, {0.95, 2.55, 0.2});
    // cornice
    const double high = eaves_of(house), w = house.width / 2;
    add_box(parts.wood, {-w, high - 0.35, 0.0}, {w, high - 0.1, 0.22});
    add_box(parts.wood, {-w, high - 0.1, 0.0}, {w, high, 0.35});
}

/// Rows of pantiles: each a wave across the width, its lower edge above the next row's upper edge.
void add_slope(Mesh& roof, const House& house, double out)
{
    const double run = house.depth / 2 + eaves_overhang, rise = rise_of(house) * run / (house.depth / 2);
    const int rows = static_cast<int>(std::ceil(std::hypot(run, rise) / 0.8)),
              waves = static_cast<int>(house.width / 0.6);
    for (int row = 0; row < rows; ++row) {
        const auto first = static_cast<std::uint32_t>(roof.positions.size());
        for (int edge = 0; edge < 2; ++edge)
            for (int i = 0; i <= 2 * waves; ++i) {
                const double down = 1.0 - (row + edge) / static_cast<double>(rows);
                const double lift = (edge ? 0.02 : 0.12) + (i % 2 ? 0.1 : 0.0);
                const double y = eaves_of(house) + rise_of(house) - down * rise + lift;
                roof.positions.emplace_back(out * house.width * (i / (2.0 * waves) - 0.5), y,
                                            -house.depth / 2 + out * down * run);
            }
        const auto n = static_cast<std::uint32_t>(2 * waves + 1);
        for (std::uint32_t i = first; i + 1 < first + n; ++i) {
            roof.triangles.push_back({{i, i + 1, i + n + 1}, {}, {}});
            roof.triangles.push_back({{i, i + n + 1, i + n}, {}, {}});
        }
    }
}

void add_chimney(HouseParts& parts, const House& house, double x)
{
    const double top = eaves_of(house) + rise_of(house) + 1.2, z = -house.depth * 0.62;
    add_box(parts.wood, {x - 0.4, eaves_of(house), z - 0.35}, {x + 0.4, top, z + 0.35});
    add_box(parts.roof, {x - 0.48, top, z - 0.43}, {x + 0.48, top + 0.18, z + 0.43});
    for (const double dx : {-0.2, 0.2})
        add_box(parts.roof, {x + dx - 0.12, top + 0.18, z - 0.12}, {x + dx + 0.12, top + 0.6, z + 0.12});
}

/// Spire, nave's roof, clock face and the ball on top.
void write_church_roof(AffWriter& out, const Transform& place)
{
    Mesh roof;
    const glm::dvec3 tip(0.0, 38.0, -4.0),
        corners[] = {{-4.3, 24.0, 0.3}, {4.3, 24.0, 0.3}, {4.3, 24.0, -8.3}, {-4.3, 24.0, -8.3}};
    for (std::size_t i = 0; i < 4; ++i)
        add_quad(roof, corners[i], corners[(i + 1) % 4], glm::mix(corners[(i + 1) % 4], tip, 0.999),
                 glm::mix(corners[i], tip, 0.999));
    for (const double s : {-1.0, 1.0})
        add_quad(roof, {s * 9.0, 10.6, s > 0 ? -6.0 : -34.4}, {s * 9.0, 10.6, s > 0 ? -34.4 : -6.0},
                 {0, 18, s > 0 ? -34.4 : -6.0}, {0, 18, s > 0 ? -6.0 : -34.4});
    put(out, matt({0.30f, 0.42f, 0.38f}), roof, place);
    const glm::dvec2 disc[] = {{1.5, 0.0}, {1.5, 0.12}, {0.0, 0.12}};
    put(out, matt({0.93f, 0.91f, 0.84f}), lathe(disc, 32), place * shift({0, 12.2, 0}) * turn({1, 0, 0}, 90));
    put(out, metal({0.95f, 0.72f, 0.25f}, 0.3f), ball(0.45, 10, 16), place * shift({0.0, 38.2, -4.0}));
}

}  // namespace

glm::vec3 bright_colour(Random& random)
{
    return picked(bright_colours, random);
}

void write_house(AffWriter& out, const House& house, const Transform& world_from_house, std::string_view plaster,
                 Random& random)
{
    HouseParts parts;
    add_walls(parts.walls, house);
    add_windows(parts, house);
    add_slope(parts.roof, house, 1.0);
    add_slope(parts.roof, house, -1.0);
    add_chimney(parts, house, random.between(-0.35, 0.35) * house.width);
    put(out, matt(picked(wall_colours, random)), parts.walls, world_from_house, plaster);
    put(out, matt({0.88f, 0.85f, 0.78f}), parts.wood, world_from_house);
    put(out, matt(bright_colour(random)), parts.shutters, world_from_house);
    put(out, glossy({0.08f, 0.10f, 0.13f}, 0.28f, 60.0f), parts.panes, world_from_house);
    put(out, matt(picked(roof_colours, random)), parts.roof, world_from_house);
}

void write_person(AffWriter& out, Random& random)
{
    const double belly = random.between(0.19, 0.25), hat = random.unit();
    constexpr int around = 10;
    const glm::dvec2 coat[] = {{0.0, 0.03},  {0.21, 0.03}, {0.25, 0.12}, {belly, 0.75}, {belly - 0.01, 1.0},
                               {0.22, 1.25}, {0.19, 1.38}, {0.08, 1.46}, {0.06, 1.54}};
    Mesh body = lathe(coat, around);
    for (const double side : {-1.0, 1.0}) {
        const double swing = random.between(-0.12, 0.16);
        const glm::dvec3 arm[] = {{side * 0.17, 1.36, 0.0},
                                  {side * 0.27, 1.28, 0.0},
                                  {side * 0.31, 1.0, 0.0},
                                  {side * 0.26, 0.80, 0.06 + swing}};
        const double thick[] = {0.06, 0.075, 0.06, 0.05};
        append(body, tube(arm, thick, 6));
    }
    snap(body, grain);
    out.mesh(body);
    put(out, matt({0.86f, 0.66f, 0.52f}), ball(0.12, 6, around), shift({0.0, 1.63, 0.0}));
    const glm::dvec2 brim[] = {{0.0, 1.68}, {0.19, 1.69}, {0.115, 1.71}, {0.10, 1.85}, {0.0, 1.87}};
    const glm::dvec2 hair[] = {{0.10, 1.60}, {0.128, 1.64}, {0.115, 1.71}, {0.06, 1.755}, {0.0, 1.765}};
    if (hat < 0.4)
        put(out, matt({0.20f, 0.17f, 0.16f}), lathe(brim, around), {});
    else
        put(out, matt(hat < 0.7 ? glm::vec3(0.28f, 0.18f, 0.10f) : glm::vec3(0.60f, 0.45f, 0.22f)), lathe(hair, around),
            shift({0, 0, -0.015}));
}

void write_tree(AffWriter& out, Random& random)
{
    const glm::dvec3 trunk[] = {{0, -0.5, 0}, {0.05, 1.2, 0.0}, {0.0, 2.6, 0.08}, {-0.1, 4.2, 0.0}};
    const double thick[] = {0.28, 0.20, 0.16, 0.10};
    put(out, matt({0.34f, 0.25f, 0.17f}), tube(trunk, thick, 8), {});
    Mesh leaves;
    for (int i = 0; i < 5; ++i) {
        const double angle = i * 2.4 + random.unit(), spread = i == 0 ? 0.0 : 1.15, radius = random.between(1.2, 1.7);
        Mesh blob = ball(radius, 7, 11);
        for (glm::dvec3& p : blob.positions)  // lumpy, but closed: the same shift for the same place
            p *= 1.0 + 0.12 * std::sin(5.0 * p.x + 3.0 * p.y + i) * std::sin(4.0 * p.z - 2.0 * p.y);
        append(leaves, blob,
               shift({spread * std::cos(angle), 4.3 + (i == 0 ? 1.3 : random.between(-0.5, 0.6)),
                      spread * std::sin(angle)}));
    }
    const auto tone = static_cast<float>(random.between(0.8, 1.15));
    put(out, matt(glm::vec3(0.26f, 0.42f, 0.15f) * tone), leaves, {});
}

void write_church(AffWriter& out, const Transform& place, std::string_view plaster)
{
    Mesh walls, trim, dark;
    const auto block = [&](double x, double z0, double z1, double y0, double y1) {
        const glm::dvec2 front(2 * x / 4, (y1 - y0) / 4), side((z1 - z0) / 4, (y1 - y0) / 4);
        add_quad(walls, {-x, y0, z1}, {x, y0, z1}, {x, y1, z1}, {-x, y1, z1}, front);
        add_quad(walls, {x, y0, z0}, {-x, y0, z0}, {-x, y1, z0}, {x, y1, z0}, front);
        add_quad(walls, {x, y0, z1}, {x, y0, z0}, {x, y1, z0}, {x, y1, z1}, side);
        add_quad(walls, {-x, y0, z0}, {-x, y0, z1}, {-x, y1, z1}, {-x, y1, z0}, side);
    };
    block(4.0, -8.0, 0.0, -2.0, 24.0);    // tower
    block(8.5, -34.0, -6.0, -2.0, 11.0);  // nave
    for (const double y : {7.5, 15.5, 23.4}) add_box(trim, {-4.3, y, -8.3}, {4.3, y + 0.6, 0.3});
    for (const double x : {-2.0, 0.0, 2.0}) add_box(dark, {x - 0.55, 17.5, -8.05}, {x + 0.55, 21.5, 0.05});
    add_box(dark, {-1.4, -1.0, 0.0}, {1.4, 4.0, 0.08});
    for (const double x : {-1.9, 1.4}) add_box(trim, {x, -1.0, 0.0}, {x + 0.5, 4.2, 0.3});
    add_box(trim, {-2.1, 4.2, 0.0}, {2.1, 4.8, 0.4});
    put(out, matt({0.96f, 0.88f, 0.72f}), walls, place, plaster);
    put(out, matt({0.86f, 0.78f, 0.64f}), trim, place);
    put(out, matt({0.16f, 0.14f, 0.14f}), dark, place);
    write_church_roof(out, place);
}

void write_fountain(AffWriter& out, const Transform& place)
{
    const glm::dvec2 basin[] = {{4.0, -0.5}, {4.0, 0.5}, {4.15, 0.5}, {4.15, 0.7}, {3.6, 0.7}, {3.6, 0.3}};
    const glm::dvec2 bowl[] = {{0.8, 0.0}, {0.5, 0.4}, {0.3, 0.9}, {0.28, 1.6}, {0.5, 1.8}, {1.7, 2.3}, {1.75, 2.4},
                               {1.6, 2.4}, {0.3, 2.2}, {0.2, 2.9}, {0.35, 3.1}, {0.2, 3.3}, {0.0, 3.4}};
    put(out, matt({0.78f, 0.74f, 0.66f}), lathe(basin, 48), place);
    put(out, matt({0.72f, 0.68f, 0.60f}), lathe(bowl, 32), place);
    const glm::dvec2 water[] = {{3.6, 0.52}, {0.0, 0.521}};
    put(out, glossy({0.06f, 0.16f, 0.18f}, 0.5f, 80.0f), lathe(water, 48), place);
}

void write_balloon(AffWriter& out, const glm::vec3& colour)
{
    constexpr int around = 32;
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= 18; ++i) {
        const double s = i / 18.0, y = -9.0 + 18.0 * s;
        profile.emplace_back(i == 18 ? 0.0 : 8.0 * std::sqrt(std::sin(M_PI * std::pow(s * 0.94 + 0.06, 0.75))) * 0.98,
                             y);
    }
    const Mesh envelope = lathe(profile, around);
    const auto stripe = [](const glm::dvec3& p) {
        return static_cast<int>((std::atan2(p.z, p.x) + M_PI) * 8.0 / M_PI) % 2 == 0;
    };
    put(out, glossy(colour, 0.04f, 20.0f), part_of(envelope, stripe), {});
    put(out, glossy({0.95f, 0.92f, 0.82f}, 0.04f, 20.0f),
        part_of(envelope, [&](const glm::dvec3& p) { return !stripe(p); }), {});
    Mesh basket = rounded_box({0.8, 0.6, 0.8}, 0.15, 2);
    put(out, matt({0.50f, 0.34f, 0.18f}), basket, shift({0, -12.5, 0}));
    Mesh ropes;
    for (const double x : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) {
            const glm::dvec3 path[] = {{x * 0.7, -12.2, z * 0.7}, {x * 1.6, -8.6, z * 1.6}};
            const double thick[] = {0.04, 0.04};
            append(ropes, tube(path, thick, 5));
        }
    put(out, matt({0.25f, 0.2f, 0.15f}), ropes, {});
}

}  // namespace firstray::scenes
