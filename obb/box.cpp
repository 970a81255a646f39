#include "obb/box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "engine/core/search_ray.h"
#include "engine/grid/entry_kernels.h"
#include "obb/smallest_obb.h"

namespace firstray::inline v0::obb {
namespace {

/// Up to this many primitives a list of packs with boxes is as quick to search as a grid, or quicker.
constexpr std::size_t handful = 64;

template <typename Visit>
void for_each_primitive(const Scene& scene, const BoxPlan& plan, Visit&& visit)
{
    const Group& group = scene.groups[plan.group];
    for (const PrimitiveRange& range : plan.primitives)
        for (PrimitiveId id = range.first; id < range.first + range.count; ++id)
            visit(id, id - group.first < group.triangles);
}

/// The eight corners of a box around each primitive that is not a triangle, and the vertices of those that are.
std::vector<glm::dvec3> points_of(const Scene& scene, const BoxPlan& plan, const glm::dmat3& root_from_node)
{
    const Group& group = scene.groups[plan.group];
    std::vector<glm::dvec3> points;
    for_each_primitive(scene, plan, [&](PrimitiveId id, bool is_triangle) {
        if (is_triangle) {
            for (int k = 0; k < 3; ++k)
                points.push_back(root_from_node *
                                 scene.position(scene.triangles[id - group.first + group.first_triangle].vertex[k]));
            return;
        }
        const Quadric& shape = scene.quadrics[id - group.first - group.triangles + group.first_quadric];
        const DAabb box = place_quadric(shape, {root_from_node, glm::dvec3(0.0)}, id, false).bounds;
        for (int corner = 0; corner < 8; ++corner)
            points.emplace_back(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                                corner & 4 ? box.hi.z : box.lo.z);
    });
    std::erase_if(points, [](const glm::dvec3& p) { return !std::isfinite(p.x + p.y + p.z); });
    return points;
}

/// Of a group's primitives, only those of one of its boxes stay.
void keep_planned(const BoxPlan& plan, PrimitiveList& primitives)
{
    const auto is_another = [&](PrimitiveId id) {
        return std::none_of(plan.primitives.begin(), plan.primitives.end(), [&](const PrimitiveRange& range) {
            return id >= range.first && id < range.first + range.count;
        });
    };
    std::erase_if(primitives.triangles, is_another);
    std::erase_if(primitives.quadrics, is_another);
}

bool is_finite(const RootTriangle<float>& t)
{
    return std::isfinite(t.edge) && std::isfinite(t.v[0].x + t.v[0].y + t.v[0].z);
}

}  // namespace

double size_of(const glm::dmat3& linear)
{
    double size = 0.0;
    for (int row = 0; row < 3; ++row)
        size = std::max(size, std::abs(linear[0][row]) + std::abs(linear[1][row]) + std::abs(linear[2][row]));
    return size;
}

double blur_of(const glm::dmat3& local_from_root, double largest)
{
    constexpr double epsilon = std::numeric_limits<float>::epsilon();
    const double reach = largest <= farthest_place ? largest : farthest_place;  // nothing is met beyond
    return size_of(local_from_root) * reach * epsilon;
}

double BoxMaker::reach_of(const BoxPlan& plan) const
{
    const Group& group = scene.groups[plan.group];
    double reach = 0.0;
    for_each_primitive(scene, plan, [&](PrimitiveId id, bool is_triangle) {
        DAabb box;
        if (is_triangle) {
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 corner =
                    scene.position(scene.triangles[id - group.first + group.first_triangle].vertex[k]);
                if (std::isfinite(corner.x + corner.y + corner.z)) box.grow(corner);
            }
        } else {
            const Quadric& shape = scene.quadrics[id - group.first - group.triangles + group.first_quadric];
            box = place_quadric(shape, {}, id, false).bounds;
            if (box.empty()) reach = std::numeric_limits<double>::infinity();
        }
        reach = std::max(reach, largest_coordinate(box));
    });
    return reach;
}

GridOptions BoxMaker::shape_of(std::size_t primitives) const
{
    if (inside == Inside::grid || (inside != Inside::list && primitives > handful)) return grid;
    GridOptions list = grid;
    list.density = 1e-30f;
    list.depth = 1;
    return list;
}

