#include "scenes/generator/texture_maker.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "engine/image/image.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::scenes;

namespace {

/// Mean difference of two rows (or columns) of a texture, in bytes.
double difference(const Texture& t, int a, int b, bool columns)
{
    const int length = columns ? t.height : t.width;
    double sum = 0.0;
    for (int i = 0; i < length; ++i)
        for (int c = 0; c < 3; ++c) {
            const auto at = [&](int line) {
                const int x = columns ? line : i, y = columns ? i : line;
                return static_cast<int>(t.pixels[static_cast<std::size_t>(3 * (y * t.width + x) + c)]);
            };
            sum += std::abs(at(a) - at(b));
        }
    return sum / (3.0 * length);
}

/// The largest mean difference of neighbouring rows or columns.
double largest_difference(const Texture& t, bool columns)
{
    double largest = 0.0;
    for (int i = 0; i + 1 < (columns ? t.width : t.height); ++i)
        largest = std::max(largest, difference(t, i, i + 1, columns));
    return largest;
}

}  // namespace

TEST_CASE("textures that repeat have no seam")
{
    const test::TempFolder folder;
    const auto file = folder.path() / "t.ppm";
    for (const auto& write :
         {write_cobbles, write_meadow, write_plaster, write_slabs, write_masonry, write_parquet, write_turf}) {
        write(file, 3);
        const Texture t = image::read_texture(file);
        CHECK(difference(t, 0, t.height - 1, false) <= largest_difference(t, false));
        CHECK(difference(t, 0, t.width - 1, true) <= largest_difference(t, true));
        CHECK(largest_difference(t, false) > 1.0);  // something is on it
    }
}

TEST_CASE("noise repeats with its period, stays within 0 and 1 and depends on its seed")
{
    double low = 1.0, high = 0.0, other = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double x = 0.037 * i, y = 0.0913 * i, value = clouds(x, y, 4, 3, 1);
        CHECK(value == doctest::Approx(clouds(x + 4.0, y - 8.0, 4, 3, 1)).epsilon(1e-9));
        low = std::min(low, value), high = std::max(high, value);
        other = std::max(other, std::abs(value - clouds(x, y, 4, 3, 2)));
    }
    CHECK((low >= 0.0 && low < 0.3 && high <= 1.0 && high > 0.7));
    CHECK(other > 0.2);
}

TEST_CASE("a texture holds the colours it was given, clamped, rows from the top")
{
    const test::TempFolder folder;
    const auto file = folder.path() / "t.ppm";
    write_texture(file, 2, 2,
                  [](double u, double v) { return glm::dvec3(u < 0.5 ? -1.0 : 2.0, v < 0.5 ? 0.0 : 1.0, 0.5); });
    const Texture t = image::read_texture(file);
    CHECK(t.pixels == std::vector<std::uint8_t>{0, 0, 128, 255, 0, 128, 0, 255, 128, 255, 255, 128});
}
