#include "bench/firstray/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <limits>
#include <new>
#include <optional>

#include "bench/firstray/counted_new.h"
#include "bench/firstray/jobs.h"
#include "bench/firstray/search.h"
#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

constexpr const char* render_examples = R"(Examples:
  firstray render Robot.aff --frames 0-799:10 --size 400x300 --stats out/robots.json
  firstray render kitchen.aff --frames 410 --aov distance,primitive --output out/kitchen.####.exr)";
constexpr const char* info_examples = R"(Examples:
  firstray info Robot.aff --structure --frame 456
  firstray info museum5.aff --json | jq .triangles)";
constexpr const char* compare_examples = R"(Examples:
  firstray compare kitchen.aff --strategies grid,obb,obb+obb-top=list,lazy --report out/kitchen
  firstray compare before/results.json after/results.json)";
constexpr const char* trace_examples =
    R"(A ray is a line ox,oy,oz,dx,dy,dz,tmin,tmax in world coordinates; tmax may be inf. Line k of the
answer is t,group,primitive,u,v of ray k, or inf,-1,-1,0,0 where it meets nothing.
Examples:
  firstray trace Robot.aff --frame 208 --rays rays.csv --output hits.csv
  echo 0,5,20,0,0,-1,0,inf | firstray trace Robot.aff --frame 0 --rays - --precision double)";
constexpr const char* main_footer = R"(firstray COMMAND --help tells the options of a command. All take --memory-limit SIZE, e.g. 2G, and where they read a
scene --limit NAME=N,... to allow more, or less, than the limit that a message names.
Exit codes: 0 done, 1 failed while rendering, 2 usage, 3 bad scene, 4 file trouble, 5 over a limit.)";

/// Of an option given twice the last one counts: scripts put the options of their caller behind their own.
/// value  stands for the option's value in --help
template <typename T>
CLI::Option* add(CLI::App& app, const std::string& name, T& target, const char* value, const std::string& text)
{
    return app.add_option(name, target, text)->option_text(value)->take_last();
}

void add_int(CLI::App& app, const char* name, int& target, int low, int high, const std::string& text)
{
    add(app, name, target, "N", text)->check(CLI::Range(low, high));
}

CLI::Option* add_scene(CLI::App& app, SceneChoice& scene)
{
    app.add_flag("--allow-outside", scene.allow_outside, "let includes and textures lie outside the scene's folder");
    add(app, "--limit", scene.limits, "NAME=N", "allow more, or less, than the limit that a message names")
        ->group("");  // one screen is enough: firstray --help tells of it
    return add(app, "SCENE", scene.file, " ", "scene file (.aff)")->required();
}

/// What all strategies understand.
void add_structure(CLI::App& app, SearchChoice& search)
{
    add(app, "--precision", search.precision, "NAME", "fast, robust or double; default robust");
    add_int(app, "--threads", search.threads, 0, 1024, "threads that work at once; default 0, all there are");
    add(app, "--grid-density", search.grid_density, "X", "cells per primitive; default 0, the strategy's own")
        ->check(CLI::Range(0.0, 1000.0));
    add_int(app, "--max-list", search.max_list, 0, 1 << 20,
            "primitives in a voxel before it is split; default 0, the strategy's own");
    add_int(app, "--grid-depth", search.grid_depth, 1, 8,
            "levels of grids; default " + std::to_string(search.grid_depth));
    add(app, "--structure-budget", search.structure_budget, "BYTES",
        "most that lazy or adaptive may build while rays fly; default 0, no limit");
}

void add_search(CLI::App& app, SearchChoice& search)
{
    add(app, "--strategy", search.strategy, "NAME", "structure: " + strategy_names() + "; default grid");
    add_structure(app, search);
    for (const OwnChoice& own : own_choices()) {
        const std::string flag = "--" + std::string(own.flag);
        if (app.get_option_no_throw(flag)) continue;  // info has it already, and asks with it too
        CLI::Option* option =
            add(app, flag, search.own[std::string(own.flag)], "NAME",
                list_of(own.words) + ": " + std::string(own.summary) + "; default " + std::string(own.words[0]));
        if (own.flag == "costs" || own.flag == "embree-rays") option->group("");  // one screen is enough: README tells of them
    }
}

