#include "engine/render/shade.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace firstray;

namespace {

const double root_half = std::sqrt(0.5);

/// A surface in the plane z = 0, met from +z by a ray in the y-z plane at an angle to the normal.
Surface met_at(double degrees, const Material& material)
{
    const double a = glm::radians(degrees);
    Surface s;
    s.direction = {0.0, std::sin(a), -std::cos(a)};
    s.geometric = s.normal = {0.0, 0.0, 1.0};
    s.material = &material;
    return s;
}

double sine(const glm::dvec3& direction)
{
    return direction.y / glm::length(direction);
}

}  // namespace

TEST_CASE("ambient light is coloured by the material and by the texture")
{
    const Material m{.ambient = {0.1f, 0.2f, 0.4f}};
    Surface s = met_at(0.0, m);
    s.texture = {0.5f, 1.0f, 0.25f};
    CHECK(glm::distance(ambient_term(s, {2.5f, 1.0f, 0.5f}), {0.125f, 0.2f, 0.05f}) < 1e-7f);
}

TEST_CASE("a light is reflected as N.l and as a power of R.V, the texture colouring the first alone")
{
    const Material m{.diffuse = {0.6f, 0.4f, 0.2f}, .specular = {0.1f, 0.2f, 0.3f}, .shine = 4.0f};
    Surface s = met_at(0.0, m);
    s.texture = {1.0f, 0.5f, 0.0f};
    // The light stands at 45 degrees: N.l = R.V = sqrt(1/2), R.V^4 = 1/4.
    const auto k = static_cast<float>(root_half);
    const glm::vec3 expected = glm::vec3(0.5f, 1.0f, 2.0f) * (glm::vec3(0.6f, 0.2f, 0.0f) * k + m.specular * 0.25f);
    CHECK(glm::distance(light_term(s, {0, 3, 3}, {0.5f, 1.0f, 2.0f}), expected) < 1e-6f);
}

TEST_CASE("the highlight is brightest where the viewer stands in the mirrored ray, and absent behind it")
{
    const Material m{.diffuse = glm::vec3(0.0f), .specular = glm::vec3(1.0f), .shine = 50.0f};
    const Surface s = met_at(45.0, m);
    CHECK(light_term(s, {0, 1, 1}, glm::vec3(1.0f)).x == doctest::Approx(1.0f));
    // Even powers, and powers that are no whole numbers, of a negative cosine.
    for (const float shine : {2.0f, 2.5f}) {
        const Material wide{.diffuse = glm::vec3(0.0f), .specular = glm::vec3(1.0f), .shine = shine};
        CHECK(light_term(met_at(45.0, wide), {0, -1, 0.1}, glm::vec3(1.0f)).x == 0.0f);
    }
}

TEST_CASE("an exponent of zero gives numbers")
{
    const Material shiny{.diffuse = glm::vec3(0.0f), .specular = glm::vec3(0.5f), .shine = 0.0f};
    const Material dull{.diffuse = glm::vec3(0.5f), .specular = glm::vec3(0.0f), .shine = 0.0f};
    CHECK(light_term(met_at(0.0, shiny), {0, 0, 2}, glm::vec3(1.0f)).x == 0.5f);
    CHECK(light_term(met_at(0.0, dull), {0, 0, 2}, glm::vec3(1.0f)).x == 0.5f);
    CHECK(light_term(met_at(89.0, dull), {0, 5, 1e-9}, glm::vec3(1.0f)).x >= 0.0f);
}

TEST_CASE("surfaces respond to lights in front of them that they do not swallow")
{
    const Material grey, black{.diffuse = glm::vec3(0.0f)};
    CHECK(responds_to(met_at(0.0, grey), {0, 5, 0.1}));
    CHECK_FALSE(responds_to(met_at(0.0, grey), {0, 5, 0}));
    CHECK_FALSE(responds_to(met_at(0.0, grey), {0, 5, -0.1}));
    CHECK_FALSE(responds_to(met_at(0.0, grey), {0, 0, 0}));
    CHECK_FALSE(responds_to(met_at(0.0, black), {0, 5, 0.1}));
}

TEST_CASE("a mirrored ray leaves at the angle it came in")
{
    const Material m;
    const glm::dvec3 d = reflected_direction(met_at(30.0, m));
    CHECK(glm::distance(d, {0.0, 0.5, std::sqrt(0.75)}) < 1e-15);
}

TEST_CASE("a mirrored ray leaves on the side it came from, however the shading normal leans")
{
    const Material m;
    Surface surface = met_at(30.0, m);
    for (int i = 0; i <= 90; ++i) {
        const double lean = i * M_PI / 180.0;
        const glm::dvec3 along =
            glm::normalize(surface.direction - glm::dot(surface.direction, surface.geometric) * surface.geometric);
        surface.normal = std::cos(lean) * surface.geometric - std::sin(lean) * along;
        const glm::dvec3 d = reflected_direction(surface);
        CHECK(glm::dot(d, surface.geometric) > 0.0);
        CHECK(glm::length(d) == doctest::Approx(1.0));
    }
}

TEST_CASE("transmitted rays bend by Snell's law into the material and out of it")
{
    const Material glass{.transmittance = 1.0f, .ior = 1.5f};
    const glm::dvec3 in = transmitted_direction(met_at(45.0, glass));
    CHECK(sine(in) == doctest::Approx(root_half / 1.5).epsilon(1e-12));
    CHECK(in.z < 0.0);
    CHECK(glm::length(in) == doctest::Approx(1.0).epsilon(1e-14));

    Surface leaving = met_at(30.0, glass);
    leaving.from_outside = false;
    const glm::dvec3 out = transmitted_direction(leaving);
    CHECK(sine(out) == doctest::Approx(0.75).epsilon(1e-12));
    CHECK(out.z < 0.0);
}

TEST_CASE("transmitted rays go straight on where the index of refraction is 0 or 1")
{
    for (const float ior : {0.0f, 1.0f}) {
        const Material thin{.transmittance = 0.5f, .ior = ior};
        CHECK(transmitted_direction(met_at(77.0, thin)) == met_at(77.0, thin).direction);
    }
}

TEST_CASE("beyond the critical angle all light is mirrored")
{
    const Material glass{.transmittance = 1.0f, .ior = 1.5f};
    const double critical = glm::degrees(std::asin(1.0 / 1.5));
    Surface below = met_at(critical - 0.01, glass), beyond = met_at(critical + 0.01, glass);
    below.from_outside = beyond.from_outside = false;
    CHECK(transmitted_direction(below).z < 0.0);
    CHECK(transmitted_direction(beyond) == reflected_direction(beyond));
    CHECK(transmitted_direction(beyond).z > 0.0);
}
