#include <firstray/engine/image/image.h>

int main()
{
    const firstray::Frame frame{.width = 1, .height = 1, .colour = {glm::vec3(1.0f)}};
    return firstray::image::png_of(frame).substr(1, 3) == "PNG" ? 0 : 1;
}
