#include "bench/firstray/resume.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <map>
#include <thread>

#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::test;

namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::ifstream in(entry.path(), std::ios::binary);
        files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return files;
}

/// Renders a moving square's five frames to a folder of its own.
struct Run {
    TempFolder folder;
    std::vector<std::string> arguments;

    explicit Run(const std::string& frames = "0-4", const std::string& ending = "png")
    {
        fs::create_directory(out());
        arguments = {"render",     folder.write("square.aff", moving_square).string(),
                     "--frames",   frames,
                     "--progress", "never",
                     "--output",   (out() / ("#." + ending)).string()};
    }
    fs::path out() const { return folder.path() / "out"; }
    Outcome call_with(std::vector<std::string> more) const
    {
        more.insert(more.begin(), arguments.begin(), arguments.end());
        return call(more);
    }
};

/// The frames of an undisturbed run.
std::map<std::string, std::string> undisturbed(const std::string& frames = "0-4", const std::string& ending = "png")
{
    const Run run(frames, ending);
    REQUIRE(run.call_with({}).code == 0);
    return contents(run.out());
}

/// Raises a signal at the n-th line that is written.
class RaisingBuffer : public std::stringbuf {
public:
    RaisingBuffer(int signal, int line) : signal_(signal), line_(line) {}

private:
    int sync() override
    {
        if (--line_ == 0) std::raise(signal_);
        return std::stringbuf::sync();
    }
    int signal_, line_;
};

/// Starts the command and kills it after a while. Returns whether it had ended by then, with exit code 0.
bool run_and_kill(const std::vector<std::string>& arguments, std::chrono::microseconds after)
{
    std::vector<char*> words{const_cast<char*>(FIRSTRAY_COMMAND)};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    REQUIRE(posix_spawn(&child, FIRSTRAY_COMMAND, &actions, nullptr, words.data(), environ) == 0);
    posix_spawn_file_actions_destroy(&actions);
    std::this_thread::sleep_for(after);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("resumed, a run keeps its own whole frames and renders all others")
{
    for (const std::string ending : {"png", "exr"}) {
        CAPTURE(ending);
        const auto whole = undisturbed("0-4", ending);
        const Run run("0-4", ending);
        REQUIRE(run.call_with({"--frames", "1-3"}).code == 0);
        const auto written = fs::last_write_time(run.out() / ("1." + ending));
        // One is cut short, one is another frame's, one is empty.
        fs::resize_file(run.out() / ("2." + ending), fs::file_size(run.out() / ("2." + ending)) - 20);
        fs::rename(run.out() / ("3." + ending), run.out() / ("4." + ending));
        std::ofstream(run.out() / ("3." + ending)).flush();
        const Outcome outcome = run.call_with({"--resume"});
        CAPTURE(outcome.err);
        CHECK(outcome.code == 0);
        CHECK(outcome.err.find(
                  "1 of 5 frames are there; 3 of other scenes or settings, or not whole, are rendered anew") !=
              std::string::npos);
        CHECK(contents(run.out()) == whole);
        CHECK(fs::last_write_time(run.out() / ("1." + ending)) == written);
        CHECK(run.call_with({"--resume"}).err.find("5 of 5 frames are there\n") != std::string::npos);
    }
}

TEST_CASE("frames of another scene, texture or setting are rendered anew")
{
    const Run run;
    const auto texture = run.folder.write("pixel.ppm", "P6 1 1 255\nabc");
    const std::string text = std::string(moving_square) + "tt pixel.ppm 0 0 -2 0 0  9 0 -2 1 0  0 9 -2 0 1\n";
    run.folder.write("square.aff", text);
    REQUIRE(run.call_with({}).code == 0);
    const auto kept_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = {"--resume"};
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = run.call_with(all);
        REQUIRE(outcome.code == 0);
        return outcome.err.substr(10, outcome.err.find(" frames are there") - 10);
    };
    CHECK(kept_with({"--threads", "1"}) == "5 of 5");  // no picture depends on it
    CHECK(kept_with({"--size", "8x6"}) == "0 of 5");
    CHECK(kept_with({}) == "0 of 5");
    CHECK(kept_with({"--spp", "2"}) == "0 of 5");
    CHECK(kept_with({"--precision", "double"}) == "0 of 5");
    CHECK(kept_with({"--strategy", "obb"}) == "0 of 5");
    CHECK(kept_with({"--strategy", "obb"}) == "5 of 5");
    CHECK(kept_with({}) == "0 of 5");
    run.folder.write("square.aff", text + "\n");
    CHECK(kept_with({}) == "0 of 5");
    run.folder.write("pixel.ppm", "P6 1 1 255\nabd");
    CHECK(kept_with({}) == "0 of 5");
    CHECK(kept_with({}) == "5 of 5");
    CHECK(run.call_with({"--resume", "--frameless", "1/2"}).code == 2);
}

