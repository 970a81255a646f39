#include "bench/firstray/resume.h"

#include <fmt/format.h>

#include <filesystem>

#include "bench/firstray/output_pattern.h"
#include "engine/core/fnv.h"
#include "engine/core/pending_file.h"
#include "engine/image/image.h"

namespace firstray::command {
namespace {

std::uint64_t digest_of(const Scene& scene, std::span<const Texture> textures)
{
    std::uint64_t digest = scene.census.digest;
    for (const Texture& texture : textures) {
        digest = fnv_mixed(digest, static_cast<std::uint64_t>(texture.width));
        digest = fnv_mixed(
            digest, std::string_view(reinterpret_cast<const char*>(texture.pixels.data()), texture.pixels.size()));
    }
    return digest;
}

}  // namespace

Attributes run_attributes(const Scene& scene, std::span<const Texture> textures, const std::string& settings)
{
    return {{"firstray:scene", scene.name},
            {"firstray:input", fmt::format("{:016x}", digest_of(scene, textures))},
            {"firstray:version", FIRSTRAY_VERSION},
            {"firstray:settings", settings}};
}

Attributes frame_attributes(const Attributes& run, int frame)
{
    Attributes attributes = run;
    attributes.emplace_back("firstray:frame", std::to_string(frame));
    return attributes;
}

Resumption resume(std::span<const int> frames, const std::string& pattern, const Attributes& run)
{
    Resumption result;
    std::vector<std::filesystem::path> targets;
    for (const int frame : frames) {
        const std::filesystem::path file = frame_file(pattern, frame);
        if (image::is_whole_frame(file, frame_attributes(run, frame))) {
            ++result.kept;
            continue;
        }
        std::error_code error;
        result.of_another += std::filesystem::exists(file, error);
        result.missing.push_back(frame);
        targets.push_back(file);
    }
    remove_abandoned(targets);
    return result;
}

}  // namespace firstray::command
