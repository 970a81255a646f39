#include "bench/firstray/stats.h"

#include <doctest/doctest.h>

#include <fstream>

#include "tests/support/temp_folder.h"

namespace firstray::command {
namespace {

FrameStats some_stats()
{
    FrameStats stats;
    stats.frame = 12;
    stats.time = 0.5;
    stats.pose_ms = 1.0;
    stats.update_ms = 10.0;
    stats.trace_ms = 100.0;
    stats.rays = {1'000'000, 2'000'000, 30, 4};
    stats.structure.references = 77;
    stats.structure.bytes = 5'000'000;
    stats.structure.lazy_build_ms = 0.25;
    stats.image_hash = 0xabc;
    return stats;
}

Json read(const std::filesystem::path& file)
{
    std::ifstream in(file);
    return Json::parse(in);
}

TEST_CASE("a frame's statistics have the agreed names")
{
    const Json json = to_json(some_stats());
    CHECK(json["frame"] == 12);
    CHECK(json["time"] == 0.5);
    CHECK(json["pose_ms"] == 1.0);
    CHECK(json["update_ms"] == 10.0);
    CHECK(json["trace_ms"] == 100.0);
    CHECK(json["total_ms"] == 110.0);
    CHECK(json["lazy_build_ms"] == 0.25);
    CHECK(json["rays"] == Json{{"primary", 1'000'000}, {"shadow", 2'000'000}, {"reflected", 30}, {"transmitted", 4}});
    for (const char* name : {"grids", "voxels", "subgrids", "references", "bytes", "peak_bytes"}) {
        CAPTURE(name);
        CHECK(json["structure"].contains(name));
    }
    CHECK(json["structure"]["references"] == 77);
    CHECK(json["image_hash"] == "0000000000000abc");
}

TEST_CASE("the machine is described by processor, threads, instruction set, compiler and version")
{
    const Json machine = describe_machine();
    CHECK(machine["threads"] >= 1);
    for (const char* name : {"cpu", "instruction_set", "compiler", "version", "libraries"}) {
        CAPTURE(name);
        CHECK_FALSE(machine[name].get<std::string>().empty());
    }
}

TEST_CASE("the first frame is on disk at once and all are after a flush")
{
    const test::TempFolder folder;
    const auto file = folder.path() / "deep/stats.json";
    StatsFile stats(file, {{"strategy", "grid"}});
    stats.add(some_stats());
    CHECK(read(file)["frames"].size() == 1);
    stats.add(some_stats());
    stats.add(some_stats());
    stats.flush();
    const Json json = read(file);
    CHECK(json["frames"].size() == 3);
    CHECK(json["settings"]["strategy"] == "grid");
    CHECK(json["machine"]["threads"] >= 1);
    CHECK(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}) == 1);
}

TEST_CASE("the table's rows stand under its heading")
{
    const std::string row = table_row(some_stats());
    CHECK(row.size() == table_heading().size());
    CHECK(row == "    12     1.000     10.000    100.000    110.000   30.000          77     5.00\n");
}

}  // namespace
}  // namespace firstray::command
