// T1: no ray leaves a closed mesh, wherever on it the ray is aimed and wherever the mesh stands.
#include <fmt/format.h>

#include <array>

#include "tests/matrix/meshes.h"
#include "tests/matrix/shoot.h"

namespace firstray::matrix {
namespace {

using test::Random;
using test::TestRay;

enum Aim { at_random, at_vertices, at_edges, aims };
constexpr double offsets[] = {0.0, 1e3, 2.7e5, 1e6};

/// Rays from inside; every other batch has a common apex.
class RaysInside {
public:
    RaysInside(const ClosedMesh& mesh, const glm::dvec3& offset, std::vector<glm::dvec3> vertices, Aim aim)
        : mesh_(mesh), offset_(offset), vertices_(std::move(vertices)), aim_(aim)
    {
    }
    std::vector<TestRay> operator()(std::size_t batch) const
    {
        Random random(batch * 3 + aim_ + 1);
        std::vector<TestRay> rays(RayTile<float>::capacity);
        const glm::dvec3 apex = start(random);
        for (TestRay& ray : rays) {
            ray.origin = batch % 2 == 0 ? apex : start(random);
            ray.direction = aim_ == at_random ? random.in_cube(1.0) : target(random) - ray.origin;
        }
        return rays;
    }

private:
    glm::dvec3 start(Random& random) const { return glm::vec3(offset_ + random.in_cube(mesh_.room)); }
    glm::dvec3 target(Random& random) const
    {
        const glm::uvec3& t = mesh_.triangles[random.below(static_cast<std::uint32_t>(mesh_.triangles.size()))];
        const auto corner = static_cast<int>(random.below(3));
        const glm::dvec3 a = vertices_[t[corner]], b = vertices_[t[(corner + 1) % 3]];
        if (aim_ == at_vertices) return a;
        return random.unit() < 0.25 ? 0.5 * (a + b) : glm::mix(a, b, random.unit());
    }

    const ClosedMesh& mesh_;
    glm::dvec3 offset_;
    std::vector<glm::dvec3> vertices_;
    Aim aim_;
};

/// By strategy, offset and aim.
struct Misses {
    std::string name;
    bool peer = false;
    std::array<std::array<std::uint64_t, aims>, std::size(offsets)> misses{};
};

template <typename Real>
void shoot_mesh(const Matrix& matrix, const ClosedMesh& mesh, std::size_t place, bool is_carried, Precision precision,
                std::uint64_t batches, std::vector<Misses>& found)
{
    const glm::dvec3 offset = offsets[place] * glm::dvec3(1.0, -0.5, 0.25);
    const PlacedMesh placed(mesh, offset, is_carried);
    const Pose now = placed.posed();
    const auto all = contenders<Real>(placed.scene, now, {.precision = precision}, true);
    found.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        found[i].name = all[i].name;
        found[i].peer = all[i].peer;
        for (int aim = 0; aim < aims; ++aim)
            found[i].misses[place][static_cast<std::size_t>(aim)] += shoot<std::uint64_t>(
                matrix.executor(), *all[i].strategy, batches,
                RaysInside(mesh, offset, placed.vertices<Real>(now), static_cast<Aim>(aim)),
                [](const RayTile<Real>& tile, const std::vector<TestRay>&) {
                    return static_cast<std::uint64_t>(
                        std::count(tile.primitive.begin(), tile.primitive.begin() + tile.count, no_primitive));
                });
    }
}

std::string numbers(const Misses& misses, double rays)
{
    std::string text;
    for (int aim = 0; aim < aims; ++aim) {
        text += aim == 0 ? "random " : aim == 1 ? ", vertex " : ", edge ";
        for (std::size_t place = 0; place < std::size(offsets); ++place)
            text += fmt::format("{}{:.3g}", place == 0 ? "" : "/",
                                1e6 * static_cast<double>(misses.misses[place][static_cast<std::size_t>(aim)]) / rays);
    }
    return text;
}

bool is_tight(const Misses& misses)
{
    for (const auto& at_place : misses.misses)
        for (const std::uint64_t count : at_place)
            if (count > 0) return false;
    return true;
}

/// batches  per mesh, place and aim; the sphere gets four times as many
void measure(Matrix& matrix, Precision precision, std::uint64_t batches)
{
    std::vector<Misses> found;
    const ClosedMesh meshes[] = {round_mesh(), aligned_mesh(), crumpled_mesh()};
    const std::uint64_t per_aim = 2 * 6 * batches * RayTile<float>::capacity;  // two ways to stand, 4 + 1 + 1
    for (const ClosedMesh& mesh : meshes)
        for (std::size_t place = 0; place < std::size(offsets); ++place)
            for (const bool is_carried : {false, true})
                in_type_of(precision, [&](auto real) {
                    shoot_mesh<decltype(real)>(matrix, mesh, place, is_carried, precision,
                                               &mesh == meshes ? 4 * batches : batches, found);
                });
    const std::string tried =
        "closed sphere, aligned cube, crumpled mesh, in the root and carried by boxes; rays from "
        "inside, half of them with a common apex; misses per million at offsets 0/1e3/2.7e5/1e6, " +
        name_of(precision);
    std::string leaks;
    bool all_tight = true;
    for (const Misses& misses : found) {
        if (misses.peer || is_tight(misses)) continue;
        all_tight = false;
        leaks += (leaks.empty() ? "" : "; ") + misses.name + ": " + numbers(misses, static_cast<double>(per_aim));
    }
    const std::uint64_t n = per_aim * aims * std::size(offsets);
    matrix.add({.id = "T1",
                .tried = tried + ", each strategy of ours",
                .n = n,
                .result = all_tight ? "0, each" : leaks,
                .target = precision == Precision::fast ? "reported" : "0",
                .met = all_tight || precision == Precision::fast,
                .known_miss = {}});
    for (const Misses& misses : found)
        if (misses.peer)
            matrix.add({.id = "T1",
                        .tried = "the same, " + misses.name + ", " + name_of(precision),
                        .n = n,
                        .result = numbers(misses, static_cast<double>(per_aim)),
                        .target = "reported",
                        .known_miss = {}});
}

}  // namespace

void watertight_rows(Matrix& matrix)
{
    // 250 batches are a quarter of a million rays
    measure(matrix, Precision::robust, matrix.part_of(250));
    measure(matrix, Precision::fast, matrix.part_of(25));
    measure(matrix, Precision::double_, matrix.part_of(50));
}

}  // namespace firstray::matrix
