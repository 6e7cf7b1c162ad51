#include "taut/image/resize.h"

#include <new>

#include "taut/core/error.h"

#define STB_IMAGE_RESIZE_STATIC
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>

namespace taut::image {

Image resized(const Image& image, int width, int height) {
    TAUT_EXPECTS(image.isWhole() && width > 0 && height > 0);
    constexpr int channels = 3;
    Image result{width, height, {}};
    result.rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels);
    if (stbir_resize_uint8_srgb(image.rgb.data(), image.width, image.height, 0, result.rgb.data(), width, height, 0,
                                channels, STBIR_ALPHA_CHANNEL_NONE, 0) == 0)
        throw std::bad_alloc();
    return result;
}

}  // namespace taut::image
