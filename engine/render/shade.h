#pragma once
#include <glm/glm.hpp>

#include <optional>

#include "engine/render/surface.h"

namespace firstray::inline v0 {

// The shading rule: Whitted's, with Phong's highlight about the mirrored light.
//
//   colour = am A tex + sum over lights of vis L (D tex max(0, N.l) + S max(0, R.V)^shine)
//          + S trace(reflected) + T trace(transmitted)
//
// am is the scene's ambient light; A, D, S, shine, T the material's; tex the texture (white without one); L the light's
// colour, l the unit vector to it, R = 2 (N.l) N - l; V the unit vector to the ray's origin; N the shading normal on
// V's side. A light behind the shading normal gives nothing. Lights do not fade with distance; vis is 0 behind an
// opaque surface and the product of T over the transmitting ones otherwise, passed without bending.
// Source: T. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980.

/// am A tex.
glm::vec3 ambient_term(const Surface& surface, const glm::vec3& ambient);

/// Whether a light can add anything, unless something stands between.
/// to_light  from the surface's point to the light, any length
bool responds_to(const Surface& surface, const glm::dvec3& to_light);

/// L (D tex N.l + S max(0, R.V)^shine), for a light that the surface responds to.
/// to_light  as above, not zero
glm::vec3 light_term(const Surface& surface, const glm::dvec3& to_light, const glm::vec3& colour);

/// Unit direction of the mirrored ray. Where a shading normal leans so far from the geometric one that the mirror image
/// lies behind the surface, it is lifted just above it: a ray into the wall would see what is behind the scene.
glm::dvec3 reflected_direction(const Surface& surface);

/// The mirror image of the point that the surface's ray came from: all rays from there that the same plane mirrors come
/// from it. Nothing where the surface is curved, or the mirrored ray is lifted.
std::optional<glm::dvec3> reflected_origin(const Surface& surface);

/// Unit direction of the ray that goes on behind the surface: straight where the index of refraction is 0 or 1, bent by
/// Snell's law otherwise, from vacuum into the material where the ray comes from outside and back where it does not;
/// mirrored where the reflection is total.
glm::dvec3 transmitted_direction(const Surface& surface);

/// The point that the surface's ray came from, where it goes straight on.
std::optional<glm::dvec3> transmitted_origin(const Surface& surface);

}  // namespace firstray::inline v0