TEST_CASE("interrupted, a run keeps what is finished and can be resumed")
{
    const auto whole = undisturbed();
    for (const int signal : {SIGINT, SIGTERM}) {
        const Run run;
        RaisingBuffer buffer(signal, 2);
        std::ostream out(&buffer);
        std::ostringstream err;
        std::vector<std::string> arguments = run.arguments;
        const auto stats = run.folder.path() / "stats.json";
        arguments.insert(arguments.end(), {"--table", "--stats", stats.string()});
        CHECK(command::run(arguments, {out, err}) == 1);
        CHECK(err.str() == "firstray: interrupted; finished frames are whole, --resume goes on behind them\n");
        CHECK(contents(run.out()).size() == 2);
        CHECK(read_json(stats)["frames"].size() == 2);
        CHECK(run.call_with({"--resume"}).code == 0);
        CHECK(contents(run.out()) == whole);
    }
}

TEST_CASE("killed at any moment, a run leaves whole frames, and resumed it ends as if undisturbed")
{
    const auto whole = undisturbed();
    const Run run;
    int kills = 0;
    bool is_done = false;
    std::vector<std::string> arguments = run.arguments;
    arguments.insert(arguments.end(), {"--resume"});
    for (double wait = 500.0; !is_done && wait < 60e6; wait *= 1.15) {
        is_done = run_and_kill(arguments, std::chrono::microseconds(static_cast<std::int64_t>(wait)));
        kills += !is_done;
        for (const auto& [name, bytes] : contents(run.out()))
            if (!name.starts_with(".")) CHECK(whole.at(name) == bytes);
    }
    CHECK(is_done);
    CHECK(kills > 0);
    CHECK(contents(run.out()) == whole);  // and no part of a file is left
    MESSAGE(kills << " kills");
}

TEST_CASE("a disk that fills up ends a run with exit code 4 and leaves whole frames alone")
{
    const auto whole = undisturbed();
    const Run run;
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100, limit.rlim_max};
    REQUIRE(run.call_with({"--frames", "0,1"}).code == 0);
    setrlimit(RLIMIT_FSIZE, &small);
    const Outcome outcome = run.call_with({"--frames", "0-4", "--resume"});
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, handler);
    CHECK(outcome.code == 4);
    CHECK(outcome.err.find("2.png: File too large") != std::string::npos);
    CHECK(contents(run.out()).size() == 2);
    CHECK(run.call_with({"--resume"}).code == 0);
    CHECK(contents(run.out()) == whole);
}

TEST_CASE("output that cannot be written is told with exit code 4 and replaces no device")
{
    const Run run;
    const auto code_with = [&](const std::string& output) { return run.call_with({"--output", output}).code; };
    CHECK(code_with("/proc/nowhere/#.png") == 4);  // a file system that root cannot write to either
    run.folder.write("file", "");
    CHECK(code_with((run.folder.path() / "file" / "#.png").string()) == 4);
    CHECK(run.call_with({"--stats", "/dev/full"}).code == 4);
    CHECK(fs::is_character_file("/dev/full"));
    std::ofstream full("/dev/full");
    std::ostringstream err;
    const std::vector<std::string> info = {"info", run.arguments[1]};
    CHECK(command::run(info, {full, err}) == 4);
    CHECK(err.str() == "firstray: cannot write to standard output\n");

    const fs::path closed = run.folder.path() / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    if (geteuid() == 0)
        MESSAGE("skipped: root may write to a folder that is closed");
    else
        CHECK(code_with((closed / "#.png").string()) == 4);
    fs::permissions(closed, fs::perms::owner_all);
}

TEST_CASE("a folder that vanishes in the middle is made anew, one that becomes a file ends the run")
{
    const Run run;
    const std::string pattern = (run.folder.path() / "frames" / "#" / "picture.png").string();
    fs::create_directories(run.folder.path() / "frames");
    run.folder.write("frames/3", "a file where the folder of frame 3 is to be");
    const Outcome outcome = run.call_with({"--output", pattern});
    CHECK(outcome.code == 4);
    CHECK(outcome.err.find("frames/3/picture.png: cannot make its folder") != std::string::npos);
    for (const char* frame : {"0", "1", "2"})
        CHECK(fs::is_regular_file(run.folder.path() / "frames" / frame / "picture.png"));
    fs::remove_all(run.folder.path() / "frames");
    CHECK(run.call_with({"--output", pattern, "--resume"}).code == 0);
}

TEST_CASE("a texture that cannot be read ends the run before a frame is written")
{
    const Run run;
    const auto texture = run.folder.write("pixel.ppm", "P6 1 1 255\nabc");
    run.folder.write("square.aff", std::string(moving_square) + "tt pixel.ppm 0 0 -2 0 0  9 0 -2 1 0  0 9 -2 0 1\n");
    fs::permissions(texture, fs::perms::none);
    if (geteuid() == 0) {
        MESSAGE("skipped: root may read a file that is closed");
        fs::remove(texture);
        fs::create_directory(texture);
    }
    CHECK(run.call_with({}).code == 4);
    CHECK(contents(run.out()).empty());
}
