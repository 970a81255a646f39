#include "engine/scene/scene.h"

namespace firstray {

std::uint64_t Census::count(std::string_view statement) const
{
    for (const auto& [name, times] : statements)
        if (name == statement) return times;
    return 0;
}

double Scene::time_of(int frame) const
{
    if (frame <= 0 || frames <= 1) return start;
    if (frame >= frames - 1) return end;  // exactly, whatever the division would round to
    return start + frame * (end - start) / (frames - 1);
}

}  // namespace firstray
