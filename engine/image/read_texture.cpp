#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>

#include "engine/aff/lexer.h"
#include "engine/core/errors.h"
#include "engine/image/image.h"

namespace firstray::inline v0::image {
namespace {

namespace fs = std::filesystem;

/// A picture file on its way in. A scene file chooses it, so nothing of it is believed.
class PictureFile {
public:
    /// place  where a scene file names it, "file:line:column: ", or empty
    /// held   bytes of the textures before it
    PictureFile(fs::path file, const ImageLimits& limits, std::string place, std::uint64_t held)
        : file_(std::move(file)), limits_(limits), place_(std::move(place)), held_(held)
    {
    }

    Texture read() const;
    /// Throws unless it lies in `folder` or below, links and ".." followed.
    void check_inside(const fs::path& folder) const;

private:
    [[noreturn]] void cannot_read(const std::string& reason) const
    {
        throw FileError(place_ + "cannot read picture " + printable(file_.string()) + ": " + reason);
    }
    /// What a decoder says, on one line; some say nothing.
    [[noreturn]] void cannot_decode(std::string reason) const
    {
        while (!reason.empty() && reason.back() == '\n') reason.pop_back();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        cannot_read(reason.empty() ? "it ends early or makes no sense" : reason);
    }
    [[noreturn]] void over_limit(const std::string& has, std::uint64_t limit, const char* name) const
    {
        throw LimitError(
            place_ + "picture " + printable(file_.string()) + " " + has + ", more than " + std::to_string(limit), name);
    }
    void check_regular() const;
    std::string content() const;
    const char* format(std::string_view begin) const;
    void check_header(const OIIO::ImageSpec& spec, std::uint64_t in_file) const;
    Texture decode() const;

