// Measures the matrix of promises (README, "Accuracy and limits") and prints it as a table.
//   firstray_matrix [--part X] [--only T1,T5] [--rows FILE] [--markdown FILE]
// --part X   of the full numbers of rays and scenes, 1 if left out
// --rows     also lists rows that something else measured: lines of "id|tried|n|result|target|yes or no"
// returns    1 when a target is missed that is not known to be, 2 for arguments that it does not know

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bench/measure/stopwatch.h"
#include "tests/matrix/matrix.h"

using namespace firstray::matrix;

namespace {

struct RowGroup {
    std::string ids;
    void (*measure)(Matrix&);
};

const RowGroup groups[] = {
    {"T1", &watertight_rows},   {"T1", &distance_rows}, {"T2", &agreement_rows},
    {"T4", &special_ray_rows},  {"T5", &scaling_rows},  {"T6", &garbage_rows},
    {"T7", &duplicate_rows},    {"T8", &drift_rows},    {"T10", &spawned_rows},
    {"T11", &extreme_rows},     {"T13", &mutant_rows},  {"T15", &determinism_rows},
    {"T18,T20", &compare_rows}, {"T19", &cost_rows},    {"T3,T9,T12,T14,T16,T17", &tested_rows},
};

struct Arguments {
    double part = 1.0;
    std::vector<std::string> only;
    std::string rows, markdown;
};

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

bool has_id(const RowGroup& group, const std::string& id)
{
    const std::vector<std::string> ids = split(group.ids, ',');
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

Arguments read_arguments(int argc, char** argv)
{
    Arguments arguments;
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
        if (name == "--part")
            arguments.part = std::strtod(value.c_str(), nullptr);
        else if (name == "--only")
            arguments.only = split(value, ',');
        else if (name == "--rows")
            arguments.rows = value;
        else if (name == "--markdown")
            arguments.markdown = value;
        else
            throw std::invalid_argument("unknown argument " + name);
    }
    for (const std::string& id : arguments.only)
        if (std::none_of(std::begin(groups), std::end(groups), [&](const RowGroup& g) { return has_id(g, id); }))
            throw std::invalid_argument("--only: '" + id + "', expected ids of rows, such as T1,T14");
    if (!(arguments.part > 0.0 && arguments.part <= 1.0)) throw std::invalid_argument("--part must be in (0, 1]");
    return arguments;
}

bool is_wanted(const RowGroup& group, const std::vector<std::string>& only)
{
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const std::string& id) { return has_id(group, id); });
}

void add_rows_of(const std::string& file, Matrix& matrix)
{
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const std::vector<std::string> part = split(line, '|');
        if (part.size() != 6) throw std::invalid_argument(file + ": not a row: " + line);
        matrix.add(
            {part[0], part[1], std::strtoull(part[2].c_str(), nullptr, 10), part[3], part[4], part[5] == "yes", {}});
    }
}

int run(int argc, char** argv)
{
    const Arguments arguments = read_arguments(argc, argv);
    const firstray::Executor executor;
    Matrix matrix(arguments.part, executor, std::filesystem::canonical("/proc/self/exe").parent_path().parent_path());
    for (const RowGroup& group : groups) {
        if (!is_wanted(group, arguments.only)) continue;
        const firstray::Stopwatch watch;
        group.measure(matrix);
        std::fprintf(stderr, "%s: %.0f s\n", group.ids.c_str(), 1e-3 * watch.ms());
    }
    if (!arguments.rows.empty()) add_rows_of(arguments.rows, matrix);
    const std::string table = table_of(matrix.rows());
    std::fputs(("\n" + table).c_str(), stdout);
    if (!arguments.markdown.empty() && !(std::ofstream(arguments.markdown) << table).flush())
        throw std::runtime_error("cannot write " + arguments.markdown);
    return std::all_of(matrix.rows().begin(), matrix.rows().end(),
                       [](const Row& row) { return row.met || !row.known_miss.empty(); })
               ? 0
               : 1;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const std::invalid_argument& fault) {
        std::fprintf(stderr, "firstray_matrix: %s\n", fault.what());
        return 2;
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "firstray_matrix: %s\n", fault.what());
        return 1;
    }
}
