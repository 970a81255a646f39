#include "bench/compare/compare.h"

#include "bench/compare/sweep.h"
#include "bench/compare/verdict.h"
#include "engine/core/pending_file.h"

namespace firstray::compare {

Json compare(const Scene& scene, std::span<const Texture> textures, const Plan& plan, RunFacts facts,
             const Watch& watch)
{
    Contest contest(scene, textures, plan, watch);
    Json sweep, frameless;
    try {
        contest.check();
        contest.measure();
        sweep = measure_sweep(contest);
        if (!plan.frameless.empty()) frameless = measure_frameless(contest);
    } catch (const Interrupted&) {
        facts.interrupted = true;
    }
    Json results = results_of(contest, facts);
    results["verdict"] = verdict_of(results);
    if (!sweep.is_null()) {
        results["sweep"] = sweep;
        results["prediction"] = prediction_of(results);
    }
    if (!frameless.is_null()) results["frameless"] = frameless;
    return results;
}

void write_report(const std::filesystem::path& folder, const Json& results)
{
    write_whole_file(folder / "results.json", results.dump(1) + "\n");
    write_whole_file(folder / "results.csv", to_csv(results));
}

}  // namespace firstray::compare
