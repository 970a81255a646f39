#include "bench/micro/flags.h"

#include <charconv>
#include <cstdlib>
#include <iostream>

#include "engine/core/errors.h"
#include "engine/core/simd.h"

namespace firstray {

void take_flags(int& argc, char** argv, const char* usage,
                const std::function<bool(std::string_view flag, std::string_view value)>& apply)
{
    int kept = 1;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--help") std::cout << usage << "\n";  // Google Benchmark adds its own and leaves
        const std::size_t equals = argument.find('=');
        const std::string_view value = equals == argument.npos ? "" : argument.substr(equals + 1);
        if (!apply(argument.substr(0, equals), value)) argv[kept++] = argv[i];
    }
    argc = kept;
}

[[noreturn]] void refuse(const std::string& message)
{
    throw Error(Fault::usage, message);
}

const StrategyEntry* entry_of(std::string_view name)
{
    const StrategyEntry* entry = find_strategy(name);
    if (!entry || !entry->make) refuse("no strategy of single precision is named " + std::string(name));
    return entry;
}

void hold_to(std::string_view name)
{
    std::string known;
    for (const std::string& set : instruction_sets()) {
        if (set == name) return use_instruction_set(name);
        known += " " + set;
    }
    refuse("--isa takes one of" + known);
}

int whole_number(std::string_view flag, std::string_view text)
{
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1)
        refuse(std::string(flag) + " takes a whole number >= 1");
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> pieces;
    for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
        pieces.push_back(text.substr(0, end));
    pieces.push_back(text);
    return pieces;
}

Contestant contestant_of(std::string_view text)
{
    Contestant contestant = parse_contestant(text);
    entry_of(contestant.entry->name);
    return contestant;
}

std::vector<NamedScene> bart_scenes(std::string_view program)
{
    constexpr std::pair<const char*, const char*> scenes[] = {
        {"robots", "robots/Robot.aff"}, {"kitchen", "kitchen/kitchen.aff"}, {"museum", "museum/museum5.aff"}};
    const char* variable = std::getenv("FIRSTRAY_BART_DIR");
    const std::filesystem::path folder = variable && *variable ? variable : FIRSTRAY_BART_DIR;
    std::vector<NamedScene> found;
    for (const auto& [name, file] : scenes)
        if (std::filesystem::exists(folder / file))
            found.push_back({name, folder / file});
        else
            std::cerr << program << ": skipped " << name << ": no file " << (folder / file).string() << "\n";
    return found;
}

}  // namespace firstray
