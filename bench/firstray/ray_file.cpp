#include "bench/firstray/ray_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

constexpr std::string_view header = "ox,oy,oz,dx,dy,dz,tmin,tmax";
constexpr std::size_t fields_per_ray = 8;

/// A line under the reader's eye; `place` tells where a piece of it stands.
struct Line {
    const std::string& file;
    int number;
    std::string_view text;

    FilePlace place(const char* at) const { return {file, number, static_cast<int>(at - text.data()) + 1}; }
};

double parse_number(const Line& line, std::string_view field, bool infinity_allowed)
{
    const std::string_view word = trim(field);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = error == std::errc{} && end == word.data() + word.size() && !word.empty();
    if (whole && (std::isfinite(value) || (infinity_allowed && value > 0.0))) return value;
    const char* at = word.empty() ? field.data() : word.data();
    throw SceneError(line.place(at), fmt::format("'{}'", word),
                     infinity_allowed ? "a number or inf" : "a finite number");
}

WorldRay parse_ray(const Line& line)
{
    const auto fields = split(line.text, ',');
    if (fields.size() != fields_per_ray) {
        const char* at =
            fields.size() < fields_per_ray ? line.text.data() + line.text.size() : fields[fields_per_ray].data();
        throw SceneError(line.place(at), fmt::format("{} fields", fields.size()), fmt::format("8 fields: {}", header));
    }
    std::array<double, fields_per_ray> number{};
    for (std::size_t i = 0; i < fields_per_ray; ++i) number[i] = parse_number(line, fields[i], i + 1 == fields_per_ray);
    return {{number[0], number[1], number[2]}, {number[3], number[4], number[5]}, number[6], number[7]};
}

}  // namespace

std::vector<WorldRay> parse_rays(std::istream& in, const std::string& name)
{
    std::vector<WorldRay> rays;
    std::string text;
    bool header_allowed = true;
    for (int number = 1; std::getline(in, text); ++number) {
        const std::string_view content = trim(text);
        if (content.empty() || content.front() == '#') continue;
        if (!header_allowed || content != header) rays.push_back(parse_ray({name, number, text}));
        header_allowed = false;
    }
    if (in.bad()) throw FileError(fmt::format("cannot read {}", name));
    return rays;
}

std::vector<WorldRay> read_rays(const std::string& file)
{
    if (file == "-") return parse_rays(std::cin, "standard input");
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw FileError(fmt::format("cannot read {}: it is a folder", file));
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) throw FileError(fmt::format("cannot read {}: {}", file, std::generic_category().message(errno)));
    return parse_rays(in, file);
}

template <typename Real>
std::string format_answer(const Scene& scene, const RayAnswer<Real>& answer)
{
    if (answer.primitive == no_primitive) return "inf,-1,-1,0,0\n";
    return fmt::format("{},{},{},{},{}\n", answer.t, scene.part(answer.primitive).group, answer.primitive, answer.u,
                       answer.v);
}

template std::string format_answer(const Scene&, const RayAnswer<float>&);
template std::string format_answer(const Scene&, const RayAnswer<double>&);

}  // namespace firstray::command
