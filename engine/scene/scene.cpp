#include "engine/scene/scene.h"

#include <algorithm>

namespace firstray::inline v0 {

std::uint64_t Census::count(std::string_view statement) const
{
    for (const auto& [name, times] : statements)
        if (name == statement) return times;
    return 0;
}

std::size_t Scene::vertex_count() const
{
    return positions.size() + (shared.empty() ? 0 : shared.back().through);
}

glm::dvec3 Scene::position_among_shared(std::uint32_t vertex) const
{
    const auto behind = std::upper_bound(shared.begin(), shared.end(), vertex,
                                         [](std::uint32_t v, const SharedVertices& run) { return v < run.first; });
    if (behind == shared.begin()) return positions[vertex];
    const SharedVertices& run = behind[-1];
    if (vertex < run.first + run.count) return glm::dvec3(run.positions[vertex - run.first]);
    return positions[vertex - run.through];  // those of `positions` keep their order around the shared ones
}

double Scene::time_of(int frame) const
{
    if (frame <= 0 || frames <= 1) return start;
    if (frame >= frames - 1) return end;  // exactly, whatever the division would round to
    return start + frame * (end - start) / (frames - 1);
}

}  // namespace firstray::inline v0
