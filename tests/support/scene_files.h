#pragma once
#include <string_view>

#include "engine/aff/reader.h"
#include "tests/support/temp_folder.h"

namespace firstray::test {

/// The scene that a text of AFF describes.
inline Scene scene_of(std::string_view text)
{
    const TempFolder folder;
    folder.write("texture.ppm", "P6 1 1 255\nabc");  // for statements that name one
    return read_aff(folder.write("main.aff", text));
}

}  // namespace firstray::test
