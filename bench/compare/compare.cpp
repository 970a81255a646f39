#include "bench/compare/compare.h"

#include <cstdlib>
#include <utility>

#include "bench/compare/report.h"
#include "bench/compare/sweep.h"
#include "bench/compare/trade.h"
#include "bench/compare/verdict.h"
#include "engine/core/pending_file.h"

namespace firstray::compare {
namespace {

/// What the whole comparison comes to; see Watch.
double work_of(const Contest& contest)
{
    const Plan& plan = contest.plan();
    return contest.work() + drawing_work_of(contest) + sweep_work(contest) + frameless_work_of(contest) +
           (plan.trade ? trade_work(plan) : 0.0);
}

/// The fastest of our own; where none was timed, grid.
Contestant contestant_to_trade(const Json& results, const Plan& plan)
{
    const Json own = verdict_of(results)["own"];
    for (const Contestant& contestant : plan.contestants)
        if (!own.is_null() && contestant.name == own["fastest"] && contestant.entry->name != "list") return contestant;
    return parse_contestant("grid");
}

}  // namespace

Report compare(const Scene& scene, std::span<const Texture> textures, const Plan& plan, RunFacts facts,
               const Watch& watch)
{
    if (getloadavg(&facts.load_before, 1) != 1) facts.load_before = 0.0;
    Contest contest(scene, textures, plan, watch);
    if (watch.expect) watch.expect(work_of(contest));
    Json sweep, frameless, trade;
    std::vector<FramePictures> pictures;
    try {
        contest.check();
        contest.measure();
        pictures = draw_pictures(contest);
        measure_sweep(contest, sweep);
        if (!plan.frameless.empty()) measure_frameless(contest, frameless);
        if (plan.trade) measure_trade(contest, contestant_to_trade(results_of(contest, facts), plan), trade);
    } catch (const Interrupted&) {
        facts.interrupted = true;
    }
    Json results = results_of(contest, facts);
    results["verdict"] = verdict_of(results);
    if (!sweep.is_null()) {
        results["sweep"] = sweep;
        results["prediction"] = prediction_of(results);
    }
    if (!frameless.empty()) results["frameless"] = frameless;
    if (!trade.is_null()) results["trade"] = trade;
    return {std::move(results), std::move(pictures)};
}

void write_report(const std::filesystem::path& folder, const Report& report)
{
    write_whole_file(folder / "results.json", report.results.dump(1) + "\n");
    write_whole_file(folder / "results.csv", to_csv(report.results));
    write_whole_file(folder / "index.html", report_html(report.results, report.pictures));
}

}  // namespace firstray::compare
