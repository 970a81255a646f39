#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firstray::compare {

// Numbers as people read them.

/// Three digits, at least: "0.0123", "12.3", "1230".
std::string short_number(double value);
/// The same with " ms".
std::string milliseconds(double value);
/// "1,234,567".
std::string grouped(std::uint64_t value);
/// A share as "12.3 %".
std::string percent(double share);
/// Bytes as "12.3 MB".
std::string megabytes(double bytes);
/// "a, b and c".
std::string listed(const std::vector<std::string>& words);

}  // namespace firstray::compare
