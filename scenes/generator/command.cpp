#include "scenes/generator/command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>

#include "engine/core/errors.h"
#include "scenes/generator/generate.h"

namespace firstray::scenes {
namespace {

constexpr const char* examples =
    R"(Files go to out/scenes/SCENE unless --output names the scene's file; others stand beside it. The same
options give the same bytes. Exit codes: 0 done, 2 usage, 4 file trouble.
Examples:
  generate robots --count 20
  generate crowd --triangles 10000000 --seed 3 --output /tmp/town/town.aff)";

struct Choice {
    std::string output;
    std::uint64_t seed = 1;
    std::map<std::string_view, double> amounts;  ///< by scene
};

/// "1e6" for 1000000: what the help says of a number.
std::string shown(double value)
{
    const double power = std::log10(value);
    return value >= 1e4 && power == std::floor(power) ? fmt::format("1e{}", power) : fmt::format("{}", value);
}

void add_scene(CLI::App& app, const SceneEntry& entry, Choice& choice)
{
    CLI::App& scene = *app.add_subcommand(std::string(entry.name), std::string(entry.summary));
    double& amount = choice.amounts[entry.name] = entry.usual;
    if (!entry.option.empty()) {
        const std::string text = fmt::format("{}, {} to {}; default {}", entry.meaning, shown(entry.low),
                                             shown(entry.high), shown(entry.usual));
        const auto whole = [&entry](const std::string& word) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(word, value);
            return number && entry.whole && value != std::floor(value) ? std::string("not a whole number")
                                                                       : std::string();
        };
        scene.add_option(std::string(entry.option), amount, text)
            ->option_text("N")
            ->take_last()
            ->check(CLI::Range(entry.low, entry.high))
            ->check(whole);
    }
    scene.add_option("--seed", choice.seed, "another number gives other details; default 1")
        ->option_text("N")
        ->take_last();
    scene
        .add_option(
            "--output", choice.output,
            "the scene's file; default out/scenes/" + std::string(entry.name) + "/" + std::string(entry.name) + ".aff")
        ->option_text("FILE")
        ->take_last();
}

std::string one_line(std::string text)
{
    text.erase(text.find_last_not_of(" \n") + 1);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

int report(std::ostream& err, Fault fault, const std::string& message)
{
    err << "generate: " << one_line(message) << std::endl;
    return static_cast<int>(fault);
}

void write(const SceneEntry& entry, const Choice& choice, std::ostream& out)
{
    Request request{choice.output, choice.seed, choice.amounts.at(entry.name)};
    if (choice.output.empty()) request.file = fmt::format("out/scenes/{0}/{0}.aff", entry.name);
    const std::uint64_t triangles = entry.write(request);
    out << fmt::format("{}: {} triangles", request.file.string(), triangles) << std::endl;
    if (!out) throw FileError("cannot write to standard output");
}

}  // namespace

int run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err)
{
    Choice choice;
    CLI::App app("generate: writes scenes for firstray, as AFF files with textures", "generate");
    app.footer(examples);
    app.get_formatter()->column_width(24);
    app.require_subcommand(1);
    for (const SceneEntry& entry : scene_entries()) add_scene(app, entry, choice);
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them reversed
        const std::string name = app.get_subcommands().front()->get_name();
        for (const SceneEntry& entry : scene_entries())
            if (entry.name == name) write(entry, choice, out);
        return 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return report(err, Fault::usage, error.what());
        return app.exit(error, out, err);  // --help
    } catch (const Error& error) {
        return report(err, error.fault(), error.what());
    } catch (const std::bad_alloc&) {
        return report(err, Fault::limit, "out of memory");
    }
}

}  // namespace firstray::scenes
