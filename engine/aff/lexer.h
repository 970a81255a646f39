#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "engine/aff/source.h"
#include "engine/core/errors.h"

namespace firstray::inline v0 {

/// Text for a message, at most 500 characters of it: unprintable bytes escaped, so that no name can steer a terminal.
std::string printable(std::string_view text);

/// A piece of a file for a message: in double quotes, unprintable bytes escaped, at most 80 characters of it.
std::string quote(std::string_view text);

/// Reads one file's text token by token. Tokens are runs of characters other than space; `{` and `}` are tokens of
/// their own; `#` and `%` begin a comment up to the end of the line, wherever they stand. Every reading function throws
/// SceneError, with the place, when the token is not what it should be.
class Lexer {
public:
    /// file      must outlive the lexer
    /// includer  reads the file that includes this one and outlives this lexer, or null
    explicit Lexer(const SourceFile& file, const Lexer* includer = nullptr) : file_(&file), includer_(includer) {}

    const SourceFile& file() const { return *file_; }
    const Lexer* includer() const { return includer_; }

    /// The letters that begin a statement, or "{" or "}"; empty at the end of the file.
    std::string_view statement();
    /// A name: any token but a brace.
    std::string word(const char* expected);
    void keyword(std::string_view text);  ///< exactly this word or brace
    bool accept(std::string_view text);   ///< takes it if it comes next
    bool number_follows();

    /// A finite number that float can hold.
    double number(const char* expected = "a number");
    double number_in(double low, double high, const char* expected);
    glm::dvec3 point() { return vector<double>(); }
    glm::vec3 vec3() { return vector<float>(); }
    glm::vec2 vec2();
    std::int64_t integer(std::int64_t low, std::int64_t high, const char* expected);
    /// How many things follow. They need not be there: never reserve room for more than `remaining()` allows.
    std::size_t count(std::int64_t low, const char* expected);
    /// An index into a list. Faults read "triangle names vertex 9 of 8".
    std::uint32_t index_below(std::size_t size, const char* what);

    /// Bytes not read yet; nothing takes less than 2 of them.
    std::size_t remaining() const { return file_->text.size() - position_; }

    /// Reports the last token that was read or tried, as it is written or in words of the caller.
    [[noreturn]] void fault(const std::string& expected) const;
    [[noreturn]] void fault(const std::string& read, const std::string& expected) const;
    /// Reports the statement that began last.
    [[noreturn]] void statement_fault(const std::string& read, const std::string& expected) const;
    [[noreturn]] void over_limit(const std::string& what, std::uint64_t limit, const char* name) const;
    Mention mention() const;  ///< of a file named by the last token

private:
    template <typename Real>
    glm::vec<3, Real, glm::defaultp> vector()
    {
        const double x = number(), y = number(), z = number();
        return {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)};
    }
    void begin_token();  ///< skips spaces and comments
    std::string_view word_at(std::size_t position) const;
    FilePlace place(std::size_t position) const;
    std::string include_chain() const;

    const SourceFile* file_;
    const Lexer* includer_;
    std::size_t position_ = 0;
    std::size_t token_ = 0;      // where the last token begins
    std::size_t statement_ = 0;  // where the last statement begins
    // Every include is mentioned with its line: lines are counted on from the place asked for before.
    mutable std::size_t counted_ = 0;
    mutable int lines_ = 0;  // that end before counted_
};

}  // namespace firstray::inline v0
