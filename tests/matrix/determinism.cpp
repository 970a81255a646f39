// T15: the same picture, bit for bit, from any number of threads, instruction set, repetition and compiler.
#include <fmt/format.h>

#include <set>

#include "engine/core/simd.h"
#include "tests/matrix/meshes.h"
#include "tests/matrix/processes.h"
#include "tests/matrix/shoot.h"
#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

namespace firstray::matrix {
namespace {

constexpr const char* precisions[] = {"robust", "fast", "double"};

std::string options_of(const std::string& scene, const std::string& strategy, const std::string& precision, int threads,
                       const test::TempFolder& folder)
{
    return fmt::format(
        "render {} --frames 0-40:20 --size 120x90 --strategy {} --precision {} --threads {} --progress never "
        "--stats {} --output {}",
        scene, strategy, precision, threads, (folder.path() / "stats.json").string(),
        (folder.path() / "x.####.png").string());
}

/// The pictures' hashes of a run, in one text; what went wrong if it did.
std::string hashes_in(const test::TempFolder& folder)
{
    std::string all;
    const nlohmann::json stats = test::read_json(folder.path() / "stats.json");
    for (const auto& frame : stats["frames"]) all += frame["image_hash"].dump() + " ";
    return all;
}

std::string our_hashes(const std::string& scene, const std::string& strategy, const std::string& precision, int threads)
{
    const test::TempFolder folder;
    const test::Outcome outcome = test::call_line(options_of(scene, strategy, precision, threads, folder));
    return outcome.code == 0 ? hashes_in(folder) : outcome.err;
}

std::string others_hashes(const std::filesystem::path& program, const std::string& scene, const std::string& strategy,
                          const std::string& precision)
{
    const test::TempFolder folder;
    const Ended ended = run_program("'" + program.string() + "' " + options_of(scene, strategy, precision, 2, folder));
    return ended.code == 0 ? hashes_in(folder) : fmt::format("ended with {}", ended.code);
}

/// A frame rendered by all our strategies, threads and instruction sets.
void thread_rows(Matrix& matrix, const std::vector<std::string>& scenes)
{
    std::uint64_t runs = 0, kinds = 0;
    std::size_t different = 0;
    for (const std::string& scene : scenes)
        for (const char* precision : precisions) {
            std::set<std::string> hashes;
            for (const StrategyEntry& entry : strategies())
                for (const int threads : {1, 2, 5, 16, 64}) {
                    if (entry.peer || (matrix.part() < 1.0 && threads != 1 && threads != 64)) continue;
                    hashes.insert(our_hashes(scene, std::string(entry.name), precision, threads));
                    ++runs;
                }
            for (const std::string& set : instruction_sets()) {
                use_instruction_set(set);
                hashes.insert(our_hashes(scene, "lazy", precision, 2));
                ++runs;
            }
            use_instruction_set("");
            different += hashes.size() - 1;
            ++kinds;
        }
    matrix.add(
        {.id = "T15",
         .tried = fmt::format("three frames of {} scenes, each precision: each strategy of ours on 1, 2, 5, 16, 64 "
                              "threads, each instruction set; hashes of pictures beyond one per precision",
                              scenes.size()),
         .n = 3 * runs,
         .result = fmt::format("{}", different),
         .target = "0",
         .met = different == 0 && kinds > 0,
         .known_miss = {}});
}

void compiler_rows(Matrix& matrix, const std::vector<std::string>& scenes)
{
    const auto other = matrix.programs().parent_path() / "build-clang/firstray", own = matrix.programs() / "firstray";
    const bool is_there = std::filesystem::exists(other) && std::filesystem::exists(own);
    std::uint64_t runs = 0, different = 0;
    for (const std::string& scene : scenes)
        for (const char* precision : precisions)
            for (const StrategyEntry& entry : strategies()) {
                if (entry.peer || !is_there) continue;
                const std::string strategy(entry.name);
                different +=
                    others_hashes(own, scene, strategy, precision) != others_hashes(other, scene, strategy, precision);
                ++runs;
            }
    matrix.add({.id = "T15",
                .tried = "the same frames by the builds of g++ and clang++: pictures whose hashes differ",
                .n = 3 * runs,
                .result = is_there ? fmt::format("{}", 3 * different) : "no build-clang/firstray",
                .target = "0",
                .met = is_there && different == 0,
                .known_miss = is_there ? "" : "not tried"});
}

/// How many of Embree's hits depend on how it is asked: by instruction set, and packets or single rays.
void embree_rows(Matrix& matrix)
{
    const StrategyEntry* const embree = find_strategy("embree");
    if (!embree) return;
    const Scene scene = test::random_scene(8, 1200);
    const Pose now = pose(scene, 0.0);
    const std::uint64_t batches = matrix.part_of(500, 20);
    const auto make = [&](std::size_t batch) {
        return test::rays_from(2 * batch, scene, test::Random(batch).in_cube(30.0), 1024);
    };
    std::vector<std::unique_ptr<Strategy<float>>> ways;
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        ways.push_back(embree->make(scene, {}));
        ways.push_back(embree->make(scene, {.own = {{"embree-rays", "single"}}}));
    }
    use_instruction_set("");
    for (const auto& way : ways) way->update(now);
    const std::uint64_t different = shoot<std::uint64_t>(
        matrix.executor(), *ways[0], batches, make,
        [&](const RayTile<float>& first, const std::vector<test::TestRay>& rays) {
            std::vector<std::uint8_t> differs(rays.size());
            for (const auto& way : ways) {
                const auto tile = test::make_tile<float>(rays, 0);
                way->closest(*tile);
                for (std::size_t i = 0; i < rays.size(); ++i)
                    differs[i] |= tile->primitive[i] != first.primitive[i] || tile->t_max[i] != first.t_max[i];
            }
            return static_cast<std::uint64_t>(std::count(differs.begin(), differs.end(), 1));
        });
    matrix.add(
        {.id = "T15",
         .tried = "embree, robust: rays whose t or id depends on the instruction set, or on packets or single rays",
         .n = batches * 1024,
         .result = fmt::format("{} ({:.0f} per million)", different,
                               1e6 * static_cast<double>(different) / static_cast<double>(batches * 1024)),
         .target = "reported",
         .known_miss = {}});
}

}  // namespace

void determinism_rows(Matrix& matrix)
{
    const std::vector<std::string> scenes = {"scenes/everything.aff", "scenes/tracks.aff"};
    thread_rows(matrix, matrix.part() < 1.0 ? std::vector<std::string>{scenes[0]} : scenes);
    compiler_rows(matrix, scenes);
    embree_rows(matrix);
}

}  // namespace firstray::matrix
