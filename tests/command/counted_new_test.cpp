#include "bench/firstray/counted_new.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <new>

#include "bench/firstray/jobs.h"
#include "tests/support/call_command.h"
#include "tests/support/failing_new.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::test;

namespace {

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Name and bytes of all files, hidden ones included.
std::map<std::string, std::string> contents(const std::filesystem::path& folder)
{
    std::map<std::string, std::string> files;
    if (!std::filesystem::exists(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files[entry.path().filename().string()] = bytes_of(entry.path());
    return files;
}

/// Two frames of a moving square and a textured triangle, small.
class SmallRender {
public:
    explicit SmallRender(const std::string& strategy) : strategy_(strategy)
    {
        folder_.write("pixel.ppm", "P6 1 1 255\nabc");
        folder_.write("scene.aff", std::string(moving_square) + "tt pixel.ppm 0 0 -2 0 0  9 0 -2 1 0  0 9 -2 0 1\n");
    }

    std::vector<std::string> arguments() const
    {
        return {"render",     (folder_.path() / "scene.aff").string(),
                "--frames",   "0-1",
                "--size",     "8x6",
                "--strategy", strategy_,
                "--threads",  "1",
                "--progress", "never",
                "--output",   (out() / "#.png").string()};
    }
    /// The same, past the reading of words: CLI11 allocates where it has promised not to throw.
    command::RenderJob job() const
    {
        command::RenderJob job;
        job.scene.file = (folder_.path() / "scene.aff").string();
        job.search.strategy = strategy_;
        job.search.threads = 1;
        job.frames = "0-1";
        job.size = "8x6";
        job.progress = "never";
        job.output = (out() / "#.png").string();
        return job;
    }
    std::filesystem::path out() const { return folder_.path() / "out"; }

    /// What an undisturbed run writes.
    std::map<std::string, std::string> expected() const
    {
        const Outcome outcome = call(arguments());
        REQUIRE(outcome.code == 0);
        const auto files = contents(out());
        REQUIRE(files.size() == 2);
        std::filesystem::remove_all(out());
        return files;
    }

    /// Whether all that is there is what an undisturbed run writes, under its final name.
    bool has_whole_frames_only(const std::map<std::string, std::string>& whole) const
    {
        for (const auto& [name, bytes] : contents(out()))
            if (const auto known = whole.find(name); known == whole.end() || known->second != bytes) return false;
        return true;
    }

private:
    TempFolder folder_;
    std::string strategy_;
};

struct Tally {
    int failures = 0, same = 0, clean = 0, spared = 0;
};

/// Runs with the k-th allocation failing. Returns whether there was a k-th.
bool run_with_failure(const SmallRender& render, std::int64_t k, const std::map<std::string, std::string>& whole,
                      Tally& tally)
{
    CAPTURE(k);
    const command::RenderJob job = render.job();
    std::ostringstream out, err;
    std::string fault;
    bool is_whole = true, has_failed = false;
    {
        const FailingNew failing(k, Allocations::of_all_threads);
        try {
            command::render_scene(job, {out, err});
        } catch (const std::bad_alloc&) {
            is_whole = false;  // which the command makes exit code 5 of
        } catch (const std::exception& error) {
            fault = error.what();
        }
        has_failed = failing.has_failed();
        tally.spared += failing.was_spared();
    }
    CHECK(fault == "");
    CHECK(render.has_whole_frames_only(whole));
    if (is_whole) CHECK(contents(render.out()).size() == 2);
    std::filesystem::remove_all(render.out());
    ++(is_whole ? tally.same : tally.clean);
    tally.failures += has_failed;
    return has_failed;
}

}  // namespace

TEST_CASE("whichever allocation of a run fails, it ends cleanly or in the same pictures")
{
    for (const std::string strategy : {"list", "grid", "obb", "lazy"}) {
        CAPTURE(strategy);
        const SmallRender render(strategy);
        const auto whole = render.expected();
        Tally tally;
        for (std::int64_t k = 0; run_with_failure(render, k, whole, tally); ++k) {
        }
        CHECK(tally.failures > 300);
        MESSAGE(strategy << ": " << tally.failures << " allocations failed, one a run; " << tally.clean
                         << " runs ended with exit code 5, " << tally.same << " with the same pictures, "
                         << tally.spared << " of them because it was OpenImageIO's");
    }
}

TEST_CASE("a run that may not have the memory it needs ends cleanly or in the same pictures")
{
    for (const std::string strategy : {"list", "grid", "obb", "lazy"}) {
        CAPTURE(strategy);
        const SmallRender render(strategy);
        const auto whole = render.expected();
        std::vector<std::string> arguments = render.arguments();
        arguments.insert(arguments.end(), {"--memory-limit", "1T"});
        REQUIRE(call(arguments).code == 0);
        const std::uint64_t peak = command::MemoryLimit::peak();
        REQUIRE(peak > 10'000);
        int clean = 0;
        for (std::uint64_t percent = 1; percent <= 110; percent += percent < 95 ? 6 : 1) {
            CAPTURE(percent);
            arguments.back() = std::to_string(std::max<std::uint64_t>(peak * percent / 100, 1));
            std::filesystem::remove_all(render.out());
            const Outcome outcome = call(arguments);
            CAPTURE(outcome.err);
            CHECK((outcome.code == 0 || outcome.code == 5));
            CHECK(render.has_whole_frames_only(whole));
            if (outcome.code == 0) CHECK(contents(render.out()).size() == 2);
            if (outcome.code == 5)
                CHECK(outcome.err.find("more memory is needed than --memory-limit") != std::string::npos);
            CHECK(command::MemoryLimit::peak() <= peak * percent / 100);
            if (percent == 110) CHECK(outcome.code == 0);
            clean += outcome.code == 5;
        }
        CHECK(clean > 10);
    }
}

TEST_CASE("a memory limit refuses what is beyond it and counts what comes back")
{
    const command::MemoryLimit limit(1 << 20);
    for (int i = 0; i < 100; ++i) {
        const std::vector<char> large(900'000);
        CHECK_THROWS_AS(std::vector<char>(100'000), std::bad_alloc);  // of the last, only small ones get anything
    }
    CHECK(command::MemoryLimit::was_hit());
    CHECK(command::MemoryLimit::peak() >= 900'000);
    CHECK(command::MemoryLimit::peak() <= 1 << 20);
    CHECK_THROWS_AS(std::vector<char>(std::size_t{1} << 40), std::bad_alloc);
}
