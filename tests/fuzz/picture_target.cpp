#include <new>

#include "engine/core/errors.h"
#include "engine/image/image.h"
#include "tests/fuzz/targets.h"
#include "tests/support/temp_folder.h"

namespace firstray::fuzz {

/// The first byte chooses whether the name says TGA, which has no other mark.
void picture(Bytes input)
{
    static const test::TempFolder folder;
    Taking in(input);
    const std::string name = in.below(8) == 0 ? "picture.tga" : "picture.ppm";
    const std::string_view content(reinterpret_cast<const char*>(in.rest().data()), in.rest().size());
    const image::ImageLimits limits{.resolution = 256, .bytes = 1 << 16, .ratio = 2048};
    try {
        const Texture texture = image::read_texture(folder.write(name, content), limits);
        const auto pixels = static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
        if (pixels == 0 || texture.pixels.size() != 3 * pixels) throw Finding("a texture of the wrong size");
        if (texture.pixels.size() > limits.bytes) throw Finding("a texture beyond the limit");
    } catch (const FileError&) {
    } catch (const LimitError&) {
    } catch (const std::bad_alloc&) {  // a decoder that reads lengths below zero: exit code 5
    }
}

}  // namespace firstray::fuzz
