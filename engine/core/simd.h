#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace firstray::inline v0 {

/// The instruction sets that this machine has kernels for, best first, e.g. {"AVX3", "AVX2", "SSE4", "EMU128"}.
std::vector<std::string> instruction_sets();

/// The one in use: the best, unless another was asked for.
std::string instruction_set();

/// Uses one of instruction_sets() from now on, in the whole process, or the best for an empty name. Not while anything
/// is traced. All give the same hits; this is for tests and measurements.
/// throws  std::invalid_argument for a name that is not in instruction_sets()
void use_instruction_set(std::string_view name);

}  // namespace firstray::inline v0
