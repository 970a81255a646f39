#include "bench/firstray/scene_input.h"

#include <fmt/format.h>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

struct LimitName {
    std::string_view name;
    std::uint64_t largest;  ///< that the program can count to
    std::uint64_t& (*in)(InputLimits&);
};

constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max(), indices = 1ull << 31;

constexpr LimitName limit_names[] = {
    {"include_depth", any, [](InputLimits& l) -> std::uint64_t& { return l.scene.include_depth; }},
    {"transform_depth", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.transform_depth; }},
    {"files", any, [](InputLimits& l) -> std::uint64_t& { return l.scene.files; }},
    {"file_bytes", any / 2, [](InputLimits& l) -> std::uint64_t& { return l.scene.file_bytes; }},
    {"expanded_bytes", any / 2, [](InputLimits& l) -> std::uint64_t& { return l.scene.expanded_bytes; }},
    {"primitives", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.primitives; }},
    {"vertices", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.vertices; }},
    {"transforms", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.transforms; }},
    {"lights", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.lights; }},
    {"textures", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.textures; }},
    {"keys", indices, [](InputLimits& l) -> std::uint64_t& { return l.scene.keys; }},
    {"resolution", 1u << 20, [](InputLimits& l) -> std::uint64_t& { return l.scene.resolution; }},
    {"texture_resolution", 1u << 20, [](InputLimits& l) -> std::uint64_t& { return l.textures.resolution; }},
    {"texture_bytes", any / 2, [](InputLimits& l) -> std::uint64_t& { return l.textures.bytes; }},
    {"texture_ratio", any, [](InputLimits& l) -> std::uint64_t& { return l.textures.ratio; }},
};

std::vector<std::string_view> names()
{
    std::vector<std::string_view> list;
    for (const LimitName& limit : limit_names) list.push_back(limit.name);
    return list;
}

void set_limit(std::string_view text, InputLimits& limits)
{
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
        throw UsageError(fmt::format("--limit: '{}', expected NAME=N with {}", text, list_of(names())));
    const LimitName& limit = limit_names[find_word("--limit", text.substr(0, equals), names())];
    const std::uint64_t value = parse_amount(fmt::format("--limit {}", limit.name), text.substr(equals + 1));
    if (value > limit.largest)
        throw UsageError(fmt::format("--limit {}: {}, expected at most {}", limit.name, value, limit.largest));
    limit.in(limits) = value;
}

}  // namespace

InputLimits limits_of(const SceneChoice& choice)
{
    InputLimits limits;
    limits.scene.allow_outside = limits.textures.allow_outside = choice.allow_outside;
    if (!choice.limits.empty())
        for (const std::string_view part : split(choice.limits, ',')) set_limit(part, limits);
    return limits;
}

Scene read_scene(const SceneChoice& choice)
{
    return read_aff(choice.file, limits_of(choice).scene);
}

std::vector<Texture> read_textures(const Scene& scene, const SceneChoice& choice)
{
    return image::read_textures(scene, limits_of(choice).textures);
}

}  // namespace firstray::command
