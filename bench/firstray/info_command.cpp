#include <fmt/format.h>

#include <algorithm>

#include "bench/firstray/frame_list.h"
#include "bench/firstray/jobs.h"
#include "bench/firstray/scene_input.h"
#include "bench/firstray/scene_summary.h"
#include "bench/firstray/search.h"
#include "bench/firstray/stats.h"
#include "bench/firstray/structure_table.h"
#include "bench/firstray/words.h"
#include "engine/image/image.h"
#include "lazy/calibrate.h"

namespace firstray::command {
namespace {

Json to_json(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

Json describe_groups(const Scene& scene)
{
    const auto moving = std::count_if(scene.groups.begin(), scene.groups.end(),
                                      [](const Group& group) { return group.node != 0 || group.deforming; });
    const auto deforming =
        std::count_if(scene.groups.begin(), scene.groups.end(), [](const Group& group) { return group.deforming; });
    return {{"static", static_cast<std::ptrdiff_t>(scene.groups.size()) - moving},
            {"moving", moving},
            {"deforming", deforming}};
}

Json describe_textures(const Scene& scene, const std::vector<Texture>& textures)
{
    Json list = Json::array();
    for (std::size_t i = 0; i < textures.size(); ++i)
        list.push_back({{"file", scene.textures[i]}, {"width", textures[i].width}, {"height", textures[i].height}});
    return list;
}

Json describe_bounds(const Scene& scene, const Pose& start)
{
    const DAabb box = bounds(start);
    if (box.empty()) return nullptr;
    return {{"lo", to_json(box.lo + scene.origin)}, {"hi", to_json(box.hi + scene.origin)}};
}

Json describe_camera(const Scene& scene, const Pose& start)
{
    return {{"eye", to_json(start.camera.eye + scene.origin)},
            {"forward", to_json(start.camera.forward)},
            {"up", to_json(start.camera.up)},
            {"angle", scene.view.angle},
            {"hither", scene.view.hither},
            {"moves", scene.camera_animation != none}};
}

Json describe_motion(const SceneMotion& motion)
{
    Json list = Json::array();
    for (const GroupMotion& group : motion.movers)
        list.push_back({{"name", group.name},
                        {"primitives", group.primitives},
                        {"deforms", group.deforms},
                        {"reach", group.reach}});
    return {{"still", motion.still}, {"rigid", motion.rigid}, {"deforming", motion.deforming}, {"groups", list}};
}

Json describe_recommendation(const Scene& scene, const SceneMotion& motion)
{
    const auto rays = static_cast<std::uint64_t>(scene.view.width) * static_cast<std::uint64_t>(scene.view.height);
    const auto [strategy, reason] = recommend(motion, rays);
    return {{"strategy", strategy}, {"reason", reason}};
}

Json describe(const Scene& scene, const std::vector<Texture>& textures)
{
    const Pose start = pose(scene, scene.start);
    const SceneMotion motion = motion_of(scene);
    Json statements = Json::object();
    for (const auto& [word, count] : scene.census.statements) statements[word] = count;
    return {{"name", scene.name},
            {"files", scene.census.files},
            {"file_bytes", scene.census.bytes},
            {"statements", statements},
            {"triangles", scene.triangles.size()},
            {"deforming_triangles", scene.deforming.size()},
            {"quadrics", scene.quadrics.size()},
            {"parts", scene.parts.size()},
            {"groups", describe_groups(scene)},
            {"transforms", scene.nodes.empty() ? 0 : scene.nodes.size() - 1},  // the root is not one
            {"animations", scene.animations.size()},
            {"lights", scene.lights.size()},
            {"materials", scene.materials.size()},
            {"textures", describe_textures(scene, textures)},
            {"bounds", describe_bounds(scene, start)},
            {"origin", to_json(scene.origin)},
            {"animation", {{"start", scene.start}, {"end", scene.end}, {"frames", scene.frames}}},
            {"camera", describe_camera(scene, start)},
            {"resolution", {scene.view.width, scene.view.height}},
            {"motion", describe_motion(motion)},
            {"recommended", describe_recommendation(scene, motion)}};
}

std::string vector_text(const Json& v)
{
    return fmt::format("{:.6g} {:.6g} {:.6g}", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

std::string row(std::string_view name, const std::string& value)
{
    return fmt::format("{:<12} {}\n", name, value);
}

std::string row(const Json& info, const char* name)
{
    return row(name, info[name].dump());
}

/// "statements   fm 1849, x 20, ...", wrapped like text.
std::string statement_rows(const Json& statements)
{
    constexpr std::size_t width = 100;
    std::string text, line;
    for (const auto& [word, count] : statements.items()) {
        const std::string item = fmt::format("{} {}", word, count.dump());
        if (line.size() + item.size() > width) text += row(text.empty() ? "statements" : "", std::exchange(line, {}));
        line += (line.empty() ? "" : "  ") + item;
    }
    return text + row(text.empty() ? "statements" : "", line);
}

std::string texture_rows(const Json& textures)
{
    std::string text = row("textures", std::to_string(textures.size()));
    for (const Json& texture : textures)
        text += fmt::format("{:<12} {} {}x{}\n", "", texture["file"].get<std::string>(), texture["width"].dump(),
                            texture["height"].dump());
    return text;
}

/// What moves, the largest groups by name.
std::string motion_rows(const Json& motion)
{
    constexpr std::size_t most = 6;
    const auto count = [&](const char* name) { return motion[name].get<std::uint64_t>(); };
    const double total = std::max(1.0, static_cast<double>(count("still") + count("rigid") + count("deforming")));
    const auto share = [&](const char* name) { return 100.0 * static_cast<double>(count(name)) / total; };
    std::string text =
        row("motion", fmt::format("{:.3g} % of the primitives stand still, {:.3g} % move rigidly, {:.3g} % "
                                  "deform",
                                  share("still"), share("rigid"), share("deforming")));
    const Json& groups = motion["groups"];
    for (std::size_t i = 0; i < std::min(most, groups.size()); ++i) {
        const Json& group = groups[i];
        const double reach = group["reach"].get<double>();
        text += fmt::format("{:<12} {:<24} {:>9} primitives, {}{}\n", "", group["name"].get<std::string>(),
                            group["primitives"].dump(), group["deforms"].get<bool>() ? "deforming" : "rigid",
                            reach > 0.0 ? fmt::format(", up to {:.3g} away", reach) : "");
    }
    if (groups.size() > most) text += fmt::format("{:<12} and {} more\n", "", groups.size() - most);
    return text;
}

/// The strategy, why, and what to type.
std::string recommendation_rows(const Json& recommended, const std::string& file)
{
    const std::string strategy = recommended["strategy"].get<std::string>();
    return row("recommended", fmt::format("{}: {}", strategy, recommended["reason"].get<std::string>())) +
           row("", fmt::format("firstray render {} --strategy {}", file, strategy));
}

std::string table(const Json& info)
{
    const Json &groups = info["groups"], &animation = info["animation"], &camera = info["camera"];
    std::string text = row("name", info["name"].get<std::string>());
    text += row("files", fmt::format("{} ({} bytes)", info["files"].dump(), info["file_bytes"].dump()));
    text += row("triangles",
                fmt::format("{}, {} of them deforming", info["triangles"].dump(), info["deforming_triangles"].dump()));
    for (const char* name : {"quadrics", "parts"}) text += row(info, name);
    text += row("groups", fmt::format("{} static, {} moving, {} of them deforming", groups["static"].dump(),
                                      groups["moving"].dump(), groups["deforming"].dump()));
    for (const char* name : {"transforms", "animations", "lights", "materials"}) text += row(info, name);
    if (info["bounds"].is_null())
        text += row("bounds", "nothing is visible at the start");
    else
        text += row("bounds", fmt::format("{} to {} at the start", vector_text(info["bounds"]["lo"]),
                                          vector_text(info["bounds"]["hi"])));
    text += row("origin", vector_text(info["origin"]));
    text += row("animation", fmt::format("{} frames, {} s to {} s", animation["frames"].dump(),
                                         animation["start"].dump(), animation["end"].dump()));
    text += row("camera", fmt::format("eye {}, forward {}, {:.6g} degrees, {}", vector_text(camera["eye"]),
                                      vector_text(camera["forward"]), camera["angle"].get<double>(),
                                      camera["moves"].get<bool>() ? "moves" : "stands"));
    text += row("resolution", fmt::format("{}x{}", info["resolution"][0].dump(), info["resolution"][1].dump()));
    return text + statement_rows(info["statements"]) + texture_rows(info["textures"]) + motion_rows(info["motion"]);
}

void add_structure(const InfoJob& job, const Scene& scene, Json& info)
{
    const Executor executor(job.search.threads);
    const AnyStrategy strategy = make_strategy(job.search, scene, executor);
    const Pose current = pose(scene, scene.time_of(job.frame));
    const auto outline = std::visit(
        [&](const auto& chosen) {
            chosen->update(current);
            return chosen->outline();
        },
        strategy);
    info["structure_of"] = {
        {"strategy", job.search.strategy}, {"precision", job.search.precision}, {"frame", job.frame}};
    info["structure"] = describe_structure(outline, scene.origin);
}

std::string structure_rows(const Json& info)
{
    const std::string strategy = info["structure_of"]["strategy"].get<std::string>();
    if (info["structure"].empty()) return row("structure", fmt::format("strategy {} has none to show", strategy));
    return row("structure", fmt::format("strategy {}, frame {}", strategy, info["structure_of"]["frame"].dump())) +
           structure_table(info["structure"]);
}

Json describe_costs(const lazy::Costs& costs)
{
    Json list = Json::object();
    for (const lazy::CostName& name : lazy::cost_names()) list[std::string(name.name)] = costs.*name.cost;
    return list;
}

std::string cost_rows(const Json& costs)
{
    std::string text;
    for (const lazy::CostName& name : lazy::cost_names())
        text +=
            row(text.empty() ? "costs" : "", fmt::format("{:<10} {:>8.1f} ns  {}", name.name,
                                                         costs[std::string(name.name)].get<double>(), name.meaning));
    return text;
}

/// What adaptive counts with on this machine, unless the user says otherwise.
lazy::Costs costs_of(const InfoJob& job)
{
    try {
        return job.replaces_costs() ? lazy::replace_costs(lazy::calibrated_costs(), job.costs)
                                    : lazy::calibrated_costs();
    } catch (const std::invalid_argument& error) {
        throw UsageError(fmt::format("--costs: {}", error.what()));
    }
}

Json describe_scene(const InfoJob& job)
{
    const Scene scene = read_scene(job.scene);
    check_frame(job.frame, scene.frames);
    Json info = describe(scene, read_textures(scene, job.scene));
    if (job.structure) add_structure(job, scene, info);
    return info;
}

}  // namespace

void print_info(const InfoJob& job, Streams streams)
{
    if (job.structure) check_search(job.search);
    const Json costs = job.costs.empty() ? Json() : describe_costs(costs_of(job));
    Json info = job.scene.file.empty() ? Json::object() : describe_scene(job);
    if (!costs.is_null()) info["costs"] = costs;
    if (job.json) {
        streams.out << info.dump(2) << "\n";
        return;
    }
    if (!job.scene.file.empty())
        streams.out << table(info) << recommendation_rows(info["recommended"], job.scene.file)
                    << (job.structure ? structure_rows(info) : "");
    if (!costs.is_null()) streams.out << cost_rows(costs);
}

}  // namespace firstray::command
