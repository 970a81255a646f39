#include <algorithm>

#include "engine/aff/statements.h"

namespace firstray::inline v0 {
namespace {

/// A point light's optional colour is there exactly when numbers follow.
Light read_light_body(Reading& r)
{
    if (r.builder.inside_dynamic())
        r.in.statement_fault("light inside an animated transform", "lights outside (\"la\" and \"k\" move a light)");
    Light light;
    light.position = r.builder.owner_from_open().point(r.in.point());
    if (r.in.number_follows()) light.colour = r.in.vec3();
    return light;
}

void read_surface(Lexer& in, Material& material)
{
    constexpr double any = std::numeric_limits<float>::max();
    material.shine = static_cast<float>(in.number_in(0.0, any, "an exponent of at least 0"));
    material.transmittance = static_cast<float>(in.number_in(0.0, 1.0, "a transmittance in [0, 1]"));
    material.ior = static_cast<float>(in.number_in(0.0, any, "an index of refraction of at least 0"));
}

std::size_t read_key_count(Reading& r, std::int64_t least, const char* expected)
{
    const std::size_t keys = r.in.count(least, expected);
    if (keys > r.limits.keys) r.in.over_limit("keys in one track", r.limits.keys, "keys");
    return keys;
}

std::vector<Key> read_spline(Reading& r, bool with_angle)
{
    std::vector<Key> keys;
    const std::size_t count = read_key_count(r, 4, "a number of keys of at least 4");
    keys.reserve(std::min(count, r.in.remaining()));
    for (std::size_t i = 0; i < count; ++i) {
        Key key;
        key.time = r.in.number();
        key.value = r.in.point();
        if (with_angle) key.angle = r.in.number();
        key.tension = r.in.number();
        key.continuity = r.in.number();
        key.bias = r.in.number();
        keys.push_back(key);
    }
    return keys;
}

std::vector<VisibilityKey> read_visibility(Reading& r)
{
    std::vector<VisibilityKey> keys;
    const std::size_t count = read_key_count(r, 1, "a number of keys of at least 1");
    for (std::size_t i = 0; i < count; ++i) {
        const double time = r.in.number();
        keys.push_back({time, r.in.integer(0, 1, "0 or 1") == 1});
    }
    return keys;
}

int read_resolution(Reading& r)
{
    const std::size_t pixels = r.in.count(1, "a number of pixels of at least 1");
    if (pixels > r.limits.resolution) r.in.over_limit("pixels along an axis", r.limits.resolution, "resolution");
    return static_cast<int>(pixels);
}

/// Reads one track if one follows.
bool read_track(Reading& r, Animation& animation)
{
    const auto begins = [&r](const char* name, bool known) {
        if (!r.in.accept(name)) return false;
        if (known) r.in.fault("a kind of track that this block does not have yet");
        return true;
    };
    if (begins("transl", !animation.translation.empty()))
        animation.translation = VectorTrack(read_spline(r, false));
    else if (begins("rot", !animation.rotation.empty()))
        animation.rotation = RotationTrack(read_spline(r, true));
    else if (begins("scale", !animation.scale.empty()))
        animation.scale = VectorTrack(read_spline(r, false));
    else if (begins("visibility", !animation.visibility.empty()))
        animation.visibility = read_visibility(r);
    else
        return false;
    return true;
}

}  // namespace

void read_view(Reading& r)
{
    if (r.builder.depth() > 0) r.in.statement_fault("view inside a transform", "\"v\" outside of all braces");
    View view;
    r.in.keyword("from");
    view.from = r.in.point();
    r.in.keyword("at");
    view.at = r.in.point();
    if (view.at == view.from) r.in.statement_fault("view \"at\" the point it is \"from\"", "two different points");
    r.in.keyword("up");
    view.up = r.in.point();
    const glm::dvec3 right = glm::cross(glm::normalize(view.at - view.from), view.up);
    if (!(glm::length(right) > 1e-12 * glm::length(view.up)))
        r.in.statement_fault("view whose \"up\" is zero or along its direction", "a vector across it");
    r.in.keyword("angle");
    view.angle = r.in.number();
    if (!(view.angle > 0.0 && view.angle < 180.0)) r.in.fault("an angle in (0, 180) degrees");
    r.in.keyword("hither");
    view.hither = r.in.number();
    if (view.hither < 0.0001) view.hither = 1.0;  // as BART's parser does
    r.in.keyword("resolution");
    view.width = read_resolution(r);
    view.height = read_resolution(r);
    r.builder.scene.view = view;
}

void read_background(Reading& r)
{
    r.builder.scene.background = r.in.vec3();
}

void read_ambient(Reading& r)
{
    r.builder.scene.ambient = r.in.vec3();
}

void read_times(Reading& r)
{
    r.builder.scene.start = r.in.number();
    r.builder.scene.end = r.in.number();
    r.builder.scene.frames =
        static_cast<int>(r.in.integer(1, std::numeric_limits<int>::max(), "a number of frames of at least 1"));
}

void read_light(Reading& r)
{
    r.builder.add_light(read_light_body(r), "", r.in);
}

void read_named_light(Reading& r)
{
    const std::string name = r.in.word("the light's name");
    r.builder.add_light(read_light_body(r), name, r.in);
}

/// NFF has no ambient term: its materials are lit by lights alone.
void read_nff_material(Reading& r)
{
    Material material;
    const glm::vec3 colour = r.in.vec3();
    material.ambient = glm::vec3(0.0f);
    material.diffuse = static_cast<float>(r.in.number()) * colour;
    material.specular = glm::vec3(static_cast<float>(r.in.number()));
    read_surface(r.in, material);
    r.builder.material = material;
}

void read_material(Reading& r)
{
    Material material;
    material.ambient = r.in.vec3();
    material.diffuse = r.in.vec3();
    material.specular = r.in.vec3();
    read_surface(r.in, material);
    r.builder.material = material;
}

void read_keyframes(Reading& r)
{
    Animation animation;
    animation.name = r.in.word("the name of what moves");
    r.in.keyword("{");
    while (read_track(r, animation)) {
    }
    if (!r.in.accept("}")) r.in.fault("\"transl\", \"rot\", \"scale\", \"visibility\" or \"}\"");
    r.builder.set_animation(std::move(animation));
}

}  // namespace firstray::inline v0
