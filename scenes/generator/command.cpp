#include "scenes/generator/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <vector>

#include "engine/core/errors.h"
#include "scenes/generator/generate.h"

namespace firstray::scenes {
namespace {

constexpr const char* examples =
    R"(The same options give the same bytes. Textures and included files stand beside the scene's file.
Examples:
  generate robots --count 20
  generate crowd --triangles 1e7 --seed 3 --output /tmp/town/town.aff
Exit codes: 0 done, 2 usage, 4 file trouble.)";

struct Choice {
    std::string output;
    std::int64_t seed = 1;
    double amount = 0.0;
};

/// "1e6" for 1000000: what the help says of a number.
std::string shown(double value)
{
    const double power = std::log10(value);
    return value >= 1e4 && power == std::floor(power) ? fmt::format("1e{}", power) : fmt::format("{}", value);
}

std::string default_file(const SceneEntry& entry)
{
    return fmt::format("out/scenes/{0}/{0}.aff", entry.name);
}

std::string range_of(const SceneEntry& entry)
{
    return fmt::format("{}{} to {}", entry.whole ? "a whole number from " : "", shown(entry.low), shown(entry.high));
}

void add_scene(CLI::App& app, const SceneEntry& entry, Choice& choice)
{
    CLI::App& scene = *app.add_subcommand(std::string(entry.name), std::string(entry.summary));
    const auto add = [&](std::string_view name, auto& target, const char* value, const std::string& text) {
        scene.add_option(std::string(name), target, text)->option_text(value)->take_last();
    };
    choice.amount = entry.usual;
    if (!entry.option.empty())
        add(entry.option, choice.amount, "N",
            fmt::format("{}, {}; default {}", entry.meaning, range_of(entry), shown(entry.usual)));
    add("--seed", choice.seed, "N", "another number gives other details; default 1");
    add("--output", choice.output, "FILE", "the scene's file; default " + default_file(entry));
    scene.allow_extras();
    scene.footer(examples);
}

/// CLI11 is told to let strange words pass, so that they are reported here with what was expected.
void refuse_extras(const CLI::App& scene)
{
    std::vector<std::string> options;
    for (const CLI::Option* option : scene.get_options()) options.push_back(option->get_name());
    for (const std::string& word : scene.remaining())
        throw Error(Fault::usage,
                    fmt::format("'{}' of {}, expected {}", word, scene.get_name(), fmt::join(options, ", ")));
}

[[noreturn]] void refuse_scene(const CLI::App& app)
{
    std::vector<std::string_view> names;
    for (const SceneEntry& entry : scene_entries()) names.push_back(entry.name);
    const std::vector<std::string> words = app.remaining();
    throw Error(Fault::usage,
                fmt::format("{}, expected {}; see generate --help",
                            words.empty() ? "no scene" : "'" + words.front() + "'", fmt::join(names, ", ")));
}

void write(const SceneEntry& entry, const Choice& choice, std::ostream& out)
{
    const double amount = choice.amount;
    const bool fits = amount >= entry.low && amount <= entry.high && (!entry.whole || amount == std::floor(amount));
    if (!fits) throw Error(Fault::usage, fmt::format("{} is {}, expected {}", entry.option, amount, range_of(entry)));
    if (choice.seed < 0) throw Error(Fault::usage, fmt::format("--seed is {}, expected 0 or more", choice.seed));
    const Request request{choice.output.empty() ? default_file(entry) : choice.output,
                          static_cast<std::uint64_t>(choice.seed), amount};
    const std::string stem = request.file.stem().string();  // begins names that AFF files mention
    if (stem.empty() || stem.find_first_of(" \t\r\n\f{}#%") != std::string::npos)
        throw Error(Fault::usage, fmt::format("--output is '{}', expected a file whose name AFF can mention, without "
                                              "spaces, braces, # and %",
                                              choice.output));
    const std::uint64_t triangles = entry.write(request);
    out << fmt::format("{}: {} triangles", request.file.string(), triangles) << std::endl;
    if (!out) throw FileError("cannot write to standard output");
}

void dispatch(std::span<const std::string> arguments, std::ostream& out, std::ostream& err)
{
    std::map<std::string_view, Choice> choices;
    CLI::App app("generate: writes scenes for firstray, as AFF files with textures", "generate");
    app.footer(std::string("generate SCENE --help tells the options of a scene.\n") + examples);
    app.get_formatter()->column_width(24);
    app.allow_extras();
    for (const SceneEntry& entry : scene_entries()) add_scene(app, entry, choices[entry.name]);
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them reversed
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw Error(Fault::usage, error.what());
        app.exit(error, out, err);  // --help
        return;
    }
    if (app.get_subcommands().empty()) refuse_scene(app);
    const CLI::App& scene = *app.get_subcommands().front();
    refuse_extras(scene);
    for (const SceneEntry& entry : scene_entries())
        if (entry.name == scene.get_name()) write(entry, choices.at(entry.name), out);
}

int report(std::ostream& err, Fault fault, std::string message)
{
    message.erase(message.find_last_not_of(" \n") + 1);
    std::replace(message.begin(), message.end(), '\n', ' ');
    err << "generate: " << message << std::endl;
    return static_cast<int>(fault);
}

}  // namespace

int run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err)
{
    try {
        dispatch(arguments, out, err);
        return 0;
    } catch (const Error& error) {
        return report(err, error.fault(), error.what());
    } catch (const std::bad_alloc&) {
        return report(err, Fault::limit, "out of memory");
    } catch (const std::exception& error) {
        return report(err, Fault::rendering, error.what());
    }
}

}  // namespace firstray::scenes
