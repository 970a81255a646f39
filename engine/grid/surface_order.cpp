#include "engine/grid/surface_order.h"

#include <algorithm>
#include <cstdint>
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

struct Cut {
    float cost = std::numeric_limits<float>::infinity();
    int axis = 0;
    std::size_t items = pack_size;  ///< on its near side: whole packs
};

/// Items by the numbers that they have along each axis: sorted once, and kept so wherever they are cut. Its memory is
/// used again.
class SortedItems {
public:
    std::vector<Item> items;

    /// Calls back with the items, each once.
    template <typename Take>
    void in_order(const Take& take)
    {
        for (int axis = 0; axis < 3; ++axis) sort_along(axis);
        is_near_.resize(items.size());
        far_.resize(items.size());
        visit({0, items.size(), 0}, take);
    }

private:
    /// Items [begin, end) of each axis' order: the same ones.
    struct Range {
        std::size_t begin, end;
        int axis;  ///< along which they were cut from the others
        std::size_t size() const { return end - begin; }
    };

    struct Place {
        float middle;  ///< twice
        PrimitiveId id;
        std::uint32_t item;
    };

    void sort_along(int axis)
    {
        places_.clear();
        for (const Item& item : items)
            places_.push_back(
                {item.box.lo[axis] + item.box.hi[axis], item.triangle.id, static_cast<std::uint32_t>(places_.size())});
        std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
            return a.middle < b.middle || (a.middle == b.middle && a.id < b.id);
        });
        std::vector<std::uint32_t>& order = order_[axis];
        order.clear();
        for (const Place& place : places_) order.push_back(place.item);
    }

    template <typename Take>
    void visit(const Range& range, const Take& take)
    {
        if (range.size() <= pack_size) {
            for (std::size_t i = range.begin; i < range.end; ++i) take(items[order_[range.axis][i]]);
            return;
        }
        Cut best;
        for (int axis = 0; axis < 3; ++axis) find_cut(range, axis, best);
        cut(range, best);
        const std::size_t middle = range.begin + best.items;
        visit({range.begin, middle, best.axis}, take);
        visit({middle, range.end, best.axis}, take);
    }

    /// Replaces `best` by the best cut along an axis if that is better.
    void find_cut(const Range& range, int axis, Cut& best)
    {
        const std::uint32_t* const order = order_[axis].data() + range.begin;
        const std::size_t packs = (range.size() + pack_size - 1) / pack_size;
        boxes_.assign(packs, {});
        for (std::size_t i = 0; i < range.size(); ++i) boxes_[i / pack_size].grow(items[order[i]].box);
        behind_.resize(packs);
        Aabb behind;
        for (std::size_t pack = packs; pack-- > 1;) {
            behind.grow(boxes_[pack]);
            behind_[pack] = half_surface(behind);
        }
        Aabb before;
        for (std::size_t pack = 1; pack < packs; ++pack) {
            before.grow(boxes_[pack - 1]);
            const float cost =
                half_surface(before) * static_cast<float>(pack) + behind_[pack] * static_cast<float>(packs - pack);
            if (cost < best.cost) best = {cost, axis, pack * pack_size};
        }
    }

    /// Brings the items on the near side to the front of every axis' order.
    void cut(const Range& range, const Cut& at)
    {
        const std::vector<std::uint32_t>& along = order_[at.axis];
        for (std::size_t i = range.begin; i < range.end; ++i) is_near_[along[i]] = i < range.begin + at.items;
        for (std::vector<std::uint32_t>& order : order_) {
            if (&order == &along) continue;
            std::size_t near = range.begin, far = 0;
            for (std::size_t i = range.begin; i < range.end; ++i) {  // no branches: they are as random as the items
                const std::uint32_t item = order[i];
                order[near] = far_[far] = item;
                near += is_near_[item];
                far += is_near_[item] ^ 1u;
            }
            std::copy_n(far_.begin(), far, order.begin() + static_cast<std::ptrdiff_t>(near));
        }
    }

    std::vector<std::uint32_t> order_[3];  ///< by axis
    std::vector<std::uint8_t> is_near_;    ///< by item
    std::vector<std::uint32_t> far_;
    std::vector<Place> places_;
    std::vector<Aabb> boxes_;    ///< by pack
    std::vector<float> behind_;  ///< by pack: surface of the box around it and those after it
};

}  // namespace

void order_by_surface(const glm::vec3* points, const Aabb& voxel, std::span<PlacedTriangle> triangles)
{
    thread_local SortedItems sorted;
    sorted.items.clear();
    for (const PlacedTriangle& triangle : triangles) {
        Aabb box;
        for (const std::uint32_t corner : triangle.corner) box.grow(points[corner]);
        sorted.items.push_back({clipped(box, voxel), triangle});
    }
    auto next = triangles.begin();
    sorted.in_order([&](const Item& item) { *next++ = item.triangle; });
}

}  // namespace firstray::inline v0
