#pragma once
#include <filesystem>
#include <string>

#include "bench/compare/contest.h"
#include "bench/measure/frame_stats.h"
#include "bench/measure/spread.h"

namespace firstray::compare {

// Everything that is told about a comparison is told from one JSON document, results.json, so that tables, charts and
// sentences cannot disagree with it:
//   format "firstray.compare", version 1
//   interrupted, load_before, command, created, machine, scene, settings
//   frames       by frame: rays by kind, and how many of them are replayed
//   strategies   by row: name, status ("exact", "close", "differs", "failed", "unmeasured"), reason, accuracy, times,
//                structure, and by frame every round's numbers
//   verdict      see verdict.h
//   prediction, frameless, trade   where they were made
inline constexpr const char* results_format = "firstray.compare";
inline constexpr int results_version = 1;

/// What the document says about the run itself.
struct RunFacts {
    std::string command;  ///< as typed
    std::string scene_file;
    bool interrupted = false;
    double load_before = 0.0;  ///< programs that ran in the minute before, on average; set by compare()
};

/// "other programs were at work ..." where the load before was more than a quarter of a processor; else nothing.
std::string load_warning(const Json& results);

Json results_of(const Contest& contest, const RunFacts& facts);

/// Update, trace and so on of one strategy, one value a round: the mean over frames. Empty where nothing was timed.
/// strategy  an entry of "strategies"
/// key       "update_ms", "trace_ms", "lazy_build_ms" or "structure_ms"; "total_ms" is update and trace
std::vector<double> by_round(const Json& strategy, const std::string& key);

Json to_json(const Spread& spread);
Json to_json(const ImageError& error);

/// Reads a results file.
/// file    results.json, or the folder it is in
/// throws  FileError; Error (Fault::file) for something else, or of another version
Json read_results(const std::filesystem::path& file);

/// A line per strategy, frame and round, with the strategy's accuracy behind it.
std::string to_csv(const Json& results);

}  // namespace firstray::compare
