#include "engine/grid/fill_lists.h"

namespace firstray::inline v0 {

void fill_lists(std::span<const ListToFill> to_fill, const GridEntries& entries, PackOrder order,
                const Executor* executor, GridStructure& structure)
{
    const auto triangles = [&](std::size_t i) {
        return to_fill[i].entries.first(to_fill[i].entries.size() - structure.lists[i].quadrics);
    };
    const auto indices = [&](std::uint32_t entry) -> const glm::uvec3& {
        return entries.corners[entries.ids[entry] & ~transmitting_bit];
    };
    for_pieces(executor, to_fill.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            // A list names triangles from all over the memory. While the lists before it are filled they are asked for:
            // the indices of their corners, and a list later, when these are there, the corners.
            if (entries.corners && i + 2 < end)
                for (const std::uint32_t entry : triangles(i + 2)) __builtin_prefetch(&indices(entry));
            if (entries.corners && i + 1 < end)
                for (const std::uint32_t entry : triangles(i + 1)) {
                    const glm::uvec3& corner = indices(entry);
                    __builtin_prefetch(&entries.vertices[corner.x]);
                    __builtin_prefetch(&entries.vertices[corner.z]);
                }
            fill_list(structure.lists[i], to_fill[i], entries, order, structure);
        }
    });
}

}  // namespace firstray::inline v0
