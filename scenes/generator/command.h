#pragma once
#include <ostream>
#include <span>
#include <string>

namespace firstray::scenes {

/// Runs the command line (without the program's name): writes a scene and prints its file's name to `out`; reports what
/// goes wrong, one line, to `err`.
/// returns  the exit code: 0, or the value of Fault that the failure is to blame on
int run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err);

}  // namespace firstray::scenes
