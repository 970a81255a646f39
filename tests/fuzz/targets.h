#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace firstray::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Something that no input may bring about. What else a target throws is a finding too.
class Finding : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// What a file or command line from anybody meets first. Each takes any bytes.
void scene(Bytes input);         ///< the AFF reader, with includes and textures' names; poses what it has read
void tracks(Bytes input);        ///< keys of any value, at any time
void command_line(Bytes input);  ///< words of a command line that reads and writes nothing
void picture(Bytes input);       ///< the texture reader's guard, and the decoders behind it
void strategies(Bytes input);    ///< a tiny moving scene and rays: every strategy finds what `list` finds

struct Target {
    std::string_view name;
    void (*run)(Bytes);
};
inline constexpr Target targets[] = {{"scene", scene},
                                     {"tracks", tracks},
                                     {"command_line", command_line},
                                     {"picture", picture},
                                     {"strategies", strategies}};

/// Takes an input apart from its beginning; zeros when it is used up.
class Taking {
public:
    explicit Taking(Bytes input) : left_(input) {}
    bool is_empty() const { return left_.empty(); }
    std::uint8_t byte()
    {
        if (left_.empty()) return 0;
        const std::uint8_t first = left_.front();
        left_ = left_.subspan(1);
        return first;
    }
    unsigned below(unsigned n) { return byte() % n; }
    Bytes rest() const { return left_; }

private:
    Bytes left_;
};

}  // namespace firstray::fuzz
