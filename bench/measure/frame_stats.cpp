#include "bench/measure/frame_stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "engine/core/simd.h"
#ifdef FIRSTRAY_HAVE_EMBREE
#include "bench/peers/embree.h"
#endif

namespace firstray {
namespace {

std::string cpu_model()
{
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);)
        if (line.starts_with("model name"))
            return line.substr(std::min(line.find_first_not_of(" \t", line.find(':') + 1), line.size()));
    return "unknown";
}

#ifdef __clang__
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace

Json to_json(const RayCounts& rays)
{
    return {{"primary", rays.primary},
            {"shadow", rays.shadow},
            {"reflected", rays.reflected},
            {"transmitted", rays.transmitted}};
}

Json to_json(const StructureReport& report)
{
    return {{"grids", report.grids},
            {"voxels", report.voxels},
            {"filled_voxels", report.filled_voxels},
            {"subgrids", report.subgrids},
            {"references", report.references},
            {"primitives", report.primitives},
            {"depth", report.depth},
            {"largest_list", report.largest_list},
            {"bytes", report.bytes},
            {"peak_bytes", report.peak_bytes},
            {"regridded", report.regridded},
            {"built_voxels", report.built_voxels},
            {"kept_voxels", report.kept_voxels},
            {"dropped_voxels", report.dropped_voxels},
            {"refused_builds", report.refused_builds}};
}

Json to_json(const ChoiceReport& choices)
{
    return {{"lists", choices.lists},
            {"grids", choices.grids},
            {"not_entered", choices.not_entered},
            {"spent_ms", choices.spent_ms},
            {"hindsight_ms", choices.hindsight_ms},
            {"ratio", choices.ratio()}};
}

Json to_json(const FrameStats& stats)
{
    Json json = {{"frame", stats.frame},
                 {"time", stats.time},
                 {"pose_ms", stats.pose_ms},
                 {"update_ms", stats.update_ms},
                 {"trace_ms", stats.trace_ms},
                 {"total_ms", stats.total_ms()},
                 {"lazy_build_ms", stats.structure.lazy_build_ms},
                 {"rays", to_json(stats.rays)},
                 {"structure", to_json(stats.structure)},
                 {"image_hash", fmt::format("{:016x}", stats.image_hash)}};
    if (stats.structure.choices.is_made) json["adaptive"] = to_json(stats.structure.choices);
    return json;
}

Json describe_machine()
{
    Json machine = {
        {"cpu", cpu_model()},     {"threads", Executor(0).threads()}, {"instruction_set", instruction_set()},
        {"compiler", compiler},   {"version", FIRSTRAY_VERSION},      {"libraries", FIRSTRAY_LIBRARIES},
        {"peers", Json::object()}};
#ifdef FIRSTRAY_HAVE_EMBREE
    machine["peers"]["Embree"] = peers::embree_version();
#endif
    return machine;
}

}  // namespace firstray
