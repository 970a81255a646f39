#include "engine/grid/resolution.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>

using namespace firstray;

TEST_CASE("cells are nearly cubes and as many as asked for")
{
    CHECK(choose_grid_dims({1, 1, 1}, 1000, 1.0f) == glm::ivec3(10));
    CHECK(choose_grid_dims({4, 2, 1}, 8000, 1.0f) == glm::ivec3(40, 20, 10));
    CHECK(choose_grid_dims({4e-20f, 2e-20f, 1e-20f}, 8000, 1.0f) == glm::ivec3(40, 20, 10));
    CHECK(choose_grid_dims({1, 1, 1}, 10, 0.1f) == glm::ivec3(1));
}

TEST_CASE("flat and empty boxes get one cell along what they lack")
{
    CHECK(choose_grid_dims({0, 0, 0}, 1000, 1.0f) == glm::ivec3(1));
    CHECK(choose_grid_dims({1, 1, 0}, 100, 1.0f) == glm::ivec3(10, 10, 1));
    CHECK(choose_grid_dims({1, 1e-9f, 1}, 100, 1.0f) == glm::ivec3(10, 1, 10));
    CHECK(choose_grid_dims({0, 5, 0}, 64, 1.0f) == glm::ivec3(1, 64, 1));
    CHECK(choose_grid_dims({1, 0, 0}, 1u << 30, 8.0f) == glm::ivec3(max_grid_dim, 1, 1));
}

TEST_CASE("a box whose lengths are no numbers, or infinite, gets one cell")
{
    const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (int axis = 0; axis < 3; ++axis)
        for (const float length : {infinite, nan}) {
            glm::vec3 size(1.0f);
            size[axis] = length;
            CHECK(choose_grid_dims(size, 1000, 1.0f) == glm::ivec3(1));
        }
}
