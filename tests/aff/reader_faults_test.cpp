#include <doctest/doctest.h>
#include <sys/stat.h>

#include "engine/aff/reader.h"
#include "engine/core/errors.h"
#include "tests/support/temp_folder.h"

namespace firstray {
namespace {

using test::TempFolder;

/// What reading main.aff fails with, the folder's name left out of it; empty if it does not fail.
std::string fault_of(const TempFolder& folder, const std::string& main, const ReadLimits& limits = {},
                     Fault* kind = nullptr)
{
    try {
        read_aff(folder.write("main.aff", main), limits);
        return {};
    } catch (const Error& error) {
        if (kind) *kind = error.fault();
        std::string message = error.what();
        const std::string prefix = folder.path().string() + "/";
        for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
        return message;
    }
}

}  // namespace

TEST_CASE("a fault in an included file tells how it came there")
{
    const TempFolder folder;
    folder.write("middle.aff", "# first line\n  i 0 bad.aff");
    folder.write("bad.aff", "s 1 2");
    folder.write("open.aff", "x a {");
    folder.write("close.aff", "}");
    folder.write("round.aff", "i 0 back.aff");
    folder.write("back.aff", "i 0 round.aff");
    CHECK(fault_of(folder, "b 1 1 1 i 0 middle.aff") ==
          "bad.aff:1:6: end of file, expected a number"
          "\n  included from middle.aff:2:3"
          "\n  included from main.aff:1:9");
    CHECK(fault_of(folder, "i 0 open.aff }") ==
          "open.aff:1:6: end of file, expected \"}\" (1 open)\n  included from main.aff:1:1");
    CHECK(fault_of(folder, "x a { i 0 close.aff") ==
          "close.aff:1:1: \"}\", expected a statement (no transform is open in this file)"
          "\n  included from main.aff:1:7");
    CHECK(fault_of(folder, "i 0 round.aff") ==
          "back.aff:1:5: \"round.aff\" includes itself, expected includes without a circle"
          "\n  included from round.aff:1:1\n  included from main.aff:1:1");
}

TEST_CASE("files that cannot be used are named with the place that wants them")
{
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "folder");
    REQUIRE(mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
    folder.write("outer.aff", "i 0 absent.aff");
    CHECK(fault_of(folder, "i 0 outer.aff") ==
          "outer.aff:1:5: cannot open absent.aff: No such file or directory\n  included from main.aff:1:1");
    Fault kind{};
    CHECK(fault_of(folder, "i 0 absent.aff", {}, &kind) ==
          "main.aff:1:5: cannot open absent.aff: No such file or directory");
    CHECK(kind == Fault::file);
    CHECK(fault_of(folder, "i 0 folder") == "main.aff:1:5: cannot open folder: not a regular file");
    CHECK(fault_of(folder, "i 0 pipe") == "main.aff:1:5: cannot open pipe: not a regular file");
    CHECK(fault_of(folder, "tt absent.ppm 0 0 0") == "main.aff:1:4: cannot open absent.ppm: No such file or directory");
    CHECK_THROWS_WITH_AS(
        read_aff(folder.path() / "none.aff"),
        ("cannot open " + (folder.path() / "none.aff").string() + ": No such file or directory").c_str(), FileError);
    CHECK_THROWS_AS(read_aff(folder.path()), FileError);
    CHECK_THROWS_AS(read_aff("/dev/zero"), FileError);
}

namespace {

enum class Path { is_read, is_outside, is_no_file };

struct PathRow {
    std::string name;  ///< as a scene file gives it
    Path by_default, if_allowed;
};

/// What becomes of a name that a scene file includes, or gives for a texture.
Path outcome_of(const TempFolder& outer, const std::string& statement, bool allow_outside)
{
    ReadLimits limits;
    limits.allow_outside = allow_outside;
    try {
        read_aff(outer.write("scene/main.aff", statement), limits);
        return Path::is_read;
    } catch (const SceneError& error) {
        CHECK(std::string(error.what()).find("lies outside the scene's folder, expected a file inside it") !=
              std::string::npos);
        return Path::is_outside;
    } catch (const FileError& error) {
        CHECK(std::string(error.what()).find("main.aff:1:") != std::string::npos);
        return Path::is_no_file;
    }
}

}  // namespace

TEST_CASE("includes and textures lie in the scene's folder, whatever their names; devices and pipes are never opened")
{
    namespace fs = std::filesystem;
    const TempFolder outer;
    const std::string root = outer.path().string();
    for (const char* name : {"scene/a.aff", "scene/sub/b.aff", "scene-of-others/c.aff", "d.aff"}) outer.write(name, "");
    const auto link = [&](const char* to, const char* name) { fs::create_symlink(to, outer.path() / "scene" / name); };
    link("a.aff", "to-inside");
    link("../d.aff", "to-outside");
    link("to-outside", "to-link-to-outside");
    link("..", "up");
    link("nowhere", "dangling");
    link("loop", "loop");
    link("/dev/zero", "to-device");
    REQUIRE(mkfifo((outer.path() / "scene/pipe").c_str(), 0600) == 0);
    REQUIRE(mkfifo((outer.path() / "pipe").c_str(), 0600) == 0);
    const PathRow rows[] = {
        {"a.aff", Path::is_read, Path::is_read},
        {"./sub/../a.aff", Path::is_read, Path::is_read},
        {"sub/b.aff", Path::is_read, Path::is_read},
        {"../scene/a.aff", Path::is_read, Path::is_read},
        {root + "/scene/a.aff", Path::is_read, Path::is_read},
        {"to-inside", Path::is_read, Path::is_read},
        {"up/scene/a.aff", Path::is_read, Path::is_read},
        {"../d.aff", Path::is_outside, Path::is_read},
        {"sub/../../d.aff", Path::is_outside, Path::is_read},
        {"../scene-of-others/c.aff", Path::is_outside, Path::is_read},
        {root + "/d.aff", Path::is_outside, Path::is_read},
        {"to-outside", Path::is_outside, Path::is_read},
        {"to-link-to-outside", Path::is_outside, Path::is_read},
        {"up/d.aff", Path::is_outside, Path::is_read},
        {"sub", Path::is_no_file, Path::is_no_file},
        {"up", Path::is_no_file, Path::is_no_file},
        {"..", Path::is_no_file, Path::is_no_file},
        {"dangling", Path::is_no_file, Path::is_no_file},
        {"loop", Path::is_no_file, Path::is_no_file},
        {"pipe", Path::is_no_file, Path::is_no_file},
        {"../pipe", Path::is_no_file, Path::is_no_file},
        {"to-device", Path::is_no_file, Path::is_no_file},
        {"/dev/zero", Path::is_no_file, Path::is_no_file},
        {"/dev/stdin/x", Path::is_no_file, Path::is_no_file},
        {"http://localhost/a.aff", Path::is_no_file, Path::is_no_file},
        {"file:///etc/passwd", Path::is_no_file, Path::is_no_file},
    };
    for (const PathRow& row : rows) {
        CAPTURE(row.name);
        const std::string texture = "tt " + row.name + " 0 0 0 0 0  1 0 0 0 0  0 1 0 0 0";
        CHECK(outcome_of(outer, "i 0 " + row.name, false) == row.by_default);
        CHECK(outcome_of(outer, texture, false) == row.by_default);
        CHECK(outcome_of(outer, "i 0 " + row.name, true) == row.if_allowed);
        CHECK(outcome_of(outer, texture, true) == row.if_allowed);
    }
}

TEST_CASE("limits are kept, and named when they are exceeded")
{
    const TempFolder folder;
    folder.write("a.aff", "i 0 b.aff");
    folder.write("b.aff", "i 0 c.aff");
    folder.write("c.aff", "");
    ReadLimits limits;
    limits.include_depth = 2;
    limits.transform_depth = 2;
    limits.primitives = 3;
    limits.keys = 4;
    Fault kind{};
    CHECK(fault_of(folder, "i 0 a.aff", limits, &kind) ==
          "b.aff:1:5: more than 2 includes inside each other (limit: include_depth)"
          "\n  included from a.aff:1:1\n  included from main.aff:1:1");
    CHECK(kind == Fault::limit);
    CHECK(fault_of(folder, "i 0 b.aff", limits) == "");
    CHECK(fault_of(folder, "x a { x b { x c { } } }", limits) ==
          "main.aff:1:15: more than 2 transforms inside each other (limit: transform_depth)");
    CHECK(fault_of(folder, "x a { x b { } } x c { x d { } }", limits) == "");
    CHECK(fault_of(folder, "s 0 0 0 1 m vertices 1 0 0 0 triangles 3", limits) ==
          "main.aff:1:40: more than 3 primitives (limit: primitives)");
    CHECK(fault_of(folder, "p 6", limits) == "main.aff:1:3: more than 3 primitives (limit: primitives)");
    CHECK(fault_of(folder, "s 0 0 0 1 s 0 0 0 1 s 0 0 0 1 s 0 0 0 1", limits).find("more than 3 primitives") !=
          std::string::npos);
    CHECK(fault_of(folder, "k a { rot 5", limits) == "main.aff:1:11: more than 4 keys in one track (limit: keys)");

    limits = {};
    limits.file_bytes = 10;
    CHECK(fault_of(folder, "# 10 bytes", limits) == "");
    CHECK(fault_of(folder, "# 11 bytes.", limits) == "main.aff has 11 bytes, more than 10 (limit: file_bytes)");
    limits = {};
    limits.files = 2;
    CHECK(fault_of(folder, "i 0 c.aff i 0 c.aff", limits) == "");
    CHECK(fault_of(folder, "i 0 b.aff", limits) ==
          "b.aff:1:5: more than 2 distinct files (limit: files)\n  included from main.aff:1:1");
}

TEST_CASE("includes that double at every level end at a limit, not with the machine")
{
    const TempFolder folder;
    for (int i = 0; i < 30; ++i) {
        const std::string next = "i 0 f" + std::to_string(i + 1) + "\n";
        folder.write("f" + std::to_string(i), next + next);
    }
    folder.write("f30", "");
    ReadLimits limits;
    limits.expanded_bytes = 1'000'000;
    CHECK(fault_of(folder, "i 0 f0", limits).find("more than 1000000 bytes with every repetition of a file") !=
          std::string::npos);
}

TEST_CASE("a long token is quoted up to 80 characters")
{
    const TempFolder folder;
    CHECK(fault_of(folder, "b " + std::string(100, 'z')) ==
          "main.aff:1:3: \"" + std::string(80, 'z') + "...\", expected a number");
}

TEST_CASE("every beginning of a valid file is read or refused, never worse")
{
    const std::string text =
        "v from 0 0 0 at 0 0 1 up 0 1 0 angle 45 hither 1 resolution 4 4 la a 1 2 3 1 1 1 fm 1 1 1 1 1 1 1 1 1 1 0 0\n"
        "xs 1 1 1 0 0 1 30 0 0 0 { x b { m vertices 3 0 0 0 1 0 0 0 1 0 normals 1 0 0 1 triangles 1 0 1 2 0 0 0 } }\n"
        "p 4 0 0 0 1 0 0 1 1 0 0 1 0 s 0 0 0 1 c 0 0 0 1 1 1 1 1 tpa 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n"
        "k b { visibility 1 0 1 rot 4 0 1 0 0 0 0 0 0 1 1 0 0 90 0 0 0 2 1 0 0 180 0 0 0 3 1 0 0 0 0 0 0 } #";
    const TempFolder folder;
    int refused = 0;
    for (std::size_t length = 0; length <= text.size(); ++length)
        refused += !fault_of(folder, text.substr(0, length)).empty();
    CHECK(refused > 300);
    CHECK(fault_of(folder, text) == "");
}

}  // namespace firstray
