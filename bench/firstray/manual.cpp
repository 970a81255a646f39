#include "bench/firstray/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/firstray/options.h"
#include "bench/firstray/words.h"

namespace firstray::command {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app)
{
    return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string replaced(std::string text, std::string_view what, std::string_view by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

/// Text as groff prints it as it is.
std::string roff(std::string text)
{
    text = replaced(replaced(std::move(text), "\\", "\\e"), "-", "\\-");
    if (text.starts_with('.') || text.starts_with('\'')) text.insert(0, "\\&");
    return replaced(replaced(std::move(text), "\n.", "\n\\&."), "\n'", "\n\\&'");
}

/// Text between single quotes.
std::string quoted(std::string text)
{
    return "'" + replaced(std::move(text), "'", "'\\''") + "'";
}

std::string value_of(const CLI::Option& option)
{
    return option.get_expected_max() == 0 ? "" : option.get_option_text();
}

/// "-h, --help".
std::string flags_of(const CLI::Option& option)
{
    return replaced(option.get_name(false, true), ",", ", ");
}

std::string option_section(const CLI::App& command)
{
    std::string text;
    for (const CLI::Option* option : command.get_options()) {
        if (!option->nonpositional()) continue;
        text += fmt::format(".TP\n.B {}\n", roff(flags_of(*option)));
        if (const std::string value = value_of(*option); !value.empty()) {
            text.pop_back();
            text += fmt::format(" \\fI{}\\fP\n", roff(value));
        }
        text += roff(option->get_description()) + "\n";
    }
    return text;
}

/// The footer; its examples are indented lines.
std::string footer_section(const CLI::App& app)
{
    std::string text = ".PP\n";
    bool in_examples = false;
    const std::string footer = app.get_footer();
    for (const std::string_view line : split(footer, '\n')) {
        if (line == "Examples:") {
            text += ".PP\nExamples:\n.PP\n.nf\n.RS\n";
            in_examples = true;
        } else if (line.empty()) {
            text += ".PP\n";
        } else {
            text += roff(std::string(trim(line))) + (in_examples ? "\n" : "\n.br\n");
        }
    }
    return text + (in_examples ? ".RE\n.fi\n" : "");
}

/// Names that begin with dashes, of all options.
std::string option_words(const CLI::App& command)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return fmt::format("{}", fmt::join(names, " "));
}

/// "--strategy[text]:NAME:(list grid)".
std::string zsh_argument(const CLI::Option& option)
{
    const std::string about = replaced(replaced(option.get_description(), "[", "\\["), "]", "\\]");
    std::string text = fmt::format("--{}[{}]", option.get_single_name(), about);
    const std::string value = value_of(option);
    if (value.empty()) return text;
    const std::vector<std::string> words = words_of(option);
    return text + fmt::format(":{}:{}", value, words.empty() ? "_files" : fmt::format("({})", fmt::join(words, " ")));
}

}  // namespace

std::string man_page(const CLI::App& app)
{
    std::string text = fmt::format(".TH FIRSTRAY 1 \"\" \"firstray {}\" \"User Commands\"\n", FIRSTRAY_VERSION);
    text += ".SH NAME\nfirstray \\- ray tracing of animated scenes\n.SH SYNOPSIS\n";
    for (const CLI::App* command : commands_of(app))
        text += fmt::format(".B firstray {}\n\\fISCENE\\fP [\\fIOPTIONS\\fP]\n.br\n", command->get_name());
    text += ".SH OPTIONS\n" + option_section(app) + footer_section(app);
    for (const CLI::App* command : commands_of(app)) {
        text += fmt::format(".SH FIRSTRAY {}\n{}.\n", command->get_name(), roff(command->get_description()));
        text += option_section(*command) + footer_section(*command);
    }
    return text;
}

std::string bash_completion(const CLI::App& app)
{
    std::vector<std::string> names;
    std::string values, options;
    std::map<std::string, std::string> words_by_option;
    for (const CLI::App* command : commands_of(app)) {
        names.push_back(command->get_name());
        options += fmt::format("        {}) words={} ;;\n", command->get_name(), quoted(option_words(*command)));
        for (const CLI::Option* option : command->get_options())
            if (const std::vector<std::string> words = words_of(*option); !words.empty())
                words_by_option["--" + option->get_single_name()] = fmt::format("{}", fmt::join(words, " "));
    }
    for (const auto& [option, words] : words_by_option)
        values += fmt::format("        {}) words={} ;;\n", option, quoted(words));
    return fmt::format(R"(# bash completion for firstray; made by: firstray manual bash
_firstray() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} words=
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        words='{} {}'
    else
        case $previous in
{}        esac
    fi
    if [[ -z $words && $current == -* ]]; then
        case ${{COMP_WORDS[1]}} in
{}        esac
    fi
    if [[ -n $words ]]; then
        while IFS= read -r; do COMPREPLY+=("$REPLY"); done < <(compgen -W "$words" -- "$current")
    fi
}}
complete -o default -F _firstray firstray
)",
                       fmt::join(names, " "), option_words(app), values, options);
}

std::string zsh_completion(const CLI::App& app)
{
    std::string commands, cases;
    for (const CLI::App* command : commands_of(app)) {
        commands += fmt::format("        {}\n", quoted(command->get_name() + ":" + command->get_description()));
        cases += fmt::format("        {})\n            _arguments \\\n", command->get_name());
        for (const CLI::Option* option : command->get_options())
            if (option->nonpositional()) cases += fmt::format("                {} \\\n", quoted(zsh_argument(*option)));
        cases += "                '*:scene:_files'\n            ;;\n";
    }
    return fmt::format(R"(#compdef firstray
# zsh completion for firstray; made by: firstray manual zsh
_firstray() {{
    local -a commands
    commands=(
{}    )
    if ((CURRENT == 2)); then
        _describe command commands
        return
    fi
    local command=$words[2]
    shift words
    ((CURRENT -= 1))
    case $command in
{}    esac
}}
_firstray "$@"
)",
                       commands, cases);
}

void print_manual(std::string_view page, Streams streams)
{
    constexpr std::string_view pages[] = {"man", "bash", "zsh"};
    constexpr std::string (*makers[])(const CLI::App&) = {man_page, bash_completion, zsh_completion};
    const auto make = makers[find_word("manual", page, pages)];
    Jobs jobs;
    streams.out << make(*make_command_line(jobs, true));
}

}  // namespace firstray::command
