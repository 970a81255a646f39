#include "bench/firstray/options.h"

#include <algorithm>
#include <limits>

#include "bench/firstray/search.h"
#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

constexpr const char* render_examples = R"(Examples:
  firstray render Robot.aff --frames 0-799:10 --size 400x300 --stats out/robots.json
  firstray render kitchen.aff --frames 410 --aov distance,primitive --output out/kitchen.####.exr)";
constexpr const char* info_examples = R"(Examples:
  firstray info Robot.aff --structure --frame 456
  firstray info museum5.aff --json | jq .recommended)";
constexpr const char* compare_examples = R"(Examples:
  firstray compare kitchen.aff --strategies grid,obb,obb+obb-top=list,lazy --report out/kitchen
  firstray compare before/results.json after/results.json)";
constexpr const char* trace_examples =
    R"(A ray is a line ox,oy,oz,dx,dy,dz,tmin,tmax in world coordinates; tmax may be inf. Line k of the
answer is t,group,primitive,u,v of ray k, or inf,-1,-1,0,0 where it meets nothing.

Examples:
  firstray trace Robot.aff --frame 208 --rays rays.csv --output hits.csv
  echo 0,5,20,0,0,-1,0,inf | firstray trace Robot.aff --frame 0 --rays - --precision double)";
constexpr const char* main_footer =
    R"(firstray COMMAND --help tells the options of a command, --help-all the seldom used ones too.
Exit codes: 0 done, 1 failed while rendering, 2 usage, 3 bad scene, 4 file trouble, 5 over a limit.

Examples:
  firstray info scenes/everything.aff
  firstray render scenes/everything.aff --frames 36 --spp 4 --output everything.png)";

/// Help that fits a screen: lines are broken at 100 columns.
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() { column_width(text_column); }
    std::string make_option(const CLI::Option* option, bool is_positional) const override
    {
        return wrapped(CLI::Formatter::make_option(option, is_positional));
    }

private:
    static constexpr std::size_t text_column = 28, columns = 100;

    static std::string wrapped(std::string text)
    {
        std::size_t line = 0;
        while (text.size() - line > columns) {
            const std::size_t blank = text.rfind(' ', line + columns - 1);
            if (blank == std::string::npos || blank <= line + text_column) break;
            text.replace(blank, 1, "\n" + std::string(text_column, ' '));
            line = blank + 1;
        }
        return text;
    }
};

/// Of an option given twice the last one counts: scripts put the options of their caller behind their own.
/// value  stands for the option's value in --help
template <typename T>
CLI::Option* add(CLI::App& app, const std::string& name, T& target, const char* value, const std::string& text)
{
    return app.add_option(name, target, text)->option_text(value)->take_last();
}

CLI::Option* add_int(CLI::App& app, const char* name, int& target, int low, int high, const std::string& text)
{
    return add(app, name, target, "N", text)->check(CLI::Range(low, high));
}

void add_scene(CLI::App& app, SceneChoice& scene)
{
    app.add_flag("--allow-outside", scene.allow_outside, "let includes and textures lie outside the scene's folder")
        ->group(seldom);
    add(app, "--limit", scene.limits, "NAME=N,...", "allow more, or less, than a limit that a message names")
        ->group(seldom);
    add(app, "SCENE", scene.file, " ", "scene file (.aff)");
}

/// What all strategies understand.
void add_structure(CLI::App& app, SearchChoice& search)
{
    add(app, "--precision", search.precision, "NAME", "fast, robust or double; default robust");
    add_int(app, "--threads", search.threads, 0, 1024, "threads that work at once; default 0, all there are");
    add(app, "--grid-density", search.grid_density, "X", "cells per primitive; default 0, the strategy's own")
        ->check(CLI::Range(0.0, 1000.0))
        ->group(seldom);
    add_int(app, "--max-list", search.max_list, 0, 1 << 20,
            "primitives in a voxel before it is split; default 0, the strategy's own")
        ->group(seldom);
    add_int(app, "--grid-depth", search.grid_depth, 1, 8,
            "levels of grids; default " + std::to_string(search.grid_depth))
        ->group(seldom);
    add(app, "--structure-budget", search.structure_budget, "BYTES",
        "most that lazy or adaptive may build while rays fly; default 0, no limit")
        ->group(seldom);
}

void add_search(CLI::App& app, SearchChoice& search)
{
    add(app, "--strategy", search.strategy, "NAME", "structure: " + strategy_names() + "; default grid");
    add_structure(app, search);
    for (const OwnChoice& own : own_choices()) {
        const std::string flag = "--" + std::string(own.flag);
        if (app.get_option_no_throw(flag)) continue;  // info has it already, and asks with it too
        add(app, flag, search.own[std::string(own.flag)], "NAME",
            list_of(own.words) + ": " + std::string(own.summary) + "; default " + std::string(own.words[0]))
            ->group(seldom);
    }
}

template <class Job>
void add_rays(CLI::App& app, Job& job)
{
    add_int(app, "--depth", job.depth, 0, 64, "reflections and refractions in a row; default 4");
    add_int(app, "--spp", job.samples, 1, 4096, "samples per pixel; default 1");
}

