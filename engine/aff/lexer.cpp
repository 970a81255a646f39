#include "engine/aff/lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace firstray::inline v0 {
namespace {

bool is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');  // tab, newline, vertical tab, form feed, carriage return
}

bool is_comment(char c)
{
    return c == '#' || c == '%';
}

bool is_brace(char c)
{
    return c == '{' || c == '}';
}

bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool ends_word(char c)
{
    return is_space(c) || is_comment(c) || is_brace(c);
}

std::string shown(const FilePlace& at)
{
    return at.file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

}  // namespace

std::string printable(std::string_view text)
{
    constexpr char digits[] = "0123456789abcdef";
    constexpr std::size_t longest = 500;
    std::string result;
    for (const char c : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte >= 0x7f)
            result += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
        else
            result += c;
    }
    if (text.size() > longest) result += "...";
    return result;
}

std::string quote(std::string_view text)
{
    constexpr std::size_t longest = 80;
    std::string result = "\"";
    for (const char c : text.substr(0, longest)) {
        if (c == '"' || c == '\\') result += '\\';
        result += printable({&c, 1});
    }
    return result + (text.size() > longest ? "...\"" : "\"");
}

void Lexer::begin_token()
{
    const std::string& text = file_->text;
    while (position_ < text.size() && (is_space(text[position_]) || is_comment(text[position_]))) {
        if (is_comment(text[position_]))
            position_ = std::min(text.find('\n', position_), text.size());
        else
            ++position_;
    }
    token_ = position_;
}

std::string_view Lexer::word_at(std::size_t position) const
{
    const std::string_view text = file_->text;
    std::size_t end = position;
    if (end < text.size() && is_brace(text[end])) return text.substr(position, 1);
    while (end < text.size() && !ends_word(text[end])) ++end;
    return text.substr(position, end - position);
}

std::string_view Lexer::statement()
{
    begin_token();
    statement_ = token_;
    std::string_view letters = word_at(token_);
    if (!letters.empty() && !is_brace(letters[0])) {
        std::size_t length = 0;
        while (length < letters.size() && is_letter(letters[length])) ++length;
        if (length == 0) fault("a statement");
        letters = letters.substr(0, length);  // a number may follow at once
    }
    position_ += letters.size();
    return letters;
}

std::string Lexer::word(const char* expected)
{
    begin_token();
    const std::string_view text = word_at(token_);
    if (text.empty() || is_brace(text[0])) fault(expected);
    position_ += text.size();
    return std::string(text);
}

void Lexer::keyword(std::string_view text)
{
    if (!accept(text)) fault(quote(text));
}

bool Lexer::accept(std::string_view text)
{
    begin_token();
    if (word_at(token_) != text) return false;
    position_ += text.size();
    return true;
}

bool Lexer::number_follows()
{
    begin_token();
    if (token_ == file_->text.size()) return false;
    const char c = file_->text[token_];
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

double Lexer::number(const char* expected)
{
    begin_token();
    const char* const end = file_->text.data() + file_->text.size();
    const char* begin = file_->text.data() + token_;
    if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;  // from_chars knows no plus sign
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    const bool whole = stop == end || ends_word(*stop);
    if (error == std::errc::invalid_argument || !whole || !std::isfinite(value)) fault(expected);
    if (error != std::errc{} || std::abs(value) > std::numeric_limits<float>::max())
        fault("a number in the range of float");
    position_ = static_cast<std::size_t>(stop - file_->text.data());
    return value;
}

double Lexer::number_in(double low, double high, const char* expected)
{
    const double value = number(expected);
    if (!(value >= low && value <= high)) fault(expected);
    return value;
}

glm::vec2 Lexer::vec2()
{
    const double x = number(), y = number();
    return {static_cast<float>(x), static_cast<float>(y)};
}

std::int64_t Lexer::integer(std::int64_t low, std::int64_t high, const char* expected)
{
    begin_token();
    const std::string_view text = word_at(token_);
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size() || value < low || value > high) fault(expected);
    position_ += text.size();
    return value;
}

std::size_t Lexer::count(std::int64_t low, const char* expected)
{
    return static_cast<std::size_t>(integer(low, std::numeric_limits<std::int64_t>::max(), expected));
}

std::uint32_t Lexer::index_below(std::size_t size, const char* what)
{
    constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
    const std::int64_t value = integer(lowest, std::numeric_limits<std::int64_t>::max(), "an index");
    if (value < 0 || static_cast<std::uint64_t>(value) >= size)
        fault("triangle names " + std::string(what) + " " + std::to_string(value) + " of " + std::to_string(size),
              "an index in [0, " + std::to_string(size) + ")");
    return static_cast<std::uint32_t>(value);
}

FilePlace Lexer::place(std::size_t position) const
{
    const std::string_view text = file_->text;
    const auto lines_in = [&](std::size_t begin, std::size_t end) {
        return static_cast<int>(std::count(text.data() + begin, text.data() + end, '\n'));
    };
    lines_ += position >= counted_ ? lines_in(counted_, position) : -lines_in(position, counted_);
    counted_ = position;
    const std::size_t newline = text.substr(0, position).rfind('\n');
    const std::size_t line_begin = newline == std::string_view::npos ? 0 : newline + 1;
    return {file_->shown, 1 + lines_, 1 + static_cast<int>(position - line_begin)};
}

Mention Lexer::mention() const
{
    return {shown(place(token_)) + ": ", include_chain()};
}

std::string Lexer::include_chain() const
{
    std::string chain;
    for (const Lexer* lexer = includer_; lexer; lexer = lexer->includer_)
        chain += "\n  included from " + shown(lexer->place(lexer->statement_));
    return chain;
}

void Lexer::fault(const std::string& expected) const
{
    const std::string_view text = word_at(token_);
    throw SceneError(place(token_), text.empty() ? "end of file" : quote(text), expected, include_chain());
}

void Lexer::fault(const std::string& read, const std::string& expected) const
{
    throw SceneError(place(token_), read, expected, include_chain());
}

void Lexer::statement_fault(const std::string& read, const std::string& expected) const
{
    throw SceneError(place(statement_), read, expected, include_chain());
}

void Lexer::over_limit(const std::string& what, std::uint64_t limit, const char* name) const
{
    const Mention here = mention();
    throw LimitError(here.place + "more than " + std::to_string(limit) + " " + what, name, here.chain);
}

}  // namespace firstray::inline v0
