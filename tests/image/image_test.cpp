#include "engine/image/image.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <bit>
#include <csignal>
#include <limits>

#include "engine/core/errors.h"
#include "tests/support/bart.h"
#include "tests/support/temp_folder.h"

namespace firstray::image {
namespace {

/// How many entries there are, hidden ones included.
std::ptrdiff_t entries(const test::TempFolder& folder)
{
    return std::distance(std::filesystem::directory_iterator(folder.path()), {});
}

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Aov all_aovs[] = {Aov::distance, Aov::primitive, Aov::group, Aov::cells, Aov::tests, Aov::time, Aov::age};

/// 2x2 pixels; every layer holds values that a detour through another type would change.
Frame awkward_frame()
{
    Frame frame;
    frame.width = frame.height = 2;
    frame.colour = {{0.0f, 0.1f, 1.0f}, {0.25f, 1.0f / 3.0f, 0.5f}, {1e-30f, 0.9999999f, 0.7f}, {1.0f, 1.0f, 1.0f}};
    frame.distance = {infinity, 1.0e-38f, 16777217.0f, 0.1f};
    frame.primitive = {no_primitive, 0, 16777217u, 4294967294u};
    frame.group = {no_primitive, 1, 33554433u, 7};
    frame.cells = {0, 1, 2147483648u, 4294967295u};
    frame.tests = {3, 16777219u, 5, 6};
    frame.nanoseconds = {0.0f, 0.5f, 1234567.0f, 3.0e9f};
    frame.age = {0, 3, 16777221u, 4294967293u};
    return frame;
}

struct ReadBack {
    OIIO::ImageSpec spec;
    std::vector<std::uint32_t> words;

