#include "bench/compare/compare.h"

#include "bench/compare/verdict.h"
#include "engine/core/pending_file.h"

namespace firstray::compare {

Json compare(const Scene& scene, std::span<const Texture> textures, const Plan& plan, RunFacts facts,
             const Watch& watch)
{
    Contest contest(scene, textures, plan, watch);
    try {
        contest.check();
        contest.measure();
    } catch (const Interrupted&) {
        facts.interrupted = true;
    }
    Json results = results_of(contest, facts);
    results["verdict"] = verdict_of(results);
    return results;
}

void write_report(const std::filesystem::path& folder, const Json& results)
{
    write_whole_file(folder / "results.json", results.dump(1) + "\n");
    write_whole_file(folder / "results.csv", to_csv(results));
}

}  // namespace firstray::compare
