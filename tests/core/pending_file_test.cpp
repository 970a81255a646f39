#include "engine/core/pending_file.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/errors.h"
#include "tests/support/temp_folder.h"

namespace firstray {
namespace {

/// How many entries there are, hidden ones included.
std::ptrdiff_t entries(const test::TempFolder& folder)
{
    return std::distance(std::filesystem::directory_iterator(folder.path()), {});
}

std::string content_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

TEST_CASE("a pending file appears under its name only when it is committed")
{
    const test::TempFolder folder;
    const auto target = folder.write("answer.txt", "old");
    {
        PendingFile pending(target);
        std::ofstream(pending.path()) << "half";
        CHECK(content_of(target) == "old");
        CHECK(pending.path().parent_path() == target.parent_path());
        CHECK(entries(folder) == 2);
    }
    CHECK(entries(folder) == 1);
    CHECK(content_of(target) == "old");

    PendingFile pending(target);
    std::ofstream(pending.path()) << "new";
    pending.commit();
    CHECK(content_of(target) == "new");
    CHECK(entries(folder) == 1);
}

TEST_CASE("a whole file is written into folders that did not exist")
{
    const test::TempFolder folder;
    write_whole_file(folder.path() / "a/b/c.json", "{}\n");
    CHECK(content_of(folder.path() / "a/b/c.json") == "{}\n");
}

TEST_CASE("what a process that is gone left of a file is removed, and nothing else")
{
    // Processes have numbers below 2^22; the second name is a living one's.
    const std::string gone = "2000000000", living = std::to_string(getpid());
    const test::TempFolder folder;
    folder.write(".a.b.png." + gone + "-12.part", "");
    const std::vector<std::string> kept = {".a.b.png." + living + "-0.part",
                                           ".other.png." + gone + "-0.part",
                                           "a.b.png." + gone + "-0.part",
                                           ".a.b.png." + gone + "-0.par",
                                           ".a.b.png." + gone + ".part",
                                           ".a.b.png." + gone + "-.part",
                                           ".a.b.png." + gone + "-1x.part",
                                           ".a.b.png.0" + gone + "-0.part",
                                           ".a.b.png.-" + gone + "-0.part",
                                           ".a.b.png.99999999999-0.part",
                                           ".a.b.png..part",
                                           "..1-0.part",
                                           ".part",
                                           "a.b.png"};
    for (const std::string& name : kept) folder.write(name, "");
    remove_abandoned(std::vector{folder.path() / "a.b.png", folder.path() / "absent/a.b.png"});
    CHECK_FALSE(std::filesystem::exists(folder.path() / (".a.b.png." + gone + "-12.part")));
    for (const std::string& name : kept) {
        CAPTURE(name);
        CHECK(std::filesystem::exists(folder.path() / name));
    }
}

TEST_CASE("a file that cannot be written is a file fault that names it")
{
    const test::TempFolder folder;
    folder.write("plain", "");
    std::filesystem::create_directory(folder.path() / "taken");
    for (const std::string name : {"plain/below.txt", "taken"}) {
        CAPTURE(name);
        const auto target = folder.path() / name;
        const std::string start = "cannot write " + target.string() + ": ";
        CHECK_THROWS_WITH_AS(write_whole_file(target, "x"), doctest::Contains(start.c_str()), FileError);
    }
    CHECK(entries(folder) == 2);
}

}  // namespace
}  // namespace firstray
