#include "engine/render/frame.h"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

using namespace firstray;

TEST_CASE("pictures have the same hash exactly when size and colours are the same")
{
    Frame frame;
    frame.width = 3;
    frame.height = 2;
    frame.colour.assign(6, glm::vec3(0.25f, 0.5f, 0.75f));
    const std::uint64_t hash = image_hash(frame);
    CHECK(image_hash(frame) == hash);

    Frame turned = frame;
    std::swap(turned.width, turned.height);
    CHECK(image_hash(turned) != hash);

    for (std::size_t pixel = 0; pixel < 6; ++pixel)
        for (int channel = 0; channel < 3; ++channel) {
            Frame other = frame;
            other.colour[pixel][channel] = std::nextafter(other.colour[pixel][channel], 2.0f);
            CHECK(image_hash(other) != hash);
        }

    Frame with_costs = frame;
    with_costs.cells.assign(6, 7);
    CHECK(image_hash(with_costs) == hash);
}

TEST_CASE("the hash is FNV-1a over 32-bit words")
{
    // (basis ^ 0) * prime, twice, modulo 2^64, for a picture of no pixels.
    const std::uint64_t basis = 14695981039346656037u, prime = 1099511628211u;
    CHECK(image_hash(Frame{}) == basis * prime * prime);
}
