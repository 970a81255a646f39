#include "engine/grid/fill_lists.h"

#include <utility>

namespace firstray::inline v0 {

void fill_lists(std::span<const ListToFill> to_fill, const GridEntries& entries, PackOrder order,
                const Executor* executor, GridStructure& structure)
{
    const auto triangles = [&](std::size_t i) { return triangles_of(structure.lists[i], to_fill[i]); };
    for_pieces(executor, to_fill.size(), 64, [&](std::size_t begin, std::size_t end) {
        // A list names triangles from all over the memory. While the lists before it are filled they are asked for: the
        // indices of their corners, and a list later, when these are there, the corners.
        PlacedTriangles now, next;
        place(entries, triangles(begin), now);
        for (std::size_t i = begin; i < end; ++i) {
            if (entries.corners && i + 2 < end)
                for (const std::uint32_t entry : triangles(i + 2))
                    __builtin_prefetch(&entries.corners[entries.ids[entry] & ~transmitting_bit]);
            if (i + 1 < end) place(entries, triangles(i + 1), next);
            fill_list(structure.lists[i], to_fill[i], now, entries, order, structure);
            std::swap(now, next);
        }
    });
}

}  // namespace firstray::inline v0
