#pragma once
#include "engine/scene/scene.h"

namespace firstray::scenes {

/// Materials by what they look like. Ambient and diffuse colour are one colour: what the light does is the lights'
/// matter.
inline Material matt(const glm::vec3& colour)
{
    return {.ambient = colour, .diffuse = colour};
}

/// Lacquer, enamel, glazed things: a highlight, and `mirror` of what is around.
inline Material glossy(const glm::vec3& colour, float mirror = 0.08f, float shine = 40.0f)
{
    return {.ambient = colour, .diffuse = colour, .specular = glm::vec3(mirror), .shine = shine};
}

/// Metal reflects in its own colour.
inline Material metal(const glm::vec3& colour, float mirror, float shine = 30.0f)
{
    return {.ambient = colour * (1.0f - mirror),
            .diffuse = colour * (1.0f - mirror),
            .specular = colour * mirror,
            .shine = shine};
}

/// Thin glass: lets `clear` of the light through, straight on.
inline Material pane(const glm::vec3& colour, float clear, float mirror)
{
    return {.ambient = colour,
            .diffuse = colour,
            .specular = glm::vec3(mirror),
            .shine = 80.0f,
            .transmittance = clear,
            .ior = 1.0f};
}

}  // namespace firstray::scenes
