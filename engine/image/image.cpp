#include "engine/image/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "engine/core/errors.h"
#include "engine/core/pending_file.h"

namespace firstray::inline v0::image {
namespace {

namespace fs = std::filesystem;
using Attributes = std::span<const std::pair<std::string, std::string>>;

[[noreturn]] void cannot_write(const fs::path& file, const std::string& reason)
{
    throw FileError("cannot write " + file.string() + ": " + reason);
}

/// Every layer is 32 bits wide, float or uint32, so a pixel is a row of words whatever its channels are.
struct Packed {
    OIIO::ImageSpec spec;
    std::vector<std::uint32_t> words;  ///< spec.nchannels per pixel
};

template <typename T>
void pack(std::span<const T> layer, std::size_t channel, Packed& packed)
{
    const auto channels = static_cast<std::size_t>(packed.spec.nchannels);
    if (layer.size() * channels != packed.words.size())
        throw std::invalid_argument("write_frame: the frame has no layer " + packed.spec.channelnames[channel]);
    for (std::size_t i = 0; i < layer.size(); ++i)
        packed.words[i * channels + channel] = std::bit_cast<std::uint32_t>(layer[i]);
}

const char* name_of(Aov aov)
{
    switch (aov) {
        case Aov::distance:
            return "distance";
        case Aov::primitive:
            return "primitive";
        case Aov::group:
            return "group";
        case Aov::cells:
            return "cells";
        case Aov::tests:
            return "tests";
        case Aov::time:
            return "time";
        case Aov::age:
            return "age";
    }
    throw std::invalid_argument("write_frame: no such layer");
}

bool is_float(Aov aov)
{
    return aov == Aov::distance || aov == Aov::time;
}

void pack(const Frame& frame, Aov aov, std::size_t channel, Packed& packed)
{
    switch (aov) {
        case Aov::distance:
            return pack<float>(frame.distance, channel, packed);
        case Aov::primitive:
            return pack<std::uint32_t>(frame.primitive, channel, packed);
        case Aov::group:
            return pack<std::uint32_t>(frame.group, channel, packed);
        case Aov::cells:
            return pack<std::uint32_t>(frame.cells, channel, packed);
        case Aov::tests:
            return pack<std::uint32_t>(frame.tests, channel, packed);
        case Aov::time:
            return pack<float>(frame.nanoseconds, channel, packed);
        case Aov::age:
            return pack<std::uint32_t>(frame.age, channel, packed);
    }
}

Packed pack_exr(const Frame& frame, std::span<const Aov> aovs)
{
    Packed packed;
    const std::size_t channels = 3 + aovs.size();
    packed.spec = OIIO::ImageSpec(frame.width, frame.height, static_cast<int>(channels), OIIO::TypeFloat);
    packed.spec.channelnames = {"R", "G", "B"};
    packed.spec.channelformats.assign(3, OIIO::TypeFloat);
    for (const Aov aov : aovs) {
        packed.spec.channelnames.emplace_back(name_of(aov));
        packed.spec.channelformats.push_back(is_float(aov) ? OIIO::TypeFloat : OIIO::TypeUInt32);
    }
    packed.words.resize(frame.pixel_count() * channels);
    for (std::size_t i = 0; i < frame.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c)
            packed.words[i * channels + static_cast<std::size_t>(c)] = std::bit_cast<std::uint32_t>(frame.colour[i][c]);
    for (std::size_t a = 0; a < aovs.size(); ++a) pack(frame, aovs[a], 3 + a, packed);
    return packed;
}

std::vector<std::uint8_t> pack_png(const Frame& frame)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * frame.pixel_count());
    for (const glm::vec3& colour : frame.colour)
        for (int c = 0; c < 3; ++c)
            bytes.push_back(static_cast<std::uint8_t>(std::fmin(std::fmax(colour[c], 0.0f), 1.0f) * 255.0f + 0.5f));
    return bytes;
}

/// Encodes in memory: the encoders themselves report success when a disk is full.
/// file    for messages
/// format  of `pixels`; unknown: each channel has its own
std::string encode(const fs::path& file, const char* format_name, OIIO::ImageSpec spec, Attributes attributes,
                   OIIO::TypeDesc format, const void* pixels)
{
    for (const auto& [name, value] : attributes) spec.attribute(name, value);
    const auto out = OIIO::ImageOutput::create(format_name);
    if (!out) cannot_write(file, OIIO::geterror());
    OIIO::Filesystem::IOVecOutput encoded;
    out->set_ioproxy(&encoded);
    const bool written = out->open(file.string(), spec) && out->write_image(format, pixels);
    if (!out->close() || !written) cannot_write(file, out->geterror());
    const auto& bytes = encoded.buffer();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string encode_png(const fs::path& file, const Frame& frame, Attributes attributes)
{
    const std::vector<std::uint8_t> bytes = pack_png(frame);
    return encode(file, "png", OIIO::ImageSpec(frame.width, frame.height, 3, OIIO::TypeUInt8), attributes,
                  OIIO::TypeUInt8, bytes.data());
}

void check_picture(const Frame& frame)
{
    if (frame.pixel_count() == 0 || frame.colour.size() != frame.pixel_count())
        throw std::invalid_argument("the frame has no picture");
}

}  // namespace

std::string png_of(const Frame& frame)
{
    check_picture(frame);
    return encode_png("in memory.png", frame, {});
}

bool is_whole_frame(const fs::path& file, Attributes attributes)
{
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    const auto in = OIIO::ImageInput::open(file.string());
    if (!in) {
        OIIO::geterror();  // else it would be told of later, and elsewhere
        return false;
    }
    const OIIO::ImageSpec spec = in->spec();
    for (const auto& [name, value] : attributes)
        if (spec.get_string_attribute(name) != value) return false;
    std::vector<std::byte> pixels(spec.image_bytes(true));
    return in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUnknown, pixels.data());
}

void write_frame(const fs::path& file, const Frame& frame, std::span<const Aov> aovs, Attributes attributes)
{
    check_picture(frame);
    if (file.extension() == ".exr") {
        Packed packed = pack_exr(frame, aovs);
        packed.spec.attribute("DateTime", "1970:01:01 00:00:00");  // else it is now: no two runs would be the same
        // An unknown format says that each channel comes in its own.
        write_whole_file(file,
                         encode(file, "openexr", packed.spec, attributes, OIIO::TypeUnknown, packed.words.data()));
    } else if (file.extension() == ".png") {
        if (!aovs.empty()) cannot_write(file, "PNG holds colour alone, write .exr for the layers asked for");
        write_whole_file(file, encode_png(file, frame, attributes));
    } else {
        cannot_write(file, "the name must end in .exr or .png");
    }
}

}  // namespace firstray::inline v0::image