    std::size_t channel(const std::string& name) const
    {
        const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
        REQUIRE(found != spec.channelnames.end());
        return static_cast<std::size_t>(found - spec.channelnames.begin());
    }
    std::vector<std::uint32_t> uints(const std::string& name) const
    {
        const std::size_t c = channel(name);
        CHECK(spec.channelformat(static_cast<int>(c)) == OIIO::TypeUInt32);
        std::vector<std::uint32_t> layer;
        for (std::size_t i = c; i < words.size(); i += static_cast<std::size_t>(spec.nchannels))
            layer.push_back(words[i]);
        return layer;
    }
    std::vector<float> floats(const std::string& name) const
    {
        const std::size_t c = channel(name);
        CHECK(spec.channelformat(static_cast<int>(c)) == OIIO::TypeFloat);
        std::vector<float> layer;
        for (std::size_t i = c; i < words.size(); i += static_cast<std::size_t>(spec.nchannels))
            layer.push_back(std::bit_cast<float>(words[i]));
        return layer;
    }
};

ReadBack read_back(const std::filesystem::path& file)
{
    const auto in = OIIO::ImageInput::open(file.string());
    REQUIRE(in);
    ReadBack result{in->spec(), {}};
    REQUIRE(result.spec.pixel_bytes(true) == 4 * static_cast<std::size_t>(result.spec.nchannels));
    result.words.resize(result.spec.image_pixels() * static_cast<std::size_t>(result.spec.nchannels));
    REQUIRE(in->read_image(0, 0, 0, result.spec.nchannels, OIIO::TypeUnknown, result.words.data()));
    return result;
}

TEST_CASE("an EXR frame keeps the type and every bit of all layers")
{
    const test::TempFolder folder;
    const Frame frame = awkward_frame();
    write_frame(folder.path() / "frame.exr", frame, all_aovs);
    const ReadBack read = read_back(folder.path() / "frame.exr");
    CHECK(read.spec.nchannels == 10);
    CHECK(read.floats("distance") == frame.distance);
    CHECK(read.uints("primitive") == frame.primitive);
    CHECK(read.uints("group") == frame.group);
    CHECK(read.uints("cells") == frame.cells);
    CHECK(read.uints("tests") == frame.tests);
    CHECK(read.floats("time") == frame.nanoseconds);
    CHECK(read.uints("age") == frame.age);
    for (int c = 0; c < 3; ++c) {
        const std::vector<float> layer = read.floats(std::string(1, "RGB"[c]));
        for (std::size_t i = 0; i < 4; ++i) CHECK(layer[i] == frame.colour[i][c]);
    }
}

TEST_CASE("a frame without layers is three channels of float")
{
    const test::TempFolder folder;
    write_frame(folder.path() / "frame.exr", awkward_frame(), {});
    const ReadBack read = read_back(folder.path() / "frame.exr");
    CHECK(read.spec.channelnames == std::vector<std::string>{"R", "G", "B"});
    CHECK(read.spec.format == OIIO::TypeFloat);
}

TEST_CASE("writing the same frame twice gives the same bytes")
{
    const test::TempFolder folder;
    const auto bytes = [](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (const std::string end : {".exr", ".png"}) {
        CAPTURE(end);
        write_frame(folder.path() / ("a" + end), awkward_frame(), {});
        write_frame(folder.path() / ("b" + end), awkward_frame(), {});
        CHECK(bytes(folder.path() / ("a" + end)) == bytes(folder.path() / ("b" + end)));
    }
}

TEST_CASE("a PNG frame rounds to the nearest of 256 values without gamma")
{
    const test::TempFolder folder;
    Frame frame;
    frame.width = 256;
    frame.height = 1;
    for (int i = 0; i < 256; ++i) frame.colour.emplace_back(static_cast<float>(i) / 255.0f);
    frame.colour[10] = {-1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()};
    frame.colour[11] = glm::vec3(10.6f / 255.0f);
    write_frame(folder.path() / "frame.png", frame, {});
    const Texture read = read_texture(folder.path() / "frame.png");
    REQUIRE(read.pixels.size() == 768);
    for (std::size_t i = 0; i < 256; ++i)
        if (i != 10) CHECK(read.pixels[3 * i + 1] == i);
    CHECK(read.pixels[30] == 0);
    CHECK(read.pixels[31] == 255);
    CHECK(read.pixels[32] == 0);
}

TEST_CASE("attributes are found in the header of both formats")
{
    const test::TempFolder folder;
    const std::pair<std::string, std::string> attributes[] = {{"firstray:frame", "12"}, {"firstray:strategy", "grid"}};
    for (const std::string name : {"frame.exr", "frame.png"}) {
        CAPTURE(name);
        write_frame(folder.path() / name, awkward_frame(), {}, attributes);
        const auto in = OIIO::ImageInput::open((folder.path() / name).string());
        REQUIRE(in);
        CHECK(in->spec().get_string_attribute("firstray:frame") == "12");
        CHECK(in->spec().get_string_attribute("firstray:strategy") == "grid");
    }
}

TEST_CASE("what cannot be written is refused and leaves nothing behind")
{
    const test::TempFolder folder;
    const Frame frame = awkward_frame();
    CHECK_THROWS_WITH_AS(write_frame(folder.path() / "frame.png", frame, all_aovs),
                         doctest::Contains("PNG holds colour alone"), FileError);
    CHECK_THROWS_WITH_AS(write_frame(folder.path() / "frame.jpg", frame, {}),
                         doctest::Contains("must end in .exr or .png"), FileError);
    Frame without_costs = frame;
    without_costs.cells.clear();
    CHECK_THROWS_WITH_AS(write_frame(folder.path() / "frame.exr", without_costs, all_aovs), doctest::Contains("cells"),
                         std::invalid_argument);
    CHECK(entries(folder) == 0);
}

TEST_CASE("a disk that is full is a file fault and leaves the old frame as it was")
{
    const test::TempFolder folder;
    Frame frame;
    frame.width = frame.height = 256;
    for (unsigned i = 0; i < 65536; ++i)
        frame.colour.emplace_back(static_cast<float>(i * 2654435761u) / 4294967296.0f);  // noise, hard to compress
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const std::string name : {"frame.exr", "frame.png"}) {
        CAPTURE(name);
        folder.write(name, "old");
        const rlimit small{4096, limit.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
        bool refused = false;
        try {
            write_frame(folder.path() / name, frame, {});
        } catch (const FileError&) {
            refused = true;
        }
        setrlimit(RLIMIT_FSIZE, &limit);
        CHECK(refused);
        CHECK(std::filesystem::file_size(folder.path() / name) == 3);
    }
    std::signal(SIGXFSZ, handler);
    CHECK(entries(folder) == 2);
}

TEST_CASE("pictures of one, three and four channels and of 16 bits are read as 8-bit colour")
{
    const test::TempFolder folder;
    CHECK(read_texture(folder.write("grey.pgm", "P5 2 1 255\n\x10\x20")).pixels ==
          std::vector<std::uint8_t>{16, 16, 16, 32, 32, 32});
    CHECK(read_texture(folder.write("text.ppm", "P3\n1 2\n255\n1 2 3 4 5 6\n")).pixels ==
          std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6});
    CHECK(read_texture(folder.write("deep.ppm", std::string("P6 1 1 65535\n\xff\xff\x80\x80\x00\x00", 19))).pixels ==
          std::vector<std::uint8_t>{255, 128, 0});
    const std::uint8_t clear[] = {200, 100, 50, 0};
    const auto out = OIIO::ImageOutput::create("png");
    OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    REQUIRE(out->open((folder.path() / "clear.png").string(), spec));
    REQUIRE(out->write_image(OIIO::TypeUInt8, clear));
    REQUIRE(out->close());
    CHECK(read_texture(folder.path() / "clear.png").pixels == std::vector<std::uint8_t>{200, 100, 50});
}

TEST_CASE("comments in a PPM header and bytes after the pixels do no harm")
{
    const test::TempFolder folder;
    const auto file = folder.write("odd.ppm", "P6\n# by hand\n2 # wide\n1\n#\n255\nabcdef and more");
    const Texture texture = read_texture(file);
    CHECK(texture.width == 2);
    CHECK(texture.height == 1);
    CHECK(std::string(texture.pixels.begin(), texture.pixels.end()) == "abcdef");
}

TEST_CASE("a header that promises too much is refused before its pixels are read")
{
    const test::TempFolder folder;
    const auto wide = folder.write("wide.ppm", "P6\n99999 2\n255\n");
    const auto large = folder.write("large.ppm", "P6\n16000 16000\n255\n");
    CHECK_THROWS_WITH_AS(read_texture(wide), doctest::Contains("is 99999x2 pixels, more than 16384 (limit: texture_resolution)"), LimitError);
    CHECK_THROWS_WITH_AS(read_texture(large, {.bytes = 1'000'000}), doctest::Contains("(16000x16000 pixels) brings textures to 768000000 bytes, more than 1000000 "
                                           "(limit: texture_bytes)"),
                         LimitError);
    CHECK_THROWS_WITH_AS(read_texture(large),
                         doctest::Contains("claims 16000x16000 pixels in 19 bytes, 40421052 for each, more than 2048"),
                         LimitError);
}

TEST_CASE("what is no picture is a file fault that names the file and the reason")
{
    const test::TempFolder folder;
    mkfifo((folder.path() / "pipe.ppm").c_str(), 0600);
    folder.write("short.ppm", "P6 4 4 255\nabc");
    folder.write("noise.ppm", "this is not a picture");
    folder.write("empty.ppm", "");
    std::filesystem::create_directory(folder.path() / "folder.ppm");
    for (const auto& [name, reason] : {std::pair{"none.ppm", "no such file"},
                                       {"pipe.ppm", "not a regular file"},
                                       {"folder.ppm", "not a regular file"},
                                       {"short.ppm", ""},
                                       {"noise.ppm", ""},
                                       {"empty.ppm", ""}}) {
        const auto name_now = name;  // clang 14 captures no structured bindings
        CAPTURE(name_now);
        const std::string start = "cannot read picture " + (folder.path() / name).string() + ": " + reason;
        CHECK_THROWS_WITH_AS(read_texture(folder.path() / name), doctest::Contains(start.c_str()), FileError);
    }
}

TEST_CASE("textures are found in the scene's folder and nowhere else unless that is allowed")
{
    const test::TempFolder folder;
    std::filesystem::create_directory(folder.path() / "scene");
    std::filesystem::create_directory(folder.path() / "scene-of-others");
    const std::string pixel = "P6 1 1 255\nabc";
    folder.write("scene/inside.ppm", pixel);
    folder.write("scene-of-others/outside.ppm", pixel);
    std::filesystem::create_symlink(folder.path() / "scene-of-others/outside.ppm", folder.path() / "scene/link.ppm");
    Scene scene;
    scene.folder = (folder.path() / "scene").string();
    scene.textures = {"inside.ppm", "../scene/inside.ppm"};
    CHECK(read_textures(scene).size() == 2);
    for (const std::string& name : {std::string("../scene-of-others/outside.ppm"), std::string("link.ppm"),
                                    (folder.path() / "scene-of-others/outside.ppm").string()}) {
        CAPTURE(name);
        scene.textures = {name};
        CHECK_THROWS_WITH_AS(read_textures(scene), doctest::Contains("outside the scene's folder"), FileError);
        CHECK(read_textures(scene, {.allow_outside = true}).size() == 1);
    }
}

TEST_CASE("every texture of the BART scenes is read whole")
{
    const auto robot = test::bart_file("robots/Robot.aff");
    if (!robot) return;
    const std::filesystem::path bart = robot->parent_path().parent_path();
    int read = 0;
    for (const char* scene : {"robots", "kitchen", "museum"})
        for (const auto& entry : std::filesystem::directory_iterator(bart / scene)) {
            if (entry.path().extension() != ".ppm") continue;
            CAPTURE(entry.path().string());
            const Texture texture = read_texture(entry.path());
            CHECK(texture.pixels.size() == static_cast<std::size_t>(texture.width * texture.height) * 3);
            CHECK(texture.pixels.size() + 64 > entry.file_size());  // a header, a comment and a surplus byte or two
            ++read;
        }
    CHECK(read == 65);
}

}  // namespace
}  // namespace firstray::image
