#pragma once
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

#include "bench/firstray/jobs.h"

namespace firstray::command {

/// What the options of all commands set.
struct Jobs {
    RenderJob render;
    CompareJob compare;
    InfoJob info;
    TraceJob trace;
    std::string memory;  ///< --memory-limit of any of them; empty: no limit
    std::string manual;  ///< which page the hidden command `manual` prints
};

/// The command line: what is parsed, and what help, the manual page and the completions of shells are made from.
/// jobs  outlives it
/// all   help shows what is seldom used, too
std::unique_ptr<CLI::App> make_command_line(Jobs& jobs, bool all);

/// The words that an option takes, e.g. of --strategy; empty where any will do.
std::vector<std::string> words_of(const CLI::Option& option);

/// Group of the options that help tells of only when asked for all.
inline constexpr const char* seldom = "Seldom used";

}  // namespace firstray::command
