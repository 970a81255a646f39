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

struct Row {
    const char* text;
    const char* message;
};

constexpr const char* view = "v from 0 0 0 at 0 0 1 up 0 1 0 angle 45 hither 1 resolution 4 4";

}  // namespace

TEST_CASE("what is wrong in a file is named with its place and with what was expected")
{
    const Row rows[] = {
        {"q", "main.aff:1:1: \"q\", expected a statement"},
        {"\n\n  7", "main.aff:3:3: \"7\", expected a statement"},
        {"fmx 1", "main.aff:1:1: \"fmx\", expected a statement"},
        {"{", "main.aff:1:1: \"{\", expected a statement"},
        {"b 1 1 1 }", "main.aff:1:9: \"}\", expected a statement (no transform is open in this file)"},
        {"f m 1", "main.aff:1:3: \"m\", expected a number"},
        {"x s 1 1", "main.aff:1:5: \"1\", expected \"{\""},
        {"b 1 1", "main.aff:1:6: end of file, expected a number"},
        {"b 1 1 x", "main.aff:1:7: \"x\", expected a number"},
        {"b 1 1 1x", "main.aff:1:7: \"1x\", expected a number"},
        {"b nan 1 1", "main.aff:1:3: \"nan\", expected a number"},
        {"b -inf 1 1", "main.aff:1:3: \"-inf\", expected a number"},
        {"b 0x10 1 1", "main.aff:1:3: \"0x10\", expected a number"},
        {"b +-1 1 1", "main.aff:1:3: \"+-1\", expected a number"},
        {"b 1e39 1 1", "main.aff:1:3: \"1e39\", expected a number in the range of float"},
        {"b 1e999 1 1", "main.aff:1:3: \"1e999\", expected a number in the range of float"},
        {"b a\"\x01\xe9\\ 1", "main.aff:1:3: \"a\\\"\\x01\\xe9\\\\\", expected a number"},
        {"b # 1 1 1\r\n\t1 1 z", "main.aff:2:6: \"z\", expected a number"},
        {"l 1 2 3 4", "main.aff:1:10: end of file, expected a number"},
        {"x a { l 1 2 3 }",
         "main.aff:1:7: light inside an animated transform, expected lights outside (\"la\" and \"k\" move a light)"},
        {"la", "main.aff:1:3: end of file, expected the light's name"},
        {"fm 1 1 1 1 1 1 1 1 1 -1 0 0", "main.aff:1:22: \"-1\", expected an exponent of at least 0"},
        {"fm 1 1 1 1 1 1 1 1 1 1 1.5 0", "main.aff:1:24: \"1.5\", expected a transmittance in [0, 1]"},
        {"f 1 1 1 1 1 1 1 -2", "main.aff:1:17: \"-2\", expected an index of refraction of at least 0"},
        {"a 0 1 0", "main.aff:1:7: \"0\", expected a number of frames of at least 1"},
        {"a 0 1 2.5", "main.aff:1:7: \"2.5\", expected a number of frames of at least 1"},
        {"v from 0 0 0 up 0 1 0", "main.aff:1:14: \"up\", expected \"at\""},
        {"v from 1 0 0 at 1 0 0", "main.aff:1:1: view \"at\" the point it is \"from\", expected two different points"},
        {"v from 0 0 0 at 0 0 1 up 0 0 0",
         "main.aff:1:1: view whose \"up\" is zero or along its direction, expected a vector across it"},
        {"v from 0 0 0 at 0 0 1 up 0 0 -3",
         "main.aff:1:1: view whose \"up\" is zero or along its direction, expected a vector across it"},
        {"v from 0 0 0 at 0 0 1 up 0 1 0 angle 180", "main.aff:1:38: \"180\", expected an angle in (0, 180) degrees"},
        {"v from 0 0 0 at 0 0 1 up 0 1 0 angle 0", "main.aff:1:38: \"0\", expected an angle in (0, 180) degrees"},
        {"v from 0 0 0 at 0 0 1 up 0 1 0 angle 45 hither 1 resolution 0 4",
         "main.aff:1:61: \"0\", expected a resolution in [1, 16384]"},
        {"v from 0 0 0 at 0 0 1 up 0 1 0 angle 45 hither 1 resolution 4 16385",
         "main.aff:1:63: \"16385\", expected a resolution in [1, 16384]"},
        {"c 0 0 0 1 0 0 0 1", "main.aff:1:1: cone whose ends are one point, expected two different points"},
        {"c 0 0 0 0 1 0 0 0", "main.aff:1:1: cone with two radii of 0, expected a radius other than 0"},
        {"c 0 0 0 1 1 0 0 -1", "main.aff:1:1: cone with radii of different sign, expected radii of the same sign"},
        {"c 0 0 0 -1 1 0 0 1", "main.aff:1:1: cone with radii of different sign, expected radii of the same sign"},
        {"s 0 0 0 0", "main.aff:1:9: \"0\", expected a radius other than 0"},
        {"p 2 0 0 0 1 1 1", "main.aff:1:3: \"2\", expected a number of corners of at least 3"},
        {"m normals 3", "main.aff:1:3: \"normals\", expected \"vertices\""},
        {"m vertices -1", "main.aff:1:12: \"-1\", expected a count of at least 0"},
        {"m vertices 99999999999999999999", "main.aff:1:12: \"99999999999999999999\", expected a count of at least 0"},
        {"m vertices 9223372036854775807 1 2 3", "main.aff:1:37: end of file, expected a number"},
        {"m vertices 1 1 2 3 triangles 1000000000", "main.aff:1:40: end of file, expected an index"},
        {"m vertices 1 1 2 3 triangles 1\n0 0 1",
         "main.aff:2:5: triangle names vertex 1 of 1, expected an index in [0, 1)"},
        {"m vertices 1 1 2 3 triangles 1 -1 0 0",
         "main.aff:1:32: triangle names vertex -1 of 1, expected an index in [0, 1)"},
        {"m vertices 1 1 2 3 triangles 1 0 0 0.5", "main.aff:1:36: \"0.5\", expected an index"},
        {"m vertices 1 1 2 3 normals 0 triangles 1 0 0 0 4294967296",
         "main.aff:1:48: triangle names normal 4294967296 of 0, expected an index in [0, 0)"},
        {"m vertices 1 1 2 3 texturecoords 1 t.ppm 0 0 triangles 1 0 0 0 0 2 0",
         "main.aff:1:66: triangle names texture coordinate 2 of 1, expected an index in [0, 1)"},
        {"tpa 0", "main.aff:1:5: \"0\", expected a number of keys of at least 1"},
        {"tpa 2 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0.5",
         "main.aff:1:45: \"0.5\", expected a time not before the last key's"},
        {"xs 1 0 1 0 0 0 0 0 0 0 { }", "main.aff:1:1: scale factor 0, expected three factors other than 0"},
        {"xs 1 1 1 0 0 0 5 0 0 0 { }", "main.aff:1:1: rotation about the axis 0 0 0, expected an axis other than zero"},
        {"xs 1e30 1 1 1 0 0 0 0 0 0 { xs 1e30 1 1 1 0 0 0 0 0 0 { } }",
         "main.aff:1:29: transform that, with those around it, leaves the range of float, expected a smaller one"},
        {"xs 1e30 1 1 1 0 0 0 0 0 0 { p 3 1e30 0 0 0 0 0 0 1 0 }",
         "main.aff:1:29: point that its transforms carry out of the range of float, expected a nearer one"},
        {"xs 1e-30 1 1 1 0 0 0 0 0 0 { s 0 0 0 1 }",
         "main.aff:1:30: sphere, cone or cylinder that is flat, a line or a point, expected one with a volume"},
        {"xs 1 1 1 0 0 0 0 0 0 0 b", "main.aff:1:24: \"b\", expected \"{\""},
        {"x { }", "main.aff:1:3: \"{\", expected the transform's name"},
        {"x a { x b { }", "main.aff:1:14: end of file, expected \"}\" (1 open)"},
        {"x a { v", "main.aff:1:7: view inside a transform, expected \"v\" outside of all braces"},
        {"k a { transl 3", "main.aff:1:14: \"3\", expected a number of keys of at least 4"},
        {"k a { visibility 1 0 2 }", "main.aff:1:22: \"2\", expected 0 or 1"},
        {"k a { visibility 1 0 1 visibility 1 0 1 }",
         "main.aff:1:24: \"visibility\", expected a kind of track that this block does not have yet"},
        {"k a { turn 4", "main.aff:1:7: \"turn\", expected \"transl\", \"rot\", \"scale\", \"visibility\" or \"}\""},
        {"k a transl", "main.aff:1:5: \"transl\", expected \"{\""},
        {"i zero a.aff", "main.aff:1:3: \"zero\", expected a level of detail"},
        {"i 0 }", "main.aff:1:5: \"}\", expected a file name"},
        {"i 0 main.aff", "main.aff:1:5: \"main.aff\" includes itself, expected includes without a circle"},
    };
    const TempFolder folder;
    folder.write("t.ppm", "P6 1 1 255\nabc");
    for (const Row& row : rows) {
        CAPTURE(row.text);
        Fault kind{};
        CHECK(fault_of(folder, row.text, {}, &kind) == row.message);
        CHECK(kind == Fault::scene);
    }
    CHECK(fault_of(folder, view) == "");
}

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

TEST_CASE("textures and includes outside the scene's folder are refused")
{
    const TempFolder outer;
    outer.write("t.ppm", "");
    outer.write("scenery/a.aff", "");
    std::filesystem::create_directory(outer.path() / "scene");
    for (const char* statement : {"i 0 ../t.ppm", "tt ../t.ppm", "i 0 /etc/passwd", "i 0 ../scenery/a.aff"}) {
        CAPTURE(statement);
        try {
            read_aff(outer.write("scene/main.aff", statement));
            FAIL("was read");
        } catch (const SceneError& error) {
            const std::string message = error.what();
            CHECK(message.find("lies outside the scene's folder, expected a file inside it") != std::string::npos);
        }
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
