#include "bench/compare/regression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/compare/text.h"
#include "bench/compare/verdict.h"
#include "engine/core/errors.h"

namespace firstray::compare {
namespace {

void check_same(const Json& before, const Json& after, const char* what)
{
    if (before == after) return;
    throw Error(Fault::usage, fmt::format("the runs cannot be compared: {} is {} in one and {} in the other", what,
                                          before.dump(), after.dump()));
}

void check_comparable(const Json& before, const Json& after)
{
    for (const char* key : {"name", "primitives"}) check_same(before["scene"][key], after["scene"][key], key);
    for (const char* key :
         {"size", "depth", "spp", "precision", "threads", "grid_density", "max_list", "grid_depth", "structure_budget"})
        check_same(before["settings"][key], after["settings"][key], key);
    const auto frames = [](const Json& results) {
        Json numbers = Json::array();
        for (const Json& frame : results["frames"]) numbers.push_back(frame["frame"]);
        return numbers;
    };
    check_same(frames(before), frames(after), "frames");
}

class Changes {
public:
    void add(const std::string& strategy, const std::string& what, const Json& before, const Json& after, bool is_worse)
    {
        json_["changes"].push_back({{"strategy", strategy},
                                    {"what", what},
                                    {"before", before},
                                    {"after", after},
                                    {"is_regression", is_worse}});
        if (is_worse) ++regressions_;
    }
    void note(const std::string& text) { json_["notes"].push_back(text); }
    Json finish()
    {
        json_["regressions"] = regressions_;
        return json_;
    }

private:
    Json json_ = {{"notes", Json::array()}, {"changes", Json::array()}};
    int regressions_ = 0;
};

/// Whether `b` is more than `a` outside the noise.
bool is_more(const Json& a, const Json& b)
{
    const double from = a["median"], to = b["median"];
    const bool apart = b["least"].get<double>() > a["most"].get<double>();
    return apart && to > from * (1.0 + least_change) && to - from > least_change_ms;
}

void compare_times(const Json& a, const Json& b, Changes& changes)
{
    for (const char* key : {"update_ms", "trace_ms", "structure_ms", "total_ms"}) {
        const Json &before = a["times"][key], &after = b["times"][key];
        const bool slower = is_more(before, after);
        if (slower || is_more(after, before)) changes.add(a["name"], key, before["median"], after["median"], slower);
    }
}

double most_bytes(const Json& strategy)
{
    double bytes = 0.0;
    for (const Json& frame : strategy["frames"]) bytes = std::max(bytes, frame["structure"]["bytes"].get<double>());
    return bytes;
}

void compare_memory(const Json& a, const Json& b, Changes& changes)
{
    const double before = most_bytes(a), after = most_bytes(b);
    if (std::abs(after - before) > least_change * before)
        changes.add(a["name"], "bytes", before, after, after > before);
}

/// Accuracy does not depend on the clock: what is worse is worse.
void compare_accuracy(const Json& a, const Json& b, Changes& changes)
{
    const std::string name = a["name"];
    const auto compare = [&](const char* what, double before, double after) {
        if (before != after) changes.add(name, what, before, after, after > before);
    };
    for (const char* key : {"missed_per_million", "false_per_million"})
        compare(key, a["accuracy"][key], b["accuracy"][key]);
    compare("rmse", a["accuracy"]["image"]["rmse"], b["accuracy"]["image"]["rmse"]);
}

int rank_of(const std::string& status)
{
    constexpr std::array<const char*, 4> order = {"exact", "close", "differs", "failed"};
    return static_cast<int>(std::find(order.begin(), order.end(), status) - order.begin());
}

void compare_rows(const Json& a, const Json& b, Changes& changes)
{
    const std::string before = a["status"], after = b["status"];
    if (before != after) changes.add(a["name"], "status", before, after, rank_of(after) > rank_of(before));
    if (a["times"].is_null() || b["times"].is_null()) return;
    compare_times(a, b, changes);
    compare_memory(a, b, changes);
    compare_accuracy(a, b, changes);
}

/// What speaks for the machine rather than the code as the cause of a change.
void note_machine(const Json& before, const Json& after, Changes& changes)
{
    if (before["machine"]["cpu"] != after["machine"]["cpu"]) changes.note("the machines are not the same");
    for (const Json* run : {&before, &after})
        if (const std::string load = load_warning(*run); !load.empty())
            changes.note(fmt::format("the {} run: {}", run == &before ? "first" : "second", load));
    std::vector<std::string> peers;
    for (const Json& a : before["strategies"]) {
        const Json* b = find_row(after, a["name"]);
        if (!a["peer"].get<bool>() || !b || a["times"].is_null() || (*b)["times"].is_null()) continue;
        const Json &from = a["times"]["total_ms"], &to = (*b)["times"]["total_ms"];
        if (is_more(from, to) || is_more(to, from)) peers.push_back(a["name"]);
    }
    if (!peers.empty())
        changes.note(fmt::format("{}, which {} not ours, changed too: perhaps it was the machine", listed(peers),
                                 peers.size() == 1 ? "is" : "are"));
}

}  // namespace

Json compare_runs(const Json& before, const Json& after)
{
    check_comparable(before, after);
    Changes changes;
    note_machine(before, after, changes);
    for (const Json* run : {&before, &after})
        if ((*run)["interrupted"].get<bool>()) changes.note("one of the runs was interrupted");
    for (const Json& a : before["strategies"]) {
        if (const Json* b = find_row(after, a["name"]))
            compare_rows(a, *b, changes);
        else
            changes.note(fmt::format("{} is not in the second run", a["name"].get<std::string>()));
    }
    return changes.finish();
}

std::string change_table(const Json& changes)
{
    std::string text;
    for (const Json& note : changes["notes"]) text += "note: " + note.get<std::string>() + "\n";
    const auto shown = [](const Json& value) {
        return value.is_string() ? value.get<std::string>() : short_number(value.get<double>());
    };
    for (const Json& change : changes["changes"]) {
        std::string line = fmt::format("{} {} {}: {} -> {}", change["is_regression"].get<bool>() ? "worse " : "better",
                                       change["strategy"].get<std::string>(), change["what"].get<std::string>(),
                                       shown(change["before"]), shown(change["after"]));
        if (change["before"].is_number() && change["before"].get<double>() > 0.0)
            line += fmt::format(" ({:+.0f} %)",
                                100.0 * (change["after"].get<double>() / change["before"].get<double>() - 1.0));
        text += line + "\n";
    }
    if (changes["changes"].empty()) text += "nothing changed beyond the noise\n";
    const int regressions = changes["regressions"];
    return text + fmt::format("{} regression{}\n", regressions, regressions == 1 ? "" : "s");
}

}  // namespace firstray::compare