void add_render(CLI::App& app, RenderJob& job)
{
    add_scene(app, job.scene);
    add(app, "--frames", job.frames, "LIST", "e.g. 12 or 0-799:10 or 0,5,10-20; default 0");
    add(app, "--size", job.size, "WxH", "picture's size; default: the scene's");
    add_int(app, "--depth", job.depth, 0, 64, "reflections and refractions in a row; default 4");
    add_int(app, "--spp", job.samples, 1, 4096, "samples per pixel; default 1");
    add(app, "--frameless", job.frameless, "1/X", "share of the pixels that a frame traces; default 1, all");
    add(app, "--seed", job.seed, "N", "which pixels --frameless takes; default 0")->check(CLI::NonNegativeNumber);
    add_search(app, job.search);
    add(app, "--aov", job.aovs, "LIST", "layers of an EXR: distance,primitive,group,cells,tests,time,age");
    app.add_flag("--structure", job.structure,
                 "draw boxes and filled cells over the pictures; those of few pixels fade out");
    add(app, "--output", job.output, "NAME", "a run of # is the frame; default SCENE.####.png here, .exr with --aov");
    app.add_flag("--resume", job.resume, "keep frames whose files record this scene and these settings");
    add(app, "--stats", job.stats, "FILE", "write times, rays and structure of every frame as JSON");
    app.add_flag("--table", job.table, "print a line of times per frame to standard output");
    add(app, "--progress", job.progress, "WHEN", "auto (not beside --table), always or never; default auto");
    app.footer(render_examples);
}

void add_compare(CLI::App& app, CompareJob& job)
{
    add_scene(app, job.scene);
    add(app, "RESULTS", job.other, " ", "with results.json for SCENE: tell what changed, exit 1 where it is worse");
    add(app, "--strategies", job.strategies, "LIST",
        "e.g. grid,obb,obb+obb-top=list,embree; default all, list only where it is quick");
    add(app, "--frames", job.frames, "LIST", "as for render; default 8, spread over the animation");
    add(app, "--size", job.size, "WxH", "pictures' size; default: the scene's");
    add_int(app, "--depth", job.depth, 0, 64, "reflections and refractions in a row; default 4");
    add_int(app, "--spp", job.samples, 1, 4096, "samples per pixel; default 1");
    add_int(app, "--repeat", job.repeat, 1, 1000, "timed rounds through all frames; default 5");
    add_int(app, "--check-rays", job.check_rays, 0, 1 << 30,
            "rays a frame checked against list; default 0, for about a third of a second");
    add_structure(app, job.search);
    add(app, "--pictures", job.pictures, "LIST", "frames that the report shows; default the one of most rays");
    add(app, "--frameless", job.frameless, "LIST", "also try frameless rendering, e.g. 1,1/2,1/4,1/8,1/16,1/32,1/64");
    app.add_flag("--trade", job.trade, "also try what buys speed with accuracy, for the fastest of our own");
    add(app, "--seed", job.seed, "N", "which pixels --frameless takes; default 0")->check(CLI::NonNegativeNumber);
    add(app, "--report", job.report, "DIR", "folder for the report; default out/SCENE-report");
    app.add_flag("--json", job.json, "print the results as JSON, not as a table");
    add(app, "--progress", job.progress, "WHEN", "auto, always or never; default auto");
    app.footer(compare_examples);
}

void add_info(CLI::App& app, InfoJob& job)
{
    add_scene(app, job.scene)->required(false);
    app.add_flag("--json", job.json, "print JSON");
    app.add_flag("--costs", job.costs, "tell what adaptive counts with; --costs=NAME=NS,... sets some, of render and trace too");
    CLI::Option* structure = app.add_flag("--structure", job.structure, "also tell of the boxes and grids of a frame");
    const std::size_t others = app.get_options().size();
    add_int(app, "--frame", job.frame, 0, std::numeric_limits<int>::max(), "the scene's frame, from 0; default 0");
    add_search(app, job.search);
    const std::vector<CLI::Option*> options = app.get_options({});
    for (std::size_t i = others; i < options.size(); ++i) options[i]->needs(structure)->group("With --structure");
    app.footer(info_examples);
}

void add_trace(CLI::App& app, TraceJob& job)
{
    add_scene(app, job.scene);
    add_int(app, "--frame", job.frame, 0, std::numeric_limits<int>::max(), "the scene's frame, from 0; required");
    add(app, "--rays", job.rays, "FILE", "rays, - is standard input; required");
    add(app, "--output", job.output, "FILE", "answers; default: standard output");
    add_search(app, job.search);
    app.footer(trace_examples);
}

