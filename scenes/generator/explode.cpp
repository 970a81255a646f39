#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scenes/generator/aff_writer.h"
#include "scenes/generator/generate.h"
#include "scenes/generator/looks.h"
#include "scenes/generator/motion.h"
#include "scenes/generator/random.h"
#include "scenes/generator/texture_maker.h"

namespace firstray::scenes {
namespace {

constexpr double seconds = 5.0, bang = 0.8;  // when the pieces come apart
const glm::dvec3 centre(0.0, 2.3, 0.0);

using Corners = std::array<glm::dvec3, 3>;

/// The faces of an icosahedron, cut in four `levels` times, on the unit sphere.
std::vector<Corners> sphere_faces(int levels)
{
    constexpr double g = 1.618033988749895;
    const glm::dvec3 v[] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    constexpr int corner[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    std::vector<Corners> faces;
    for (const auto& c : corner)
        faces.push_back({glm::normalize(v[c[0]]), glm::normalize(v[c[1]]), glm::normalize(v[c[2]])});
    for (; levels > 0; --levels) {
        std::vector<Corners> finer;
        for (const auto& [a, b, c] : faces) {
            const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    return faces;
}

/// A face cut into n^2 triangles on a sphere of the given radius; `out` is which way it faces. Smooth.
void add_skin(Mesh& mesh, const Corners& c, int n, double radius, double out)
{
    std::vector<std::uint32_t> row_start;
    for (int j = 0; j <= n; ++j) {
        row_start.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        for (int i = 0; i <= n - j; ++i) {
            const glm::dvec3 p = glm::normalize(c[0] * double(n - i - j) + c[1] * double(i) + c[2] * double(j));
            mesh.positions.push_back(radius * p);
            mesh.normals.push_back(out * p);
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t d) {
        if (out < 0.0) std::swap(b, d);
        mesh.triangles.push_back({{a, b, d}, {a, b, d}, {}});
    };
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(n); ++j)
        for (std::uint32_t i = 0; i + j < static_cast<std::uint32_t>(n); ++i) {
            const std::uint32_t a = row_start[j] + i, d = row_start[j + 1] + i;
            add(a, a + 1, d);
            if (i + j + 1 < static_cast<std::uint32_t>(n)) add(a + 1, d + 1, d);
        }
}

/// The broken sides of a piece between two spheres.
Mesh sides(const Corners& c, int n, double inner, double outer)
{
    Mesh mesh;
    for (std::size_t k = 0; k < 3; ++k)
        for (int i = 0; i < n; ++i) {
            const glm::dvec3 a = glm::normalize(glm::mix(c[k], c[(k + 1) % 3], double(i) / n)),
                             b = glm::normalize(glm::mix(c[k], c[(k + 1) % 3], double(i + 1) / n));
            add_quad(mesh, inner * a, inner * b, outer * b, outer * a);
        }
    return mesh;
}

/// A hollow sphere that comes apart into its faces.
struct Shell {
    const char* name;
    int levels, detail;
    double inner, outer, speed;
    Material outside, inside, edge;
};

void put(AffWriter& out, const Material& material, Mesh mesh, const glm::dvec3& middle)
{
    for (glm::dvec3& p : mesh.positions) p -= middle;
    snap(mesh, 1e-4);
    out.material(material);
    out.mesh(mesh);
}

void write_piece(AffWriter& out, const Shell& shell, const Corners& corners, const std::string& name, Random& random)
{
    const glm::dvec3 away = glm::normalize(corners[0] + corners[1] + corners[2]);
    const glm::dvec3 middle = away * 0.5 * (shell.inner + shell.outer);
    const double reach = shell.speed * random.between(0.55, 1.25), haste = random.between(0.9, 1.3);
    const glm::dvec3 drift = random.in_cube(0.35), axis = glm::normalize(random.in_cube(1.0) + glm::dvec3(1e-3));
    const double spin = random.between(0.6, 3.2);
    // thrown out and braked; time since the bang, stretched by what the piece loses
    const auto gone = [=](double t) { return t < bang ? 0.0 : 1.0 - std::exp(-haste * (t - bang)); };
    const auto place = [=](double t) {
        const glm::dvec3 p = centre + middle + gone(t) * (reach * away + drift) +
                             glm::dvec3(0.0, -0.06 * gone(t) * (t - bang) * (t - bang), 0.0);
        return glm::dvec3(p.x, std::max(p.y, 0.18), p.z);
    };
    const auto turned = [=](double t) { return rotation_about(axis, spin * 1.6 * gone(t) * gone(t)); };
    out.keys(motion(name, {0.0, seconds, 50}, place, turned));
    out.open(name);
    Mesh outside, inside;
    add_skin(outside, corners, shell.detail, shell.outer, 1.0);
    add_skin(inside, corners, shell.detail, shell.inner, -1.0);
    put(out, shell.outside, outside, middle);
    put(out, shell.inside, inside, middle);
    put(out, shell.edge, sides(corners, shell.detail, shell.inner, shell.outer), middle);
    out.close();
}

void write_studio(AffWriter& out, const Request& request)
{
    write_plaster(request.beside("plaster.ppm"), request.seed);
    Material floor = glossy({0.20f, 0.22f, 0.27f}, 0.22f, 30.0f);
    // a floor that bends up into a wall
    const auto sweep = [](double u, double v) {
        const double s = 14.0 * v, bend = 3.0, x = 28.0 * (u - 0.5);
        if (s < 9.0) return glm::dvec3(x, 0.0, 5.0 - s * 1.2);
        const double angle = std::min((s - 9.0) / 2.5, 1.0) * M_PI_2;
        const double rise = std::max(0.0, s - 11.5) * 5.0;
        return glm::dvec3(x, bend * (1.0 - std::cos(angle)) + rise, -5.8 - bend * std::sin(angle));
    };
    Mesh mesh = surface(28, 56, sweep, {7.0, 6.0});
    snap(mesh, 1e-3);
    out.material(floor);
    out.mesh(mesh, request.name("plaster.ppm"));
}

void write_settings(AffWriter& out)
{
    const auto eye = [](double t) { return glm::dvec3(-1.6 + 0.65 * t, 2.5 + 0.1 * t, 9.4 - 0.12 * t); };
    const auto target = [](double) { return glm::dvec3(0.0, 2.15, 0.0); };
    out.view({.from = eye(0.0), .at = target(0.0), .angle = 44.0, .hither = 0.1, .width = 800, .height = 600});
    out.frames(0.0, seconds, 120);
    out.background({0.05f, 0.06f, 0.08f});
    out.ambient({0.30f, 0.31f, 0.36f});
    out.light({-5.0, 9.0, 8.0}, {0.80f, 0.76f, 0.70f});
    out.light({7.0, 5.0, 1.0}, {0.22f, 0.26f, 0.38f});
    out.light(centre, {0.55f, 0.36f, 0.16f});
    out.keys(motion("camera", {0.0, seconds, 10}, eye, [&](double t) { return looking(eye(t), target(t)); }));
}

}  // namespace

/// Nothing that is kept of one frame serves in the next, and boxes that were apart come to overlap.
std::uint64_t write_explode(const Request& request)
{
    AffWriter out(request.file);
    out.comment("Two hollow spheres burst around a glowing one. Made by firstray's generator; CC0.");
    write_settings(out);
    write_studio(out, request);
    const Shell shells[] = {{"outer", 2, 4, 1.51, 1.60, 2.6, glossy({0.07f, 0.36f, 0.42f}, 0.16f, 60.0f),
                             metal({0.90f, 0.62f, 0.36f}, 0.35f), matt({0.84f, 0.79f, 0.70f})},
                            {"inner", 1, 4, 0.80, 0.95, 1.1, glossy({0.62f, 0.12f, 0.12f}, 0.16f, 60.0f),
                             metal({0.95f, 0.75f, 0.40f}, 0.35f), matt({0.72f, 0.50f, 0.30f})}};
    for (const Shell& shell : shells) {
        std::uint64_t index = 0;
        for (const Corners& corners : sphere_faces(shell.levels)) {
            Random random(request.seed, static_cast<std::uint64_t>(shell.levels), index);
            write_piece(out, shell, corners, std::string(shell.name) + "_" + std::to_string(index++), random);
        }
    }
    out.material({.ambient = {2.6f, 1.9f, 0.9f}, .diffuse = {0.3f, 0.2f, 0.1f}});
    Mesh core = ball(0.45, 24, 48);
    for (glm::dvec3& p : core.positions) p += centre;
    snap(core, 1e-3);
    out.mesh(core);
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
