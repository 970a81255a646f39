#include "engine/scene/scene.h"

#include <doctest/doctest.h>

namespace firstray {

TEST_CASE("the first and the last frame are exactly at start and end")
{
    Scene scene;
    scene.start = -1.0;
    scene.end = 0.1;
    for (const int frames : {2, 3, 7, 300, 800, 1000}) {
        scene.frames = frames;
        CHECK(scene.time_of(0) == -1.0);
        CHECK(scene.time_of(frames - 1) == 0.1);
    }
    scene.frames = 12;
    CHECK(scene.time_of(1) == doctest::Approx(-0.9));
}

TEST_CASE("an animation of one frame is at its start")
{
    Scene scene;
    scene.start = 3.0;
    scene.end = 5.0;
    scene.frames = 1;
    CHECK(scene.time_of(0) == 3.0);
}

TEST_CASE("a census counts what it never met as zero")
{
    Census census;
    census.statements = {{"fm", 3}, {"m", 2}};
    CHECK(census.count("fm") == 3);
    CHECK(census.count("f") == 0);
}

}  // namespace firstray
