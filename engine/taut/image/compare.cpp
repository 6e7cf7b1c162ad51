#include "taut/image/private/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "taut/core/error.h"

namespace taut::image {
namespace {

struct PixelSums {
    long total = 0;               // of differences over pixels and channels
    std::array<long, 3> shift{};  // (channels) of differences with their sign
    long different = 0;           // pixels with a channel off by more than the first rule's tolerance
    long weak = 0;                // the same for the second rule
    int largest = 0;
};

PixelSums tileSums(const Image& a, const Image& b, int left, int top, const Tolerance& tolerance) {
    PixelSums sums;
    const int right = std::min(left + tileSize, a.width);
    const int bottom = std::min(top + tileSize, a.height);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const std::size_t at =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x)) * 3;
            int worst = 0;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const int shift = int{b.rgb[at + channel]} - int{a.rgb[at + channel]}, difference = std::abs(shift);
                sums.shift[channel] += shift;
                sums.total += difference;
                worst = std::max(worst, difference);
            }
            sums.different += worst > tolerance.channel ? 1 : 0;
            sums.weak += worst > tolerance.tileChannel ? 1 : 0;
            sums.largest = std::max(sums.largest, worst);
        }
    }
    return sums;
}

}  // namespace

Comparison compare(const Image& a, const Image& b, const Tolerance& tolerance) {
    TAUT_EXPECTS(a.isWhole() && b.isWhole());
    Comparison result;
    if (a.width != b.width || a.height != b.height) {
        result.sameSize = result.within = false;
        return result;
    }
    PixelSums all;
    for (int top = 0; top < a.height; top += tileSize) {
        for (int left = 0; left < a.width; left += tileSize) {
            const PixelSums sums = tileSums(a, b, left, top, tolerance);
            const int pixels = std::min(tileSize, a.width - left) * std::min(tileSize, a.height - top);
            const double share = static_cast<double>(sums.weak) / pixels;
            if (share > result.worstTileShare) {
                result.worstTileShare = share;
                result.worstTileX = left;
                result.worstTileY = top;
            }
            all.total += sums.total;
            for (std::size_t channel = 0; channel < 3; ++channel) all.shift[channel] += sums.shift[channel];
            all.different += sums.different;
            all.largest = std::max(all.largest, sums.largest);
        }
    }
    const double pixels = static_cast<double>(a.width) * a.height;
    result.share = static_cast<double>(all.different) / pixels;
    result.mean = static_cast<double>(all.total) / (3.0 * pixels);
    result.largest = all.largest;
    const long shift =
        *std::max_element(all.shift.begin(), all.shift.end(), [](long p, long q) { return std::abs(p) < std::abs(q); });
    result.offset = static_cast<double>(shift) / pixels;
    result.within = result.share <= tolerance.share && result.worstTileShare <= tolerance.tileShare &&
                    std::abs(result.offset) <= tolerance.offset;
    return result;
}

std::string describe(const Comparison& c, const Tolerance& tolerance) {
    if (!c.sameSize) return "the pictures differ in size";
    return fmt::format(
        "{:.4f} % of pixels differ by more than {} (at most {:.4g} %), of the tile at ({}, {}) {:.1f} % by more than "
        "{} "
        "(at most {:.3g} %), the mean of a channel is off by {:.4f} (at most {:.4g}), largest difference {}, mean "
        "{:.4f}",
        100.0 * c.share, tolerance.channel, 100.0 * tolerance.share, c.worstTileX, c.worstTileY,
        100.0 * c.worstTileShare, tolerance.tileChannel, 100.0 * tolerance.tileShare, c.offset, tolerance.offset,
        c.largest, c.mean);
}

Image differencePicture(const Image& a, const Image& b) {
    TAUT_EXPECTS(a.isWhole() && b.isWhole() && a.width == b.width && a.height == b.height);
    constexpr int gain = 16;
    Image picture{a.width, a.height, std::vector<std::uint8_t>(a.rgb.size())};
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const int difference = std::abs(int{a.rgb[i]} - int{b.rgb[i]});
        picture.rgb[i] = static_cast<std::uint8_t>(std::min(255, gain * difference));
    }
    return picture;
}

}  // namespace taut::image
