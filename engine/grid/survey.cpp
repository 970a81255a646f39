#include "engine/grid/survey.h"

#include <algorithm>
#include <cmath>

#include "engine/grid/entry_kernels.h"

namespace firstray::inline v0 {
namespace {

float half_area(const glm::vec3& d)
{
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

}  // namespace

Beginning survey(const GridEntries& entries, const Executor* executor)
{
    Beginning begun;
    LargestTriangles largest;
    begun.bounds = bounds_of(entries, executor, &largest);
    Aabb with_room = begun.bounds;
    with_room.grow(entries.room);
    // Written so that a room that is infinite is not taken.
    const float area = half_area(with_room.size());
    const bool is_near = area <= entries.most_room * half_area(begun.bounds.size());
    if (is_near || (begun.bounds.empty() && std::isfinite(area))) begun.bounds = with_room;
    if (begun.bounds.empty()) begun.bounds = {glm::vec3(0.0f), glm::vec3(0.0f)};

    for (const LargestTriangles::Triangle& triangle : largest.found())
        if (triangle.half_area > half_area(begun.bounds.size()) / 256.0f) begun.large.push_back(triangle.entry);
    std::sort(begun.large.begin(), begun.large.end());
    return begun;
}

}  // namespace firstray::inline v0
