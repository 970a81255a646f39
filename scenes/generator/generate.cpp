#include "scenes/generator/generate.h"

namespace firstray::scenes {

std::span<const SceneEntry> scene_entries()
{
    static constexpr SceneEntry entries[] = {
        {"robot", "a walker of 18 rigid parts in empty space: nested transforms", "", "", 0, 0, 0, true, &write_robot},
        {"robots", "walkers meet in a street under glass: textures, mirrors", "--count", "robots", 10, 1, 500, true,
         &write_robots},
        {"crowd", "a town among hills; a street hides nearly all of it", "--triangles", "triangles in all", 1e6, 1e5,
         1e8, true, &write_crowd},
    };
    return entries;
}

}  // namespace firstray::scenes
