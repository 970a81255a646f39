#include <array>
#include <filesystem>

#include "engine/aff/reader.h"
#include "engine/core/errors.h"
#include "engine/scene/pose.h"
#include "tests/fuzz/targets.h"
#include "tests/support/temp_folder.h"

namespace firstray::fuzz {
namespace {

/// Far below the defaults, so that an input is done in milliseconds.
ReadLimits small_limits()
{
    ReadLimits limits;
    limits.include_depth = 4;
    limits.transform_depth = 64;
    limits.files = 4;
    limits.file_bytes = limits.expanded_bytes = 1 << 18;
    limits.primitives = limits.vertices = limits.keys = 20'000;
    limits.transforms = 1000;
    limits.lights = limits.textures = 100;
    return limits;
}

/// Puts the parts between lines "@@@" into files: the main file and those it may include.
void write_parts(const test::TempFolder& folder, std::string_view text)
{
    constexpr std::array names = {"main.aff", "a.aff", "b.aff", "t.ppm"};
    constexpr std::string_view parting = "@@@\n";
    for (const char* name : names) {
        const std::size_t end = text.find(parting);
        folder.write(name, text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + parting.size());
    }
}

/// What goes to a terminal must not steer it.
void check_message(const std::string& message)
{
    for (const char c : message)
        if (c != '\n' && (c < ' ' || c > '~')) throw Finding("a message with unprintable bytes: " + message);
    if (message.size() > 5000) throw Finding("an endless message");
}

}  // namespace

void scene(Bytes input)
{
    static const test::TempFolder folder;
    write_parts(folder, {reinterpret_cast<const char*>(input.data()), input.size()});
    try {
        const Scene read = read_aff(folder.path() / "main.aff", small_limits());
        for (const double time : {read.start, 0.5 * (read.start + read.end), read.end}) bounds(pose(read, time));
    } catch (const Error& error) {
        check_message(error.what());
        if (error.fault() == Fault::rendering || error.fault() == Fault::usage)
            throw Finding(std::string("blamed on the wrong one: ") + error.what());
    }
}

}  // namespace firstray::fuzz
