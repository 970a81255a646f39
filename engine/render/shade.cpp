#include "engine/render/shade.h"

#include <algorithm>
#include <cmath>

namespace firstray::inline v0 {
namespace {

/// The direction mirrored at the plane of a unit normal, made unit again.
glm::dvec3 mirrored(const glm::dvec3& direction, const glm::dvec3& normal)
{
    return glm::normalize(direction - 2.0 * glm::dot(direction, normal) * normal);
}

/// max(0, R.V)^shine.
float highlight(const Surface& s, const glm::dvec3& l, double n_dot_l)
{
    const double r_dot_v = -glm::dot(2.0 * n_dot_l * s.normal - l, s.direction);
    if (!(r_dot_v > 0.0)) return 0.0f;
    return std::pow(std::min(static_cast<float>(r_dot_v), 1.0f), s.material->shine);
}

/// Sine of the least angle at which a mirrored ray leaves its surface.
constexpr double least_rise = 0.02;

/// Cosine of the largest angle between the normals of what is flat: of float normals, rounding turns them by less.
constexpr double flat = 1.0 - 1e-12;

bool goes_straight_on(const Material& material)
{
    return material.ior == 0.0 || material.ior == 1.0;
}

}  // namespace

glm::vec3 ambient_term(const Surface& surface, const glm::vec3& ambient)
{
    return ambient * surface.material->ambient * surface.texture;
}

bool responds_to(const Surface& surface, const glm::dvec3& to_light)
{
    const Material& m = *surface.material;
    const bool black = m.diffuse == glm::vec3(0.0f) && m.specular == glm::vec3(0.0f);
    return !black && glm::dot(surface.normal, to_light) > 0.0;
}

glm::vec3 light_term(const Surface& surface, const glm::dvec3& to_light, const glm::vec3& colour)
{
    const Material& m = *surface.material;
    const glm::dvec3 l = to_light * (1.0 / glm::length(to_light));
    const double n_dot_l = glm::dot(surface.normal, l);
    glm::vec3 sum = m.diffuse * surface.texture * static_cast<float>(n_dot_l);
    if (m.specular != glm::vec3(0.0f)) sum += m.specular * highlight(surface, l, n_dot_l);
    return colour * sum;
}

glm::dvec3 reflected_direction(const Surface& surface)
{
    const glm::dvec3 mirror = mirrored(surface.direction, surface.normal);
    const double rise = glm::dot(mirror, surface.geometric);
    if (rise >= least_rise) return mirror;
    return glm::normalize(mirror + (least_rise - rise) * surface.geometric);
}

std::optional<glm::dvec3> reflected_origin(const Surface& surface)
{
    const bool is_lifted = -glm::dot(surface.direction, surface.geometric) < least_rise;
    if (is_lifted || glm::dot(surface.normal, surface.geometric) < flat) return {};
    return surface.origin - 2.0 * glm::dot(surface.origin - surface.point, surface.geometric) * surface.geometric;
}

glm::dvec3 transmitted_direction(const Surface& surface)
{
    if (goes_straight_on(*surface.material)) return surface.direction;
    const double ior = surface.material->ior;
    const double eta = surface.from_outside ? 1.0 / ior : ior;
    const double cos_in = -glm::dot(surface.direction, surface.normal);
    const double cos_out_squared = 1.0 - eta * eta * (1.0 - cos_in * cos_in);
    if (cos_out_squared < 0.0) return reflected_direction(surface);
    return glm::normalize(eta * surface.direction + (eta * cos_in - std::sqrt(cos_out_squared)) * surface.normal);
}

std::optional<glm::dvec3> transmitted_origin(const Surface& surface)
{
    if (!goes_straight_on(*surface.material)) return {};
    return surface.origin;
}

}  // namespace firstray::inline v0