template <class Job>
void add_seed(CLI::App& app, Job& job)
{
    add(app, "--seed", job.seed, "N", "which pixels --frameless takes; default 0")
        ->check(CLI::NonNegativeNumber)
        ->group(seldom);
}

void add_render(CLI::App& app, RenderJob& job)
{
    add_scene(app, job.scene);
    add(app, "--frames", job.frames, "LIST", "e.g. 12 or 0-799:10 or 0,5,10-20; default 0");
    add(app, "--size", job.size, "WxH", "picture's size; default: the scene's");
    add_rays(app, job);
    add(app, "--frameless", job.frameless, "1/X", "share of the pixels that a frame traces; default 1, all");
    add_seed(app, job);
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
    add_rays(app, job);
    add_int(app, "--repeat", job.repeat, 1, 1000, "timed rounds through all frames; default 5");
    add_int(app, "--check-rays", job.check_rays, 0, 1 << 30,
            "rays a frame checked against list; default 0, for about a third of a second");
    add_structure(app, job.search);
    add(app, "--pictures", job.pictures, "LIST", "frames that the report shows; default the one of most rays");
    add(app, "--frameless", job.frameless, "LIST", "also try frameless rendering, e.g. 1,1/2,1/4,1/8,1/16,1/32,1/64");
    app.add_flag("--trade", job.trade, "also try what buys speed with accuracy, for the fastest of our own");
    add_seed(app, job);
    add(app, "--report", job.report, "DIR", "folder for the report; default out/SCENE-report");
    app.add_flag("--json", job.json, "print the results as JSON, not as a table");
    add(app, "--progress", job.progress, "WHEN", "auto, always or never; default auto");
    app.footer(compare_examples);
}

void add_info(CLI::App& app, InfoJob& job)
{
    add_scene(app, job.scene);
    app.add_flag("--json", job.json, "print JSON");
    app.add_flag("--costs", job.costs,
                 "tell what adaptive counts with; --costs=NAME=NS,... sets some, of render and trace too");
    CLI::Option* structure = app.add_flag("--structure", job.structure, "also tell of the boxes and grids of a frame");
    const std::size_t others = app.get_options().size();
    add_int(app, "--frame", job.frame, 0, std::numeric_limits<int>::max(), "the scene's frame, from 0; default 0");
    add_search(app, job.search);
    const std::vector<CLI::Option*> options = app.get_options({});
    for (std::size_t i = others; i < options.size(); ++i) {
        options[i]->needs(structure);
        if (options[i]->get_group() != seldom) options[i]->group("With --structure");
    }
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

/// Prints what is made from the command line: for whoever packages the program, so that help does not show it.
void add_manual(CLI::App& app, std::string& page)
{
    add(app, "PAGE", page, " ", "man, bash or zsh");
}

void hide_seldom(CLI::App& app)
{
    for (CLI::Option* option : app.get_options({}))
        if (option->get_group() == seldom) option->group("");
}

}  // namespace

std::unique_ptr<CLI::App> make_command_line(Jobs& jobs, bool all)
{
    auto app = std::make_unique<CLI::App>("firstray: ray tracing of animated scenes", "firstray");
    app->set_version_flag("--version", std::string("firstray ") + FIRSTRAY_VERSION, "print the version");
    app->set_help_flag("-h,--help", "print this");
    app->footer(main_footer);
    app->formatter(std::make_shared<HelpFormatter>());
    app->allow_extras();
    add_render(*app->add_subcommand("render", "render frames to picture files"), jobs.render);
    add_compare(*app->add_subcommand("compare", "measure strategies side by side and check that they agree"),
                jobs.compare);
    add_info(*app->add_subcommand("info", "tell what is in a scene, what moves, and which strategy suits it"),
             jobs.info);
    add_trace(*app->add_subcommand("trace", "find what given rays hit"), jobs.trace);
    for (CLI::App* command : app->get_subcommands({})) {
        add(*command, "--memory-limit", jobs.memory, "SIZE", "most memory to allocate, e.g. 2G; default no limit")
            ->group(seldom);
        command->set_help_all_flag("--help-all", "print this and the options that are seldom used");
        if (!all) hide_seldom(*command);
    }
    add_manual(*app->add_subcommand("manual", "print the manual page or a shell's completion")->group(""), jobs.manual);
    return app;
}

std::vector<std::string> words_of(const CLI::Option& option)
{
    const auto strings = [](const auto& views) { return std::vector<std::string>(views.begin(), views.end()); };
    const std::string name = option.get_single_name();
    if (name == "strategy") {
        std::vector<std::string> names;
        for (const StrategyEntry& entry : strategies()) names.emplace_back(entry.name);
        return names;
    }
    if (name == "precision") return {"fast", "robust", "double"};
    if (name == "progress") return {"auto", "always", "never"};
    for (const OwnChoice& own : own_choices())
        if (own.flag == name && !own.check) return strings(own.words);
    return {};
}

}  // namespace firstray::command
