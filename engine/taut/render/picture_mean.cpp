#include "taut/render/private/picture_mean.h"

#include <algorithm>
#include <cstddef>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/image/private/srgb_curve.h"

namespace taut::render {

namespace {

constexpr std::size_t pixelsATask = 1 << 14;

const image::SrgbCurve& curve() {
    static const image::SrgbCurve made;
    return made;
}

// Calls work(first, last) for all pixels.
template <class Work>
void eachRange(std::size_t pixels, Work&& work) {
    const int tasks = static_cast<int>((pixels + pixelsATask - 1) / pixelsATask);
    core::parallelFor(tasks, [&](int task) {
        const std::size_t first = static_cast<std::size_t>(task) * pixelsATask;
        work(first, std::min(first + pixelsATask, pixels));
    });
}

}  // namespace

void PictureMean::add(const Drawn& drawn) {
    const std::size_t pixels = drawn.colours.size();
    if (count_++ == 0) {
        sums_.assign(3 * pixels, 0.0F);
        cover_.assign(drawn.alpha.size(), 0.0F);
    }
    TAUT_EXPECTS(sums_.size() == 3 * pixels && cover_.size() == drawn.alpha.size());
    eachRange(pixels, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t colour = drawn.colours[i];
            const float cover = cover_.empty() ? 1.0F : static_cast<float>(drawn.alpha[i]) / 255.0F;
            if (!cover_.empty()) cover_[i] += cover;
            for (std::size_t c = 0; c < 3; ++c)
                sums_[3 * i + c] += cover * curve().light(static_cast<std::uint8_t>(colour >> (8 * c)));
        }
    });
}

Drawn PictureMean::mean() const {
    TAUT_EXPECTS(count_ > 0);
    Drawn drawn{std::vector<std::uint32_t>(sums_.size() / 3), std::vector<std::uint8_t>(cover_.size())};
    eachRange(drawn.colours.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            float share = 1.0F / static_cast<float>(count_);
            if (!cover_.empty()) {
                drawn.alpha[i] = static_cast<std::uint8_t>(255.0F * share * cover_[i] + 0.5F);
                share = cover_[i] > 0.0F ? 1.0F / cover_[i] : 0.0F;
            }
            std::uint32_t colour = 0xff000000U;
            for (std::size_t c = 0; c < 3; ++c)
                colour |= static_cast<std::uint32_t>(curve().byte(share * sums_[3 * i + c])) << (8 * c);
            drawn.colours[i] = colour;
        }
    });
    return drawn;
}

}  // namespace taut::render
