#pragma once
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "bench/firstray/command.h"
#include "bench/firstray/words.h"

namespace firstray::test {

/// A unit square in the plane z = 0 that moves along x, from 0 to 4 within 5 frames, in front of a still triangle.
inline constexpr std::string_view moving_square = R"(
v from 0 0 10 at 0 0 0 up 0 1 0 angle 60 hither 0.1 resolution 16 12
l 0 10 10
a 0 4 5
fm 0 0 0 1 0.5 0.25 0 0 0 0 0 0
p 3  -5 -5 -1  5 -5 -1  0 5 -1
x mover {
p 4  -0.5 -0.5 0  0.5 -0.5 0  0.5 0.5 0  -0.5 0.5 0
}
k mover {
transl 7  -1 -1 0 0 0 0 0  0 0 0 0 0 0 0  1 1 0 0 0 0 0  2 2 0 0 0 0 0  3 3 0 0 0 0 0  4 4 0 0 0 0 0  5 5 0 0 0 0 0
}
)";

/// How the command ended and what it said.
struct Outcome {
    int code = 0;
    std::string out, err;
};

inline Outcome call(const std::vector<std::string>& arguments)
{
    std::ostringstream out, err;
    const int code = command::run(arguments, {out, err});
    return {code, out.str(), err.str()};
}

/// Arguments parted by single spaces.
inline Outcome call_line(const std::string& line)
{
    std::vector<std::string> words;
    for (const std::string_view word : command::split(line, ' ')) words.emplace_back(word);
    return call(words);
}

inline nlohmann::json read_json(const std::filesystem::path& file)
{
    std::ifstream in(file);
    return nlohmann::json::parse(in);
}

}  // namespace firstray::test
