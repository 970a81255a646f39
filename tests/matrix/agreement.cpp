// T2: every strategy finds the list's hits, bit for bit.
#include <fmt/format.h>

#include "engine/aff/reader.h"
#include "tests/matrix/meshes.h"
#include "tests/matrix/shoot.h"
#include "tests/support/moving_scenes.h"

namespace firstray::matrix {
namespace {

using test::Random;
using test::TestRay;

struct Exam {
    std::string name;
    Scene scene;
    double time;
};

/// A floor and a wall of quads on whole coordinates, n by n each.
Scene aligned_planes(int n, const glm::dvec3& offset)
{
    test::SmallScene small;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            small.quad({}, offset + glm::dvec3(i + 0.5, 0, j + 0.5), {0.5, 0, 0}, {0, 0, 0.5});
            small.quad({}, offset + glm::dvec3(i + 0.5, j + 0.5, 0), {0.5, 0, 0}, {0, 0.5, 0});
        }
    return small.build();
}

std::vector<Exam> exams()
{
    std::vector<Exam> all;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        all.push_back({"random", test::random_scene(seed, 1200, seed == 4 ? glm::dvec3(3e4) : glm::dvec3(0)), 0.0});
    all.push_back({"planes", aligned_planes(16, glm::dvec3(0)), 0.0});
    all.push_back({"planes", aligned_planes(16, glm::dvec3(1e5, 0, -1e5)), 0.0});
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        all.push_back({"moving", test::moving_scene(seed), 2.0 * static_cast<double>(seed)});
    for (const char* file : {"everything", "primitives", "tracks", "orrery"}) {
        all.push_back({file, read_aff(fmt::format("scenes/{}.aff", file)), 0.0});
        all.back().time = 0.37 * all.back().scene.start + 0.63 * all.back().scene.end;
    }
    return all;
}

/// Corners of cells of a grid over the scene.
std::vector<glm::dvec3> cell_corners(const Scene& scene, const Pose& now)
{
    Random random(9);
    std::vector<glm::dvec3> corners;
    const auto grid = find_strategy("grid")->make(scene, {.grid_density = 1.0f});
    grid->update(now);
    for (const StructureBox& box : grid->outline())
        for (int i = 0; i < 300 && corners.size() < 3000; ++i) {
            glm::dvec3 at(0.0);
            for (int axis = 0; axis < 3; ++axis)
                at[axis] = static_cast<double>(random.below(static_cast<std::uint32_t>(box.dims[axis] + 1))) /
                           std::max(1, box.dims[axis]);
            corners.push_back(box.root_from_box.point(at));
        }
    return corners;
}

}  // namespace

void agreement_rows(Matrix& matrix)
{
    Agreement sum[std::size(all_precisions)];
    const std::uint64_t full[] = {100, 1000, 100};
    std::uint64_t scenes = 0;
    for (const Exam& exam : exams()) {
        ++scenes;
        const Pose now = pose(exam.scene, exam.time);
        const Scene vertices = test::targets_of(now);
        Scene targets = vertices;
        const std::vector<glm::dvec3> corners = cell_corners(exam.scene, now);
        targets.positions.insert(targets.positions.end(), corners.begin(), corners.end());
        const auto make = [&](std::size_t batch) {
            Random random(batch);
            const glm::dvec3& at =
                targets.positions[random.below(static_cast<std::uint32_t>(targets.positions.size()))];
            constexpr int count = RayTile<float>::capacity;
            if (batch % 3 == 0) return test::awkward_rays(batch, targets, count);
            // fans: from anywhere near, from a vertex or a cell's corner, from far away
            const double away = batch % 3 == 1 ? 20.0 : batch % 6 == 2 ? 0.0 : 1e6;
            return test::rays_from(batch, targets, at + random.in_cube(1.0) * away, count);
        };
        for (std::size_t i = 0; i < std::size(all_precisions); ++i)
            sum[i] += ours_against_list(matrix.executor(), exam.scene, now, {.precision = all_precisions[i]},
                                        matrix.part_of(full[i], 5), make);
    }
    for (std::size_t i = 0; i < std::size(all_precisions); ++i) {
        // From far away `fast` takes for hits what passes beside a triangle, where structures do not look for it.
        const bool is_reported = all_precisions[i] == Precision::fast;
        matrix.add(
            {.id = "T2",
             .tried = fmt::format("each strategy of ours against list, {} scenes, rays one by one and from common "
                                  "apexes at vertices, edges and corners of cells; t, u, v, id and occlusion, {}",
                                  scenes, name_of(all_precisions[i])),
             .n = sum[i].rays,
             .result = fmt::format("{} of {} hits differ", sum[i].different, sum[i].hits),
             .target = is_reported ? "reported" : "0",
             .met = is_reported || (sum[i].different == 0 && sum[i].hits > sum[i].rays / 100),
             .known_miss = {}});
    }
}

}  // namespace firstray::matrix
