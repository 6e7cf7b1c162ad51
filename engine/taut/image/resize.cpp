#include "taut/image/private/resize.h"

#include <algorithm>
#include <new>
#include <vector>

#include "taut/core/error.h"

#define STB_IMAGE_RESIZE_STATIC
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>

namespace taut::image {

namespace {

// Between which two of `from` pixels each of `to` lies, and how far, in 1/256.
struct Between {
    std::size_t first, second;
    unsigned share;
};

std::vector<Between> placesOf(int from, int to) {
    std::vector<Between> places;
    for (int i = 0; i < to; ++i) {
        const double at = std::clamp((i + 0.5) * from / to - 0.5, 0.0, from - 1.0);
        const auto first = static_cast<std::size_t>(at);
        places.push_back({first, std::min(first + 1, static_cast<std::size_t>(from) - 1),
                          static_cast<unsigned>(256.0 * (at - static_cast<double>(first)) + 0.5)});
    }
    return places;
}

}  // namespace

Image enlarged(const Image& image, int width, int height) {
    TAUT_EXPECTS(image.isWhole() && width >= image.width && height >= image.height);
    Image result{width, height, {}};
    const std::size_t row = 3 * static_cast<std::size_t>(width), from = 3 * static_cast<std::size_t>(image.width);
    result.rgb.resize(row * static_cast<std::size_t>(height));
    const std::vector<Between> columns = placesOf(image.width, width), rows = placesOf(image.height, height);
    std::vector<unsigned> mixed(from);  // of two rows, in 1/256
    for (std::size_t y = 0; y < rows.size(); ++y) {
        const std::uint8_t* above = image.rgb.data() + rows[y].first * from;
        const std::uint8_t* below = image.rgb.data() + rows[y].second * from;
        const unsigned share = rows[y].share;
        for (std::size_t i = 0; i < from; ++i) mixed[i] = (256 - share) * above[i] + share * below[i];
        std::uint8_t* to = result.rgb.data() + y * row;
        for (const Between& column : columns)
            for (std::size_t c = 0; c < 3; ++c)
                *to++ = static_cast<std::uint8_t>(((256 - column.share) * mixed[3 * column.first + c] +
                                                   column.share * mixed[3 * column.second + c] + 32768) >>
                                                  16U);
    }
    return result;
}

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
