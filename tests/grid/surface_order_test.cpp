#include "engine/grid/surface_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "engine/grid/build.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// Small triangles on a sphere of radius 1, in no order.
GridEntries sphere(std::uint32_t count)
{
    Random random(5);
    GridEntries entries;
    for (std::uint32_t id = 0; id < count; ++id) {
        RootTriangle<float> t;
        const glm::dvec3 on = glm::normalize(random.in_cube(1.0));
        for (glm::vec3& corner : t.v) corner = glm::vec3(on + random.in_cube(0.02));
        t.edge = longest_edge<float>(t.v[0], t.v[1], t.v[2]);
        add_triangle(entries, t, id, false);
    }
    return entries;
}

std::vector<std::uint32_t> ids_of(const std::vector<PlacedTriangle>& triangles)
{
    std::vector<std::uint32_t> ids;
    for (const PlacedTriangle& triangle : triangles) ids.push_back(triangle.id);
    return ids;
}

/// Surface of the boxes around packs, one unit of it a chance to be met.
float surface_of_packs(PackOrder order, std::uint32_t count)
{
    GridOptions options{.density = 1e-30f, .max_list = 1 << 30, .depth = 1};
    options.order = order;
    std::uint64_t peak_bytes = 0;
    const GridStructure structure = build_grid(sphere(count), options, nullptr, peak_bytes);
    REQUIRE(structure.lists.size() == 1);
    float sum = 0.0f;
    for (std::uint32_t pack = 0; pack < structure.lists[0].packs; ++pack) {
        const Aabb box = structure.boxes[pack / pack_size].box(pack % pack_size);
        const glm::vec3 d = box.size();
        sum += d.x * d.y + d.y * d.z + d.z * d.x;
    }
    return sum;
}

}  // namespace

TEST_CASE("ordering by surface keeps every triangle, and does not depend on the order before")
{
    const GridEntries entries = sphere(1000);
    const Aabb voxel{glm::vec3(-2.0f), glm::vec3(2.0f)};
    std::vector<PlacedTriangle> forward;
    for (std::uint32_t entry = 0; entry < entries.triangles; ++entry) forward.push_back(entries.placed(entry));
    std::vector<PlacedTriangle> backward(forward.rbegin(), forward.rend());
    order_by_surface(entries.points(), voxel, forward);
    order_by_surface(entries.points(), voxel, backward);
    std::vector<std::uint32_t> ids = ids_of(forward);
    CHECK(ids == ids_of(backward));
    CHECK(!std::is_sorted(ids.begin(), ids.end()));
    std::sort(ids.begin(), ids.end());
    std::vector<std::uint32_t> all(1000);
    std::iota(all.begin(), all.end(), 0u);
    CHECK(ids == all);
}

TEST_CASE("packs in the order of surfaces have smaller boxes than along a curve")
{
    for (const std::uint32_t count : {100u, 1000u, 3000u}) {
        CAPTURE(count);
        CHECK(surface_of_packs(PackOrder::by_surface, count) < 0.85f * surface_of_packs(PackOrder::along_curve, count));
    }
}
