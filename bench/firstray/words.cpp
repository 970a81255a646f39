#include "bench/firstray/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/aff/reader.h"

namespace firstray::command {
namespace {

/// Levenshtein's distance: letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);  // distances of a's first i letters to each start of b
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

std::string_view trim(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

int parse_int(std::string_view what, std::string_view text, int low, int high)
{
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high)
        throw UsageError(fmt::format("{}: '{}', expected a whole number from {} to {}", what, text, low, high));
    return value;
}

std::uint64_t parse_amount(std::string_view what, std::string_view text)
{
    constexpr std::string_view suffixes = "KMGT";
    const std::size_t suffix = text.empty() ? std::string_view::npos : suffixes.find(text.back());
    const bool has_suffix = suffix != std::string_view::npos;
    const std::string_view digits = text.substr(0, text.size() - has_suffix);
    const std::uint64_t unit = has_suffix ? std::uint64_t{1} << (10 * (suffix + 1)) : 1;
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() ||
        value > std::numeric_limits<std::uint64_t>::max() / unit)
        throw UsageError(fmt::format("{}: '{}', expected a whole number, perhaps with K, M, G or T", what, text));
    return value * unit;
}

glm::ivec2 parse_size(std::string_view text)
{
    const auto axes = split(text, 'x');
    if (axes.size() != 2) throw UsageError(fmt::format("--size: '{}', expected WIDTHxHEIGHT, e.g. 800x600", text));
    const int largest = static_cast<int>(ReadLimits{}.resolution);
    return {parse_int("--size: width", axes[0], 1, largest), parse_int("--size: height", axes[1], 1, largest)};
}

int parse_share(std::string_view what, std::string_view text)
{
    constexpr int smallest_share = 4096;
    if (text == "1") return 1;
    if (!text.starts_with("1/")) throw UsageError(fmt::format("{}: '{}', expected 1 or 1/X, e.g. 1/5", what, text));
    return parse_int(what, text.substr(2), 1, smallest_share);
}

std::string list_of(std::span<const std::string_view> words)
{
    if (words.size() < 2) return std::string(words.empty() ? "none" : words.front());
    return fmt::format("{} or {}", fmt::join(words.first(words.size() - 1), ", "), words.back());
}

std::string suggestion(std::string_view word, std::span<const std::string_view> words)
{
    std::string_view nearest;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;  // further off is another word, not a slip
    for (const std::string_view known : words)
        if (const std::size_t distance = edit_distance(word, known); distance < least) {
            least = distance;
            nearest = known;
        }
    return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

std::size_t find_word(std::string_view what, std::string_view word, std::span<const std::string_view> words)
{
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    throw UsageError(fmt::format("{}: '{}', expected {}{}", what, word, list_of(words), suggestion(word, words)));
}

}  // namespace firstray::command
