#include "engine/grid/surface_order.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/grid/pack_lists.h"

namespace firstray::inline v0 {
namespace {

struct Item {
    Aabb box;
    PlacedTriangle triangle;
};

float half_surface(const Aabb& box)
{
    const glm::vec3 d = box.size();
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

void sort_along(int axis, std::span<Item> items)
{
    std::sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) {
        const float x = a.box.lo[axis] + a.box.hi[axis], y = b.box.lo[axis] + b.box.hi[axis];
        return x < y || (x == y && a.triangle.id < b.triangle.id);
    });
}

struct Cut {
    float cost = std::numeric_limits<float>::infinity();
    std::size_t items = pack_size;  ///< on its near side: whole packs
};

/// The best cut of items that are sorted.
Cut best_cut(std::span<const Item> items, std::vector<float>& behind)
{
    behind.resize(items.size());
    Aabb box;
    for (std::size_t i = items.size(); i-- > 0;) {
        box.grow(items[i].box);
        behind[i] = half_surface(box);
    }
    const std::size_t packs = (items.size() + pack_size - 1) / pack_size;
    Cut best;
    Aabb before;
    for (std::size_t pack = 1; pack < packs; ++pack) {
        const std::size_t end = pack * pack_size;
        for (std::size_t i = end - pack_size; i < end; ++i) before.grow(items[i].box);
        const float cost =
            half_surface(before) * static_cast<float>(pack) + behind[end] * static_cast<float>(packs - pack);
        if (cost < best.cost) best = {cost, end};
    }
    return best;
}

void order(std::span<Item> items, std::vector<float>& behind)
{
    if (items.size() <= pack_size) return;
    Cut best;
    int along = 0;
    for (int axis = 0; axis < 3; ++axis) {
        sort_along(axis, items);
        const Cut cut = best_cut(items, behind);
        if (!(cut.cost < best.cost)) continue;
        best = cut;
        along = axis;
    }
    sort_along(along, items);
    order(items.first(best.items), behind);
    order(items.subspan(best.items), behind);
}

}  // namespace

void order_by_surface(const glm::vec3* points, const Aabb& voxel, std::span<PlacedTriangle> triangles)
{
    thread_local std::vector<Item> items;
    thread_local std::vector<float> behind;
    items.clear();
    for (const PlacedTriangle& triangle : triangles) {
        Aabb box;
        for (const std::uint32_t corner : triangle.corner) box.grow(points[corner]);
        items.push_back({clipped(box, voxel), triangle});
    }
    order(items, behind);
    std::transform(items.begin(), items.end(), triangles.begin(), [](const Item& item) { return item.triangle; });
}

}  // namespace firstray::inline v0