std::vector<std::string> names_of(const std::vector<const CLI::Option*>& options)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : options)
        if (option->nonpositional()) names.push_back(option->get_name());
    return names;
}

std::vector<std::string_view> views(const std::vector<std::string>& words)
{
    return {words.begin(), words.end()};
}

/// CLI11 is told to let strange words pass, so that they are reported here with the likely intent.
void refuse_extras(const CLI::App& app)
{
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) return;
    const std::string word = extras.front().substr(0, extras.front().find('='));
    if (!word.starts_with('-')) throw UsageError("'" + word + "' was not expected");
    throw UsageError("unknown option " + word + suggestion(word, views(names_of(app.get_options()))));
}

void require(const CLI::App& app, const char* name)
{
    if (app.count(name) == 0)
        throw UsageError(app.get_name() + " needs " + name + ", see firstray " + app.get_name() + " --help");
}

[[noreturn]] void refuse_command(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) throw UsageError("no command, expected " + list_of(views(names)) + "; see firstray --help");
    throw UsageError("'" + extras.front() + "', expected " + list_of(views(names)) +
                     suggestion(extras.front(), views(names)));
}

/// CLI11's messages may span lines.
std::string one_line(std::string text)
{
    text.erase(text.find_last_not_of(" \n") + 1);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// What --memory-limit asks for, from when it is read to the end of the run.
class Memory {
public:
    void set(const std::string& size)
    {
        if (size.empty()) return;
        size_ = size;
        limit_.emplace(parse_amount("--memory-limit", size));
    }
    std::string shortage() const
    {
        return limit_ && MemoryLimit::was_hit() ? "more memory is needed than --memory-limit " + size_ + " allows"
                                           : "out of memory";
    }

private:
    std::string size_;
    std::optional<MemoryLimit> limit_;
};

void dispatch(std::span<const std::string> arguments, Streams streams, Memory& limits)
{
    RenderJob render;
    CompareJob compare;
    InfoJob info;
    TraceJob trace;
    CLI::App app("firstray: ray tracing of animated scenes", "firstray");
    app.set_version_flag("--version", std::string("firstray ") + FIRSTRAY_VERSION, "print the version");
    app.footer(main_footer);
    app.get_formatter()->column_width(28);
    app.allow_extras();
    add_render(*app.add_subcommand("render", "render frames to picture files"), render);
    add_compare(*app.add_subcommand("compare", "measure strategies side by side and check that they agree"), compare);
    add_info(*app.add_subcommand("info", "tell what a scene consists of"), info);
    add_trace(*app.add_subcommand("trace", "find what given rays hit"), trace);

    std::string memory;
    for (CLI::App* command : app.get_subcommands({}))
        add(*command, "--memory-limit", memory, "SIZE", "most memory to allocate")->group("");

    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them reversed
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw UsageError(one_line(error.what()));
        app.exit(error, streams.out, streams.err);  // --help and --version
        return;
    }
    if (app.get_subcommands().empty()) refuse_command(app);
    const CLI::App& command = *app.get_subcommands().front();
    refuse_extras(app);
    refuse_extras(command);
    limits.set(memory);
    if (command.get_name() == "render") return render_scene(render, streams);
    if (command.get_name() == "compare") {
        compare.command_line = fmt::format("firstray {}", fmt::join(arguments, " "));
        return compare_strategies(compare, streams);
    }
    if (command.get_name() == "info") {
        if (info.costs.empty() || info.structure) require(command, "SCENE");
        if (info.replaces_costs()) info.search.own["costs"] = info.costs;
        return print_info(info, streams);
    }
    require(command, "--frame");
    require(command, "--rays");
    trace_rays(trace, streams);
}

int report(Streams streams, Fault fault, std::string_view message)
{
    streams.err << "firstray: " << message << std::endl;
    return static_cast<int>(fault);
}

}  // namespace

int run(std::span<const std::string> arguments, Streams streams)
{
    Memory memory;
    try {
        dispatch(arguments, streams, memory);
        if (!streams.out.flush()) throw FileError("cannot write to standard output");
        return 0;
    } catch (const Error& error) {
        return report(streams, error.fault(), error.what());
    } catch (const std::bad_alloc&) {
        return report(streams, Fault::limit, memory.shortage());
    } catch (const std::exception& error) {
        return report(streams, Fault::rendering, one_line(error.what()));
    } catch (...) {
        return report(streams, Fault::rendering, "an unknown failure");
    }
}

}  // namespace firstray::command
