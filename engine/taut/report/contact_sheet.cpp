#include "taut/report/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/error.h"
#include "taut/image/private/resize.h"
#include "taut/image/read.h"

namespace taut::report {
namespace {

constexpr std::uint8_t background = 24;  // sRGB, nearly black

void paste(const image::Image& picture, int left, int top, image::Image& sheet) {
    for (int y = 0; y < picture.height; ++y) {
        const auto from = picture.rgb.begin() + static_cast<std::ptrdiff_t>(y) * picture.width * 3;
        std::copy_n(from, picture.width * 3,
                    sheet.rgb.begin() + (static_cast<std::ptrdiff_t>(top + y) * sheet.width + left) * 3);
    }
}

}  // namespace

std::vector<std::int64_t> evenlySpaced(const std::vector<std::int64_t>& numbers, int count) {
    TAUT_EXPECTS(count >= 1);
    const auto all = static_cast<std::int64_t>(numbers.size());
    if (all <= count) return numbers;
    if (count == 1) return {numbers.front()};
    std::vector<std::int64_t> chosen;
    for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t at = (2 * i * (all - 1) + (count - 1)) / (2 * (count - 1));  // to the nearest
        chosen.push_back(numbers[at]);
    }
    return chosen;
}

image::Image contactSheet(const image::FramePattern& pattern, const SheetLayout& layout) {
    const std::vector<std::int64_t> frames = evenlySpaced(pattern.framesThere(), layout.pictures);
    if (frames.empty())
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("no frames like {}; taut render SCENE -o {} makes some",
                                      pattern.pathOf(0).string(), pattern.folder().string()));
    const int count = static_cast<int>(frames.size());
    const int columns = std::min(layout.columns, count), rows = (count + columns - 1) / columns;
    const int width = (layout.width - (columns + 1) * layout.gap) / columns;
    if (width < 8)
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("{} columns do not fit into {} pixels", columns, layout.width));
    image::Image sheet;
    int height = 0, fullWidth = 0, fullHeight = 0;
    for (int i = 0; i < count; ++i) {
        const auto path = pattern.pathOf(frames[i]);
        const image::Image picture = image::readImage(path);
        if (i == 0) {
            fullWidth = picture.width;
            fullHeight = picture.height;
            height = std::max(1, static_cast<int>(static_cast<std::int64_t>(width) * fullHeight / fullWidth));
            sheet = {layout.width, rows * (height + layout.gap) + layout.gap, {}};
            sheet.rgb.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3,
                             background);
        }
        if (picture.width != fullWidth || picture.height != fullHeight)
            throw core::Error(core::ErrorKind::badContent,
                              fmt::format("{}: {}x{} pixels, but the first frame has {}x{}: frames of two runs?",
                                          path.string(), picture.width, picture.height, fullWidth, fullHeight));
        paste(image::resized(picture, width, height), layout.gap + i % columns * (width + layout.gap),
              layout.gap + i / columns * (height + layout.gap), sheet);
    }
    return sheet;
}

}  // namespace taut::report
