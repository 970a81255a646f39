#include <filesystem>
#include <sstream>
#include <vector>

#include "bench/firstray/command.h"
#include "tests/fuzz/targets.h"
#include "tests/support/temp_folder.h"

namespace firstray::fuzz {
namespace {

std::vector<std::string> words(Bytes input)
{
    std::vector<std::string> result;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(input.data()), input.size()));
    for (std::string line; std::getline(lines, line);) result.push_back(line.substr(0, line.find('\0')));
    return result;
}

/// A name that leads out of the folder, or a wait for rays from standard input.
bool is_outside(const std::string& word)
{
    return word.find('/') != std::string::npos || word.find("..") != std::string::npos || word == "-";
}

}  // namespace

/// A word a line. Everything runs in an empty folder, so there is no scene to be read and nothing is written: words are
/// all that can be wrong.
void command_line(Bytes input)
{
    const std::vector<std::string> arguments = words(input);
    for (const std::string& word : arguments)
        if (is_outside(word)) return;
    static const test::TempFolder folder;
    const std::filesystem::path here = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    std::ostringstream out, err;
    const int code = command::run(arguments, {out, err});
    std::filesystem::current_path(here);
    const std::string said = err.str();
    if (code < 0 || code > 5 || code == 1) throw Finding("exit code " + std::to_string(code) + ": " + said);
    if (code != 0 && !said.starts_with("firstray: ")) throw Finding("failed without a word: " + said);
    if (!std::filesystem::is_empty(folder.path())) throw Finding("something was written");
}

}  // namespace firstray::fuzz
