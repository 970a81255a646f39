#pragma once
#include <glm/glm.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/errors.h"

namespace firstray::command {

/// What the user typed and we cannot take; the message says what was expected.
class UsageError : public Error {
public:
    explicit UsageError(const std::string& message) : Error(Fault::usage, message) {}
};

/// The parts of `text` between separators; an empty text is one empty part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// `text` without blanks, tabs and carriage returns at its ends.
std::string_view trim(std::string_view text);

/// The whole of `text` as a decimal integer in [low, high].
/// what    names the value in the message, e.g. "--size"
/// throws  UsageError
int parse_int(std::string_view what, std::string_view text, int low, int high);

/// A whole number that may end in K, M, G or T: times 1024, 1024^2 ...
/// throws  UsageError
std::uint64_t parse_amount(std::string_view what, std::string_view text);

/// "WIDTHxHEIGHT" of a picture, as --size takes it.
/// throws  UsageError
glm::ivec2 parse_size(std::string_view text);

/// X of "1/X", or 1 of "1": a share of the pixels.
/// throws  UsageError
int parse_share(std::string_view what, std::string_view text);

/// "a, b or c".
std::string list_of(std::span<const std::string_view> words);

/// "; did you mean X?" for the word most like `word`, or nothing where none is like it.
std::string suggestion(std::string_view word, std::span<const std::string_view> words);

/// Position of `word` among `words`.
/// what    names the value in the message, e.g. "--precision"
/// throws  UsageError that lists the words
std::size_t find_word(std::string_view what, std::string_view word, std::span<const std::string_view> words);

}  // namespace firstray::command
