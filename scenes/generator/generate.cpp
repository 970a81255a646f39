#include "scenes/generator/generate.h"

namespace firstray::scenes {

std::span<const SceneEntry> scene_entries()
{
    static constexpr SceneEntry entries[] = {
        {"robot", "a walker of 18 rigid parts in empty space: nested transforms", "", "", 0, 0, 0, true, &write_robot},
        {"robots", "walkers meet in a street under glass: textures, mirrors", "--count", "robots", 10, 1, 500, true,
         &write_robots},
        {"art", "a thing that changes its shape in a gallery", "--triangles", "triangles in all", 2e4, 1e4, 1e6, true,
         &write_art},
        {"stadium", "a detailed small thing in a large coarse place", "--ratio", "how many times larger the place is",
         1000, 50, 1e5, false, &write_stadium},
        {"crowd", "a town among hills; a street hides nearly all of it", "--triangles", "triangles in all", 1e6, 1e5,
         1e8, true, &write_crowd},
        {"explode", "spheres burst into 400 pieces: nothing can be kept", "", "", 0, 0, 0, true, &write_explode},
    };
    return entries;
}

}  // namespace firstray::scenes
