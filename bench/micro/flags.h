#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/micro/measurement.h"

namespace firstray {

// What the benchmarks' command lines have in common. Each throws Error, Fault::usage, for what it cannot take.

struct NamedScene {
    std::string name;
    std::filesystem::path file;
};

/// Takes a program's own flags, --NAME=VALUE or --NAME, out of a command line and leaves Google Benchmark's, whose --help
/// follows ours.
/// apply  `apply(flag, value)` says whether the flag is the program's, and takes it
void take_flags(int& argc, char** argv, const char* usage,
                const std::function<bool(std::string_view flag, std::string_view value)>& apply);

[[noreturn]] void refuse(const std::string& message);
std::vector<std::string_view> split(std::string_view text, char separator);
/// A number >= 1.
int whole_number(std::string_view flag, std::string_view text);

/// Holds our kernels to an instruction set, and Embree with them.
void hold_to(std::string_view name);

/// The strategy of that name, of single precision.
const StrategyEntry* entry_of(std::string_view name);
/// A strategy's name, and its own choices behind it: NAME+FLAG=WORD+FLAG=WORD.
Contestant contestant_of(std::string_view text);

/// BART's scenes that are there; says on stderr, as `program`, which are not.
std::vector<NamedScene> bart_scenes(std::string_view program);

}  // namespace firstray
