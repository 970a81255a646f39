#include "bench/firstray/stats.h"

#include <fmt/format.h>

#include "engine/core/pending_file.h"

namespace firstray::command {

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
    if (file_.empty()) return;
    document_["machine"] = describe_machine();
    document_["settings"] = std::move(settings);
    document_["frames"] = Json::array();
}

void StatsFile::add(const FrameStats& stats)
{
    if (file_.empty()) return;
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
