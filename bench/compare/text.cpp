#include "bench/compare/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace firstray::compare {

std::string short_number(double value)
{
    const double size = std::abs(value);
    if (size == 0.0) return "0";
    if (!std::isfinite(value)) return value > 0.0 ? "inf" : value < 0.0 ? "-inf" : "nan";
    if (size < 1e-3) return fmt::format("{:.1e}", value);
    if (size >= 99.95) return fmt::format("{:.0f}", value);
    const int digits = size >= 9.995 ? 1 : size >= 0.9995 ? 2 : size >= 0.09995 ? 3 : 4;
    return fmt::format("{:.{}f}", value, digits);
}

std::string milliseconds(double value)
{
    return short_number(value) + " ms";
}

std::string grouped(std::uint64_t value)
{
    std::string digits = std::to_string(value);
    for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), 1, ',');
    return digits;
}

std::string percent(double share)
{
    return short_number(100.0 * share) + " %";
}

std::string megabytes(double bytes)
{
    return short_number(1e-6 * bytes) + " MB";
}

std::string listed(const std::vector<std::string>& words)
{
    if (words.size() < 2) return words.empty() ? "none" : words.front();
    const std::vector<std::string> front(words.begin(), words.end() - 1);
    return fmt::format("{} and {}", fmt::join(front, ", "), words.back());
}

}  // namespace firstray::compare
