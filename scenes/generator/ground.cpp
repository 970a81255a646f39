#include "scenes/generator/ground.h"

#include <algorithm>
#include <cmath>

#include "scenes/generator/looks.h"
#include "scenes/generator/motion.h"
#include "scenes/generator/random.h"
#include "scenes/generator/split_writer.h"
#include "scenes/generator/texture_maker.h"

namespace firstray::scenes {
namespace {

constexpr double hills_width = 450.0;

/// The triangles of a patch that lie in the town, or those that do not.
void write_patch(AffWriter& out, const Mesh& patch, const Ground& ground, bool town, const std::string& texture)
{
    Mesh part = part_of(patch, [&](const glm::dvec3& p) { return ground.in_town(p.x, p.z) == town; });
    if (part.triangles.empty()) return;
    for (const glm::dvec3& p : part.positions) part.uvs.push_back(glm::dvec2(p.x, p.z) / (town ? 4.0 : 60.0));
    for (Mesh::Triangle& t : part.triangles) t.uv = t.vertex;
    snap(part, 1e-2);
    if (town) part.normals.clear();  // nearly flat
    out.material(matt(town ? glm::vec3(0.80f, 0.76f, 0.72f) : glm::vec3(0.78f, 0.82f, 0.74f)));
    out.mesh(part, texture);
}

}  // namespace

Ground::Ground(double town_radius, std::uint64_t seed) : town_radius_(town_radius), seed_(Random::mixed(seed)) {}

double Ground::extent() const
{
    return town_radius_ + hills_width;
}

bool Ground::in_town(double x, double z) const
{
    return std::hypot(x, z) < town_radius_;
}

glm::dvec3 Ground::on(double x, double z) const
{
    const double waves = 0.8 * std::sin(x / 31.0 + 1.0) * std::cos(z / 43.0);
    const double rise = ease(town_radius_, town_radius_ + 0.8 * hills_width, std::hypot(x, z));
    if (rise <= 0.0) return {x, waves, z};
    const double shape = clouds(x / 170.0 + 100.0, z / 170.0 + 100.0, 1 << 20, 4, seed_);
    return {x, waves + rise * (25.0 + 150.0 * shape * shape), z};
}

void write_ground(const Request& request, const Ground& ground, std::uint64_t triangles, AffWriter& main)
{
    constexpr int patch = 30;  // less than 1000 vertices: indices of three digits
    write_cobbles(request.beside("cobbles.ppm"), request.seed);
    write_meadow(request.beside("meadow.ppm"), request.seed);
    const int cells = std::max(8, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0))));
    const double cell = 2.0 * ground.extent() / cells;
    SplitWriter files(request, "ground", main);
    for (int j = 0; j < cells; j += patch)
        for (int i = 0; i < cells; i += patch) {
            const int nu = std::min(patch, cells - i), nv = std::min(patch, cells - j);
            const Mesh mesh = surface(nu, nv, [&](double u, double v) {
                return ground.on((i + u * nu) * cell - ground.extent(), ground.extent() - (j + v * nv) * cell);
            });
            write_patch(files.out(), mesh, ground, true, request.name("cobbles.ppm"));
            write_patch(files.out(), mesh, ground, false, request.name("meadow.ppm"));
        }
    files.finish();
}

}  // namespace firstray::scenes
