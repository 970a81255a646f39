#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/render/render.h"
#include "engine/strategy/strategy.h"

namespace firstray::command {

using Json = nlohmann::ordered_json;

/// What rendering one frame took and gave. Files are neither read nor written while these clocks run.
struct FrameStats {
    int frame = 0;
    double time = 0.0;  ///< seconds of the animation
    double pose_ms = 0.0;
    double update_ms = 0.0;  ///< posing included
    double trace_ms = 0.0;
    RayCounts rays;
    StructureReport structure;
    std::uint64_t image_hash = 0;

    double total_ms() const { return update_ms + trace_ms; }
    double rays_per_microsecond() const { return static_cast<double>(rays.total()) / (1000.0 * trace_ms); }
};

Json to_json(const FrameStats& stats);

/// The processor, the threads and instruction set it offers, the compiler and our version.
Json describe_machine();

/// Heading and rows of the table that --table prints, one aligned line each.
std::string table_heading();
std::string table_row(const FrameStats& stats);

/// The file of --stats: {"machine", "settings", "frames"}. Replaced as a whole, at most once a second while frames are
/// added, so that a run that dies leaves what it had; flush() writes the rest.
class StatsFile {
public:
    /// file  an empty name: nothing is written
    StatsFile(std::filesystem::path file, Json settings);
    /// throws  FileError
    void add(const FrameStats& stats);
    /// throws  FileError
    void flush();

private:
    std::filesystem::path file_;
    Json document_;
    bool written_ = false;
    std::chrono::steady_clock::time_point last_write_{};
};

}  // namespace firstray::command
