#pragma once
#include <chrono>
#include <filesystem>
#include <string>

#include "bench/measure/frame_stats.h"

namespace firstray::command {

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
