#pragma once
#include <CLI/CLI.hpp>

#include <string>
#include <string_view>

#include "bench/firstray/command.h"

namespace firstray::command {

/// The manual page, as groff reads it: what --help-all says of all commands.
std::string man_page(const CLI::App& app);

/// Completion of commands, options and their words, for bash and zsh; other words are files.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);

/// Prints one of these.
/// page    man, bash or zsh
/// throws  UsageError
void print_manual(std::string_view page, Streams streams);

}  // namespace firstray::command
