#include "engine/grid/resolution.h"

#include <doctest/doctest.h>

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
