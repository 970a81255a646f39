#include "bench/compare/results.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>

#include "engine/core/errors.h"

namespace firstray::compare {
namespace {

constexpr double most_differing_hits = 1000.0;  // per million, for "close"
constexpr double largest_close_rmse = 0.01;

/// JSON has no infinity.
Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json counts_of(const ByKind<std::uint64_t>& counts)
{
    Json json = Json::object();
    for (std::size_t kind = 0; kind < ray_kinds; ++kind) json[name_of(static_cast<RayKind>(kind))] = counts[kind];
    return json;
}

std::string status_of(const Row& row, std::size_t rounds)
{
    if (!row.fault.empty()) return "failed";
    ImageError error;
    for (const ImageError& frame : row.errors) error += frame;
    if (rounds == 0) return "unmeasured";
    if (row.hits.unlike == 0 && error.unlike == 0) return "exact";
    const double differing = row.hits.per_million(row.hits.missed + row.hits.invented + row.hits.moved);
    return differing <= most_differing_hits && error.rmse() <= largest_close_rmse ? "close" : "differs";
}

Json accuracy_of(const Row& row)
{
    ImageError error;
    for (const ImageError& frame : row.errors) error += frame;
    const HitAgreement& hits = row.hits;
    return {{"against", "list"},
            {"rays", hits.rays},
            {"hits", hits.hits},
            {"missed", hits.missed},
            {"false", hits.invented},
            {"moved", hits.moved},
            {"unlike", hits.unlike},
            {"wrong_by_kind", counts_of(hits.wrong)},
            {"missed_per_million", hits.per_million(hits.missed)},
            {"false_per_million", hits.per_million(hits.invented)},
            {"t_error_p999", quantile(hits.t_errors, 0.999)},
            {"t_error_largest", quantile(hits.t_errors, 1.0)},
            {"image", to_json(error)}};
}

/// Every round's numbers of one frame.
Json frame_of(const Row& row, std::size_t f, std::size_t rounds, int frame)
{
    Json json = {{"frame", frame},
                 {"update_ms", Json::array()},
                 {"trace_ms", Json::array()},
                 {"pose_ms", Json::array()},
                 {"lazy_build_ms", Json::array()}};
    for (std::size_t kind = 0; kind < ray_kinds; ++kind)
        json["ns_per_ray"][name_of(static_cast<RayKind>(kind))] = Json::array();
    for (std::size_t round = 0; round < rounds; ++round) {
        const FrameSample& sample = row.rounds[round][f];
        json["update_ms"].push_back(sample.stats.update_ms);
        json["trace_ms"].push_back(sample.stats.trace_ms);
        json["pose_ms"].push_back(sample.stats.pose_ms);
        json["lazy_build_ms"].push_back(sample.stats.structure.lazy_build_ms);
        for (std::size_t kind = 0; kind < ray_kinds; ++kind)
            json["ns_per_ray"][name_of(static_cast<RayKind>(kind))].push_back(sample.ns_per_ray[kind]);
    }
    if (rounds > 0) json["structure"] = firstray::to_json(row.rounds[rounds - 1][f].stats.structure);
    if (f < row.errors.size()) json["image"] = to_json(row.errors[f]);
    return json;
}

/// Adds what searching alone took: the time of the rays replayed, for all rays, shared by the threads.
void add_structure_time(Json& frame, const FrameFacts& facts, int threads)
{
    Json& times = frame["structure_ms"] = Json::array();
    for (std::size_t round = 0; round < frame["update_ms"].size(); ++round) {
        double ms = 0.0;
        for (std::size_t kind = 0; kind < ray_kinds; ++kind) {
            const Json& ns = frame["ns_per_ray"][name_of(static_cast<RayKind>(kind))];
            ms += 1e-6 * ns[round].get<double>() * static_cast<double>(facts.asked[kind]);
        }
        times.push_back(ms / threads);
    }
}

Spread spread_or_zero(const std::vector<double>& values)
{
    return values.empty() ? Spread{} : spread_of(values);
}

/// Of a kind of ray: the mean over all rays of all frames, by round.
std::vector<double> ns_by_round(const Json& strategy, const Json& frames, const char* kind)
{
    std::vector<double> values;
    for (std::size_t round = 0; round < strategy["frames"][0]["update_ms"].size(); ++round) {
        double sum = 0.0, rays = 0.0;
        for (std::size_t f = 0; f < frames.size(); ++f) {
            const double count = frames[f]["asked"][kind].get<double>();
            sum += count * strategy["frames"][f]["ns_per_ray"][kind][round].get<double>();
            rays += count;
        }
        values.push_back(rays > 0.0 ? sum / rays : 0.0);
    }
    return values;
}

Json times_of(const Json& strategy, const Json& frames)
{
    if (by_round(strategy, "update_ms").empty()) return nullptr;
    Json times = Json::object();
    for (const char* key : {"update_ms", "trace_ms", "lazy_build_ms", "structure_ms", "total_ms"})
        times[key] = to_json(spread_or_zero(by_round(strategy, key)));
    for (std::size_t kind = 0; kind < ray_kinds; ++kind) {
        const char* name = name_of(static_cast<RayKind>(kind));
        times["ns_per_ray"][name] = to_json(spread_or_zero(ns_by_round(strategy, frames, name)));
    }
    return times;
}

Json strategy_of(const Contest& contest, const Row& row, const Json& frames)
{
    const std::size_t rounds = row.fault.empty() ? contest.complete_rounds() : 0;
    Json own = Json::object();
    for (const auto& [flag, word] : row.contestant.own) own[flag] = word;
    Json json = {{"name", row.contestant.name},
                 {"strategy", row.contestant.entry->name},
                 {"summary", row.contestant.entry->summary},
                 {"peer", row.contestant.entry->peer},
                 {"own", own},
                 {"status", status_of(row, rounds)},
                 {"reason", row.fault},
                 {"accuracy", accuracy_of(row)},
                 {"times", nullptr},
                 {"frames", Json::array()}};
    if (rounds == 0) return json;
    for (std::size_t f = 0; f < contest.frames().size(); ++f) {
        json["frames"].push_back(frame_of(row, f, rounds, contest.frames()[f].frame));
        add_structure_time(json["frames"].back(), contest.frames()[f], contest.executor().threads());
    }
    json["times"] = times_of(json, frames);
    return json;
}

Json frames_of(const Contest& contest)
{
    Json frames = Json::array();
    for (const FrameFacts& facts : contest.frames())
        frames.push_back({{"frame", facts.frame},
                          {"rays", firstray::to_json(facts.rays)},
                          {"asked", counts_of(facts.asked)},
                          {"replayed", counts_of(facts.kept)}});
    return frames;
}

Json settings_of(const Contest& contest)
{
    const Plan& plan = contest.plan();
    constexpr const char* precisions[] = {"fast", "robust", "double"};
    return {{"size", {plan.render.width, plan.render.height}},
            {"depth", plan.render.depth},
            {"spp", plan.render.samples},
            {"precision", precisions[static_cast<std::size_t>(plan.options.precision)]},
            {"threads", contest.executor().threads()},
            {"repeat", plan.repeat},
            {"rounds", contest.complete_rounds()},
            {"grid_density", plan.options.grid_density},
            {"max_list", plan.options.max_list},
            {"grid_depth", plan.options.grid_depth},
            {"structure_budget", plan.options.structure_budget},
            {"seed", plan.seed},
            {"reference", contest.reference()}};
}

Json scene_of(const Scene& scene, const std::string& file)
{
    return {{"name", scene.name},
            {"file", file},
            {"primitives", scene.primitive_count()},
            {"groups", scene.groups.size()},
            {"lights", scene.lights.size()},
            {"frames", scene.frames},
            {"seconds", scene.end - scene.start}};
}

}  // namespace

Json to_json(const Spread& spread)
{
    return {{"median", spread.median}, {"least", spread.least}, {"most", spread.most}};
}

Json to_json(const ImageError& error)
{
    return {{"pixels", error.pixels},
            {"unlike", error.unlike},
            {"differing", error.differing},
            {"perceived", error.perceived},
            {"differing_share", error.differing_share()},
            {"rmse", error.rmse()},
            {"psnr", number(error.psnr())},
            {"largest", error.largest}};
}

std::string load_warning(const Json& results)
{
    constexpr double quiet = 0.25;
    const double load = results["load_before"];
    if (load <= quiet) return "";
    return fmt::format(
        "other programs were at work before this began (load average {:.1f}): times are noisy, and threads "
        "may not have had a processor each",
        load);
}

std::vector<double> by_round(const Json& strategy, const std::string& key)
{
    const Json& frames = strategy["frames"];
    if (frames.empty()) return {};
    std::vector<double> means(frames[0]["update_ms"].size(), 0.0);
    for (const Json& frame : frames)
        for (std::size_t round = 0; round < means.size(); ++round) {
            const double value = key == "total_ms"
                                     ? frame["update_ms"][round].get<double>() + frame["trace_ms"][round].get<double>()
                                     : frame[key][round].get<double>();
            means[round] += value / static_cast<double>(frames.size());
        }
    return means;
}

Json results_of(const Contest& contest, const RunFacts& facts)
{
    const std::time_t now = std::time(nullptr);
    Json results = {{"format", results_format},
                    {"version", results_version},
                    {"interrupted", facts.interrupted},
                    {"load_before", facts.load_before},
                    {"command", facts.command},
                    {"created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
                    {"machine", describe_machine()},
                    {"scene", scene_of(contest.scene(), facts.scene_file)},
                    {"settings", settings_of(contest)},
                    {"frames", frames_of(contest)},
                    {"list_ns_per_ray", contest.list_ns_per_ray()},
                    {"strategies", Json::array()}};
    for (const Row& row : contest.rows()) results["strategies"].push_back(strategy_of(contest, row, results["frames"]));
    return results;
}

Json read_results(const std::filesystem::path& file)
{
    const std::filesystem::path path = std::filesystem::is_directory(file) ? file / "results.json" : file;
    std::ifstream in(path);
    if (!in) throw FileError("cannot open " + path.string());
    Json results = Json::parse(in, nullptr, false);
    if (!results.is_object() || results.value("format", "") != results_format)
        throw FileError(path.string() + " does not hold results of firstray compare");
    if (results.value("version", 0) != results_version)
        throw FileError(
            fmt::format("{} is of version {}, expected {}", path.string(), results["version"].dump(), results_version));
    return results;
}

std::string to_csv(const Json& results)
{
    std::string csv =
        "strategy,status,frame,round,update_ms,trace_ms,lazy_build_ms,total_ms,structure_ms,primary_ns,shadow_ns,"
        "secondary_ns,bytes,checked_rays,missed_per_million,false_per_million,t_error_p999,rmse,psnr,largest,"
        "differing_share\n";
    for (const Json& strategy : results["strategies"]) {
        const Json &accuracy = strategy["accuracy"], &image = accuracy["image"];
        for (const Json& frame : strategy["frames"])
            for (std::size_t round = 0; round < frame["update_ms"].size(); ++round) {
                const double update = frame["update_ms"][round], trace = frame["trace_ms"][round];
                const Json& ns = frame["ns_per_ray"];
                csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                                   strategy["name"].get<std::string>(), strategy["status"].get<std::string>(),
                                   frame["frame"].dump(), round, update, trace, frame["lazy_build_ms"][round].dump(),
                                   update + trace, frame["structure_ms"][round].dump(), ns["primary"][round].dump(),
                                   ns["shadow"][round].dump(), ns["secondary"][round].dump(),
                                   frame["structure"]["bytes"].dump(), accuracy["rays"].dump(),
                                   accuracy["missed_per_million"].dump(), accuracy["false_per_million"].dump(),
                                   accuracy["t_error_p999"].dump(), image["rmse"].dump(),
                                   image["psnr"].is_null() ? "inf" : image["psnr"].dump(), image["largest"].dump(),
                                   image["differing_share"].dump());
            }
    }
    return csv;
}

}  // namespace firstray::compare
