#include "engine/render/texture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace firstray;

namespace {

/// Three columns, two rows; red counts columns, green rows: texel (x, y) is (50 x, 100 y, 255).
Texture counting()
{
    Texture t{.width = 3, .height = 2, .pixels = {}};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            for (const int byte : {50 * x, 100 * y, 255}) t.pixels.push_back(static_cast<std::uint8_t>(byte));
    return t;
}

/// Whether two colours agree to a hundredth of a byte.
bool agree(const glm::vec3& a, const glm::vec3& bytes)
{
    return glm::distance(a * 255.0f, bytes) < 0.01f;
}

}  // namespace

TEST_CASE("texel centres show the texels, v = 0 being the first row of the file")
{
    const Texture t = counting();
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            CHECK(agree(t.at({(fx + 0.5f) / 3.0f, (fy + 0.5f) / 2.0f}).colour(), {50 * x, 100 * y, 255}));
        }
}

TEST_CASE("between texels a texture is interpolated, across its edges too")
{
    const Texture t = counting();
    CHECK(agree(t.at({1.0f / 3.0f, 0.25f}).colour(), {25, 0, 255}));
    CHECK(agree(t.at({0.75f / 3.0f, 0.25f}).colour(), {12.5f, 0, 255}));
    CHECK(agree(t.at({0.5f, 0.5f}).colour(), {50, 50, 255}));
    CHECK(agree(t.at({0.0f, 0.25f}).colour(), {50, 0, 255}));  // half of column 0, half of column 2
    CHECK(agree(t.at({0.5f, 0.0f}).colour(), {50, 50, 255}));  // half of row 0, half of row 1
    CHECK(agree(t.at({0.125f / 3.0f, 0.25f}).colour(), {37.5f, 0, 255}));
}

TEST_CASE("textures repeat, to negative coordinates too")
{
    const Texture t = counting();
    for (const float shift : {-196.0f, -3.0f, -1.0f, 1.0f, 62.0f, 328.0f})
        for (const glm::vec2 uv : {glm::vec2(0.5f / 3.0f, 0.25f), glm::vec2(0.4f, 0.6f), glm::vec2(0.99f, 0.99f)}) {
            CAPTURE(shift);
            CHECK(glm::distance(t.at(uv).colour(), t.at(uv + shift).colour()) < 3e-4f);
            CHECK(glm::distance(t.at(uv).colour(), t.at({uv.x, uv.y + shift}).colour()) < 3e-4f);
        }
}

TEST_CASE("no coordinate leads outside a texture")
{
    const Texture t = counting();
    const float infinity = std::numeric_limits<float>::infinity();
    const float tiny = -std::numeric_limits<float>::denorm_min();  // its fraction rounds to 1
    for (const float c : {tiny, -1e-9f, 1e-9f, 0.99999994f, -3.4e38f, 3.4e38f, infinity, -infinity, std::nanf("")})
        for (const glm::vec2 uv : {glm::vec2(c, 0.3f), glm::vec2(0.3f, c)}) {
            CAPTURE(c);
            const glm::vec3 colour = t.at(uv).colour();
            CHECK(colour.b == 1.0f);  // of every texel
        }
}
