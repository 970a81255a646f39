#pragma once
#include <ostream>
#include <span>
#include <string>

namespace firstray::command {

/// Where a command writes: data to `out`, everything else to `err`.
struct Streams {
    std::ostream& out;
    std::ostream& err;
    bool terminal = false;  ///< a person watches `err`, so a line may be written over
};

/// Runs the command line (without the program's name) and reports what goes wrong, one line, to `err`.
/// returns  the exit code: 0, or the value of Fault that the failure is to blame on
int run(std::span<const std::string> arguments, Streams streams);

}  // namespace firstray::command