    fs::path file_;
    const ImageLimits& limits_;
    std::string place_;
    std::uint64_t held_;
};

/// Files alone: opening a pipe would wait, a device may never end.
void PictureFile::check_regular() const
{
    std::error_code error;
    const fs::file_status status = fs::status(file_, error);
    if (status.type() == fs::file_type::not_found) cannot_read("no such file");
    if (error) cannot_read(error.message());
    if (!fs::is_regular_file(status)) cannot_read("not a regular file");
}

void PictureFile::check_inside(const fs::path& folder) const
{
    check_regular();
    std::error_code error;
    const fs::path outer = fs::canonical(folder, error), inner = fs::canonical(file_, error);
    if (error || std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first != outer.end())
        cannot_read("it lies outside the scene's folder, which was not allowed");
}

/// The whole file: decoders get bytes, so that none opens anything by a name.
std::string PictureFile::content() const
{
    errno = 0;
    std::ifstream in(file_, std::ios::binary | std::ios::ate);
    const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
    if (size < 0) cannot_read(std::generic_category().message(errno != 0 ? errno : EIO));
    const std::uint64_t most = 4 * limits_.bytes + 4096;  // pictures written as text are larger than what they say
    if (static_cast<std::uint64_t>(size) > most)
        over_limit("has " + std::to_string(size) + " bytes", most, "texture_bytes");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    in.seekg(0).read(bytes.data(), size);
    if (!in) cannot_read(std::generic_category().message(errno != 0 ? errno : EIO));
    return bytes;
}

/// The reader to use, by the file's first bytes. OpenImageIO alone would try all it has, by the name's ending and then
/// one after the other: some 30 formats, films and documents among them.
const char* PictureFile::format(std::string_view begin) const
{
    struct Magic {
        std::string_view bytes;
        const char* format;
    };
    using namespace std::string_view_literals;
    static constexpr Magic known[] = {
        {"P1"sv, "pnm"},     {"P2"sv, "pnm"},     {"P3"sv, "pnm"},      {"P4"sv, "pnm"},
        {"P5"sv, "pnm"},     {"P6"sv, "pnm"},     {"\x89PNG"sv, "png"}, {"\xff\xd8\xff"sv, "jpeg"},
        {"II*\0"sv, "tiff"}, {"MM\0*"sv, "tiff"}, {"BM"sv, "bmp"},      {"\x76\x2f\x31\x01"sv, "openexr"},
    };
    for (const Magic& magic : known)
        if (begin.starts_with(magic.bytes)) return magic.format;
    if (file_.extension() == ".tga") return "targa";  // which has no magic bytes
    cannot_read("not of a kind that is read (PNM, PNG, JPEG, TIFF, TGA, BMP, OpenEXR)");
}

void PictureFile::check_header(const OIIO::ImageSpec& spec, std::uint64_t in_file) const
{
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep) cannot_read("not a flat picture");
    if (spec.nchannels < 1 || spec.nchannels > 4)
        cannot_read(std::to_string(spec.nchannels) + " channels, expected 1 to 4");
    const auto width = static_cast<std::uint64_t>(spec.width), height = static_cast<std::uint64_t>(spec.height);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (std::max(width, height) > limits_.resolution)
        over_limit("is " + size + " pixels", limits_.resolution, "texture_resolution");
    // 4 channels are read before the fourth is dropped
    const std::uint64_t bytes = width * height * static_cast<std::uint64_t>(std::max(spec.nchannels, 3));
    if (held_ + bytes > limits_.bytes)
        over_limit("(" + size + " pixels) brings textures to " + std::to_string(held_ + bytes) + " bytes",
                   limits_.bytes, "texture_bytes");
    const std::uint64_t ratio = bytes / std::max<std::uint64_t>(in_file, 1);
    if (ratio > limits_.ratio)
        over_limit("claims " + size + " pixels in " + std::to_string(in_file) + " bytes, " + std::to_string(ratio) +
                       " for each",
                   limits_.ratio, "texture_ratio");
    // Decoders take memory for whole strips and tiles, whatever the picture's size.
    const auto rows = static_cast<std::uint64_t>(std::max(spec.get_int_attribute("tiff:RowsPerStrip"), 0));
    const std::uint64_t piece = std::max<std::uint64_t>(rows * spec.scanline_bytes(true), spec.tile_bytes(true));
    if (piece / std::max<std::uint64_t>(in_file, 1) > limits_.ratio)
        over_limit("claims pieces of " + std::to_string(piece) + " bytes in " + std::to_string(in_file) + " bytes",
                   limits_.ratio, "texture_ratio");
}

/// Grey, grey with alpha or colour with alpha, as colour alone.
std::vector<std::uint8_t> to_rgb(const std::vector<std::uint8_t>& pixels, std::size_t channels)
{
    const std::size_t count = pixels.size() / channels;
    std::vector<std::uint8_t> rgb(3 * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = pixels[channels * i + (channels < 3 ? 0 : c)];
    return rgb;
}

Texture PictureFile::read() const
{
    check_regular();
    try {
        return decode();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {  // of a decoder that the file has confused
        cannot_decode(error.what());
    }
}

Texture PictureFile::decode() const
{
    OIIO::ImageSpec spec, wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);  // else colour comes multiplied by the alpha that is dropped here
    const std::string bytes = content();
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto in = OIIO::ImageInput::create(format(bytes));
    if (!in) cannot_read(OIIO::geterror());
    if (!in->set_ioproxy(&memory)) cannot_read("its decoder wants to open files by itself");
    if (!in->open(file_.string(), spec, wishes)) cannot_decode(in->geterror());
    check_header(spec, bytes.size());

    Texture texture{spec.width, spec.height, {}};
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    texture.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * channels);
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt8, texture.pixels.data())) cannot_decode(in->geterror());
    if (channels != 3) texture.pixels = to_rgb(texture.pixels, channels);
    return texture;
}

}  // namespace

Texture read_texture(const fs::path& file, const ImageLimits& limits)
{
    return PictureFile(file, limits, {}, 0).read();
}

std::vector<Texture> read_textures(const Scene& scene, const ImageLimits& limits)
{
    const fs::path folder = scene.folder.empty() ? fs::path(".") : fs::path(scene.folder);
    std::vector<Texture> textures;
    textures.reserve(scene.textures.size());
    std::uint64_t held = 0;
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const std::string place = scene.texture_places.empty() ? std::string() : scene.texture_places[i];
        const PictureFile picture(folder / scene.textures[i], limits, place, held);
        if (!limits.allow_outside) picture.check_inside(folder);
        textures.push_back(picture.read());
        held += textures.back().pixels.size();
    }
    return textures;
}

}  // namespace firstray::inline v0::image