void BoxMaker::fill(Box& box, GridEntries entries, PackOrder order, const Executor* executor,
                    std::uint64_t& peak_bytes) const
{
    GridOptions shape = shape_of(entries.count());
    shape.order = order;
    box.blur = entries.blur;
    if (inside != Inside::lazy) {
        box.inside = build_grid(std::move(entries), shape, executor, peak_bytes);
        return;
    }
    box.promise = std::make_unique<Promise>();
    box.promise->entries = std::move(entries);
    box.promise->shape = shape;
}

const GridStructure* Box::enter() const
{
    if (!promise) return &inside;
    return promise->made.get_or_make([&]() -> std::unique_ptr<GridStructure> {
        try {
            std::uint64_t peak_bytes = 0;
            return std::make_unique<GridStructure>(
                build_grid(std::move(promise->entries), promise->shape, nullptr, peak_bytes));
        } catch (const std::bad_alloc&) {
            return nullptr;  // primitives are tested one by one instead
        }
    });
}

std::uint64_t Box::bytes() const
{
    const GridStructure* made = grid();
    return (made ? made->bytes() : promise->entries.bytes()) + quadrics.capacity() * sizeof(RootQuadric);
}

Box BoxMaker::make(const BoxPlan& plan, const Transform& root_from_node, double largest,
                   std::uint64_t& peak_bytes) const
{
    const std::vector<glm::dvec3> points = points_of(scene, plan, root_from_node.linear);
    const Obb obb = smallest_obb(points);
    const glm::dmat3 local_from_turned = glm::transpose(obb.axes);
    // Twice what is needed now, so that a group that moves farther out is not made anew at once.
    return make_in(plan, {local_from_turned * root_from_node.linear, -(local_from_turned * obb.centre)},
                   static_cast<float>(2.0 * blur_of(local_from_turned, largest)), peak_bytes);
}

Box BoxMaker::make_in(const BoxPlan& plan, const Transform& local_from_node, float blur,
                      std::uint64_t& peak_bytes) const
{
    const Group& group = scene.groups[plan.group];
    Box box;
    box.local_from_node = local_from_node;
    box.node_from_local = inverse(local_from_node);
    GridEntries entries;
    entries.blur = blur;
    for_each_primitive(scene, plan, [&](PrimitiveId id, bool is_triangle) {
        const bool transmits = scene.material(id).transmits();
        if (!is_triangle) {
            const Quadric& shape = scene.quadrics[id - group.first - group.triangles + group.first_quadric];
            const RootQuadric placed = place_quadric(shape, box.local_from_node, id, transmits);
            if (placed.bounds.empty()) return;
            box.quadrics.push_back(placed);
            box.bounds.grow(box.quadrics.back().bounds);
            add_quadric(entries, box.quadrics.back());
            return;
        }
        const glm::uvec3& vertex = scene.triangles[id - group.first + group.first_triangle].vertex;
        RootTriangle<float> t;
        for (int k = 0; k < 3; ++k) t.v[k] = glm::vec3(box.local_from_node.point(scene.position(vertex[k])));
        t.edge = longest_edge<float>(t.v[0], t.v[1], t.v[2]);
        if (!is_finite(t)) return;
        for (const glm::vec3& corner : t.v) box.bounds.grow(glm::dvec3(corner));
        add_triangle(entries, t, id, transmits);
    });
    if (!keep_quadrics) box.quadrics = {};
    fill(box, std::move(entries), PackOrder::by_surface, nullptr, peak_bytes);
    return box;
}

template <typename Real>
Box BoxMaker::make_in_root(const BoxPlan& plan, const RootGeometry<Real>& geometry, const Transform& root_from_node,
                           const Executor* executor, std::uint64_t& peak_bytes) const
{
    Box box;
    box.local_from_node = root_from_node;
    box.node_from_local = inverse(root_from_node);
    PrimitiveList primitives;
    geometry.list(plan.group, primitives);
    if (plan.count() < scene.groups[plan.group].primitives()) keep_planned(plan, primitives);
    GridEntries entries = make_entries(geometry, primitives, executor);
    const Aabb bounds = bounds_of(entries, executor);
    box.bounds = {glm::dvec3(bounds.lo), glm::dvec3(bounds.hi)};
    fill(box, std::move(entries), PackOrder::along_curve, executor, peak_bytes);
    return box;
}

template Box BoxMaker::make_in_root(const BoxPlan&, const RootGeometry<float>&, const Transform&, const Executor*,
                                    std::uint64_t&) const;
template Box BoxMaker::make_in_root(const BoxPlan&, const RootGeometry<double>&, const Transform&, const Executor*,
                                    std::uint64_t&) const;

}  // namespace firstray::inline v0::obb
