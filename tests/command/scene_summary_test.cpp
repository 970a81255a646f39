#include "bench/firstray/scene_summary.h"

#include <doctest/doctest.h>

#include "tests/support/call_command.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::command;
using namespace firstray::test;

namespace {

constexpr std::uint64_t many_rays = 800 * 600;

/// The recommendation for shares of what stands still, moves and deforms.
std::string recommended(std::uint64_t still, std::uint64_t rigid, std::uint64_t deforming,
                        std::uint64_t rays = many_rays)
{
    SceneMotion motion;
    motion.still = still;
    motion.rigid = rigid;
    motion.deforming = deforming;
    return recommend(motion, rays).strategy;
}

}  // namespace

TEST_CASE("the recommendation follows what moves, and its reason names the share")
{
    CHECK(recommended(100, 0, 0) == "lazy");
    CHECK(recommended(10, 90, 0) == "obb");
    CHECK(recommended(90, 10, 0) == "lazy");
    CHECK(recommended(10, 0, 90) == "lazy");
    CHECK(recommended(67, 29, 4) == "lazy");
    CHECK(recommended(10, 90, 0, 100) == "adaptive");
    CHECK(recommended(0, 0, 0) == "lazy");
    SceneMotion motion;
    motion.still = 14;
    motion.rigid = 86;
    CHECK(recommend(motion, many_rays).reason.starts_with("86 % of the primitives move without changing shape"));
}

TEST_CASE("info tells what moves, how far, and what to type")
{
    const TempFolder folder;
    const std::string scene = folder.write("square.aff", moving_square).string();
    const auto info = nlohmann::json::parse(call({"info", scene, "--json"}).out);
    CHECK(info["motion"]["still"] == 1);
    CHECK(info["motion"]["rigid"] == 2);
    CHECK(info["motion"]["deforming"] == 0);
    REQUIRE(info["motion"]["groups"].size() == 1);
    CHECK(info["motion"]["groups"][0]["name"] == "mover");
    CHECK(info["motion"]["groups"][0]["reach"].get<double>() == doctest::Approx(4.0));
    CHECK(info["recommended"]["strategy"] == "adaptive");  // 16 x 12 pixels

    const std::string text = call({"info", scene}).out;
    CHECK(text.find("mover                            2 primitives, rigid, up to 4 away\n") != std::string::npos);
    CHECK(text.find("recommended  adaptive: 192 primary rays a frame are few") != std::string::npos);
    CHECK(text.find("firstray render " + scene + " --strategy adaptive\n") != std::string::npos);
}
