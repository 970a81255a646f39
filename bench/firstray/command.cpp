#include "bench/firstray/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <new>
#include <optional>

#include "bench/firstray/counted_new.h"
#include "bench/firstray/manual.h"
#include "bench/firstray/options.h"
#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

std::vector<std::string> names_of(const std::vector<const CLI::Option*>& options)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : options)
        if (option->nonpositional())
            names.push_back("--" + option->get_single_name());  // get_name of hidden ones is empty
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

/// Whoever types a command alone is told what to type next.
void require_scene(const CLI::App& app)
{
    if (app.count("SCENE") > 0) return;
    const std::string name = app.get_name();
    throw UsageError(name + " needs a scene, e.g.: firstray " + name + " scenes/everything.aff" +
                     (name == "trace" ? " --frame 0 --rays rays.csv" : "") + "; options: firstray " + name + " --help");
}

[[noreturn]] void refuse_command(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        if (!command->get_group().empty()) names.push_back(command->get_name());
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

/// What a run that had not enough memory says.
/// limit  --memory-limit as it was given
std::string shortage(const std::string& limit)
{
    return !limit.empty() && MemoryLimit::was_hit() ? "more memory is needed than --memory-limit " + limit + " allows"
                                                    : "out of memory";
}

/// memory  becomes --memory-limit as it was given, which holds until this ends: messages may take what they need
void dispatch(std::span<const std::string> arguments, Streams streams, std::string& memory)
{
    Jobs jobs;
    // CLI11 does not even name, in its messages, what help hides.
    const bool all = std::none_of(arguments.begin(), arguments.end(),
                                  [](const std::string& word) { return word == "--help" || word == "-h"; });
    const std::unique_ptr<CLI::App> line = make_command_line(jobs, all);
    CLI::App& app = *line;
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
    std::optional<MemoryLimit> limit;
    memory = jobs.memory;
    if (!memory.empty()) limit.emplace(parse_amount("--memory-limit", memory));
    if (command.get_name() == "manual") return print_manual(jobs.manual, streams);
    if (command.get_name() != "info") require_scene(command);
    if (command.get_name() == "render") return render_scene(jobs.render, streams);
    if (command.get_name() == "compare") {
        jobs.compare.command_line = fmt::format("firstray {}", fmt::join(arguments, " "));
        return compare_strategies(jobs.compare, streams);
    }
    if (command.get_name() == "info") {
        InfoJob& info = jobs.info;
        if (info.costs.empty() || info.structure) require_scene(command);
        if (info.replaces_costs()) info.search.own["costs"] = info.costs;
        return print_info(info, streams);
    }
    require(command, "--frame");
    require(command, "--rays");
    trace_rays(jobs.trace, streams);
}

int report(Streams streams, Fault fault, std::string_view message)
{
    streams.err << "firstray: " << message << std::endl;
    return static_cast<int>(fault);
}

}  // namespace

int run(std::span<const std::string> arguments, Streams streams)
{
    std::string memory;
    try {
        dispatch(arguments, streams, memory);
        if (!streams.out.flush()) throw FileError("cannot write to standard output");
        return 0;
    } catch (const Error& error) {
        return report(streams, error.fault(), error.what());
    } catch (const std::bad_alloc&) {
        return report(streams, Fault::limit, shortage(memory));
    } catch (const std::exception& error) {
        return report(streams, Fault::rendering, one_line(error.what()));
    } catch (...) {
        return report(streams, Fault::rendering, "an unknown failure");
    }
}

}  // namespace firstray::command
