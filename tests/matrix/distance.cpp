// How far t is off by the distance of a scene from the origin: ours as the reader places scenes, and where vertices
// stand in the world's coordinates, as Embree wants them.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "tests/matrix/meshes.h"
#include "tests/matrix/shoot.h"
#include "tests/support/scene_files.h"

namespace firstray::matrix {
namespace {

using test::Random;
using test::TestRay;

constexpr double place = 1e6;

/// A mesh as the text of a scene.
std::string text_of(const ClosedMesh& mesh, const glm::dvec3& offset)
{
    std::ostringstream text;
    text.precision(17);
    text << "fm 1 1 1 1 1 1 0 0 0 0 0 0\nm vertices " << mesh.positions.size() << '\n';
    for (const glm::dvec3& p : mesh.positions)
        text << offset.x + p.x << ' ' << offset.y + p.y << ' ' << offset.z + p.z << '\n';
    text << "triangles " << mesh.triangles.size() << '\n';
    for (const glm::uvec3& t : mesh.triangles) text << t.x << ' ' << t.y << ' ' << t.z << '\n';
    return text.str();
}

/// t of a ray in a triangle's plane, all as the scene's author meant it; root system.
double true_t(const Scene& scene, PrimitiveId id, const TestRay& ray)
{
    using Vec = glm::vec<3, long double, glm::defaultp>;
    const glm::uvec3& corner = scene.triangles[id].vertex;
    const Vec a = Vec(scene.positions[corner.x]) - Vec(scene.origin),
              b = Vec(scene.positions[corner.y]) - Vec(scene.origin),
              c = Vec(scene.positions[corner.z]) - Vec(scene.origin);
    const Vec normal = glm::cross(b - a, c - a);
    return static_cast<double>(glm::dot(normal, a - Vec(ray.origin)) / glm::dot(normal, Vec(ray.direction)));
}

/// Relative errors of t, ascending.
struct Errors {
    std::vector<double> errors;
    Errors& operator+=(const Errors& other)
    {
        errors.insert(errors.end(), other.errors.begin(), other.errors.end());
        return *this;
    }
    double percentile(double share)
    {
        std::sort(errors.begin(), errors.end());
        return errors.empty() ? NAN : errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
    }
};

template <typename Real>
Errors errors_of(const Matrix& matrix, const Strategy<Real>& strategy, const Scene& scene, std::uint64_t batches)
{
    const glm::dvec3 centre = place * glm::dvec3(1.0, -0.5, 0.25) - scene.origin;
    const auto make = [&](std::size_t batch) {
        Random random(batch + 5);
        std::vector<TestRay> rays(RayTile<Real>::capacity);
        for (TestRay& ray : rays)  // rounded to float, so that all are asked the same
            ray = {glm::vec3(centre + random.in_cube(40.0)), glm::vec3(random.in_cube(1.0))};
        return rays;
    };
    return shoot<Errors>(matrix.executor(), strategy, batches, make,
                         [&](const RayTile<Real>& tile, const std::vector<TestRay>& rays) {
                             Errors sum;
                             for (std::size_t i = 0; i < rays.size(); ++i) {
                                 if (tile.primitive[i] == no_primitive) continue;
                                 const double t = true_t(scene, tile.primitive[i], rays[i]);
                                 sum.errors.push_back(std::abs(static_cast<double>(tile.t_max[i]) - t) / t);
                             }
                             return sum;
                         });
}

void measure(Matrix& matrix, const Scene& scene, const std::string& how, const std::string& strategy,
             Precision precision, double most)
{
    const Pose now = pose(scene, scene.start);
    const std::uint64_t batches = matrix.part_of(250);
    in_type_of(precision, [&](auto real) {
        using Real = decltype(real);
        for (const Contender<Real>& contender : contenders<Real>(scene, now, {.precision = precision}, true)) {
            if (contender.name != strategy) continue;
            Errors errors = errors_of(matrix, *contender.strategy, scene, batches);
            const double worst = errors.percentile(0.999);
            matrix.add({.id = "T1",
                        .tried = fmt::format("relative error of t, sphere of radius 100 at offset 1e6, {}, {}, {}", how,
                                             strategy, name_of(precision)),
                        .n = batches * RayTile<Real>::capacity,
                        .result = fmt::format("median {:.1e}, p99.9 {:.1e}", errors.percentile(0.5), worst),
                        .target = most > 0.0 ? fmt::format("p99.9 <= {:.0e}", most) : "reported",
                        .met = most == 0.0 || worst <= most,
                        .known_miss = {}});
        }
    });
}

}  // namespace

void distance_rows(Matrix& matrix)
{
    const glm::dvec3 offset = place * glm::dvec3(1.0, -0.5, 0.25);
    const Scene read = test::scene_of(text_of(round_mesh(), offset));
    const PlacedMesh world(round_mesh(), offset, false);
    measure(matrix, read, "as scenes are read", "grid", Precision::robust, 2e-5);
    measure(matrix, read, "as scenes are read", "grid", Precision::double_, 1e-12);
    measure(matrix, world.scene, "float vertices in the world's coordinates", "grid", Precision::robust, 0.0);
    measure(matrix, world.scene, "float vertices in the world's coordinates", "embree", Precision::robust, 0.0);
}

}  // namespace firstray::matrix
