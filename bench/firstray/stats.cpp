#include "bench/firstray/stats.h"

#include <fmt/format.h>

#include <fstream>

#include "bench/firstray/words.h"
#include "engine/core/pending_file.h"
#include "engine/core/simd.h"

namespace firstray::command {
namespace {

std::string cpu_model()
{
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);)
        if (line.starts_with("model name")) return std::string(trim(std::string_view(line).substr(line.find(':') + 1)));
    return "unknown";
}

#ifdef __clang__
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

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

}  // namespace

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
    return {{"cpu", cpu_model()},
            {"threads", Executor(0).threads()},
            {"instruction_set", instruction_set()},
            {"compiler", compiler},
            {"version", FIRSTRAY_VERSION}};
}

std::string table_heading()
{
    return fmt::format("{:>6} {:>9} {:>10} {:>10} {:>10} {:>8} {:>11} {:>8}\n", "frame", "pose ms", "update ms",
                       "trace ms", "total ms", "Mrays/s", "references", "MB");
}

std::string table_row(const FrameStats& stats)
{
    return fmt::format("{:>6} {:>9.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.3f} {:>11} {:>8.2f}\n", stats.frame,
                       stats.pose_ms, stats.update_ms, stats.trace_ms, stats.total_ms(), stats.rays_per_microsecond(),
                       stats.structure.references, static_cast<double>(stats.structure.bytes) * 1e-6);
}

StatsFile::StatsFile(std::filesystem::path file, Json settings) : file_(std::move(file))
{
    document_["machine"] = describe_machine();
    document_["settings"] = std::move(settings);
    document_["frames"] = Json::array();
}

void StatsFile::add(const FrameStats& stats)
{
    document_["frames"].push_back(to_json(stats));
    const bool recent = written_ && std::chrono::steady_clock::now() - last_write_ < std::chrono::seconds(1);
    if (!recent) flush();
}

void StatsFile::flush()
{
    if (file_.empty()) return;
    write_whole_file(file_, document_.dump(2) + "\n");
    written_ = true;
    last_write_ = std::chrono::steady_clock::now();
}

}  // namespace firstray::command
