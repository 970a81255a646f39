#pragma once
#include <cstdint>

#include "scenes/generator/aff_writer.h"
#include "scenes/generator/random.h"

namespace firstray::scenes {

/// A terraced house, its front towards +z: the ground at y = 0, walls down to -2 for ground that falls away.
struct House {
    double width = 10.0, depth = 9.0;  ///< along x, from -width / 2; along z, the front at 0, the back at -depth
    int storeys = 3;
};

/// plaster  texture of the walls
void write_house(AffWriter& out, const House& house, const Transform& world_from_house, std::string_view plaster,
                 Random& random);

/// Somebody in a long coat, about 1.8 high, front towards +z. The coat takes whatever material comes before.
void write_person(AffWriter& out, Random& random);
/// A broad-leaved tree, about 7 high.
void write_tree(AffWriter& out, Random& random);
/// A church with a tower of 38 m, its front towards +z.
void write_church(AffWriter& out, const Transform& world_from_church, std::string_view plaster);
/// A basin, 8 m across, with a bowl on a foot and still water.
void write_fountain(AffWriter& out, const Transform& world_from_fountain);
/// The envelope and basket of a balloon; its middle at the origin, about 20 high.
void write_balloon(AffWriter& out, const glm::vec3& colour);

/// Colours of coats and shutters.
glm::vec3 bright_colour(Random& random);

}  // namespace firstray::scenes
