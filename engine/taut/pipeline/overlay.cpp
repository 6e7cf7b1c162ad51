#include "taut/pipeline/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "taut/pipeline/energy_graph.h"
#include "taut/world/world.h"

namespace taut::pipeline {
namespace {

constexpr Ink plateInk{10, 12, 16}, nameInk{176, 184, 196}, valueInk{240, 243, 247};
constexpr float plateStrength = 0.84F;

// Lengths in sizes of the type.
constexpr float panelWidth = 19.5F, edge = 0.8F, margin = 0.8F, lineHeight = 1.4F, graphHeight = 5.2F;
constexpr float largestPart = 0.6F;  // of a picture's height that figures and graph may take

// The picture under a box before it was painted over.
class Behind {
  public:
    Behind(const image::Image& picture, const PictureBox& box) {
        const glm::ivec2 size(picture.width, picture.height);
        low_ = glm::clamp(glm::ivec2(glm::floor(box.low)) - 1, glm::ivec2(0), size);
        high_ = glm::clamp(glm::ivec2(glm::ceil(box.high)) + 1, low_, size);
        for (int y = low_.y; y < high_.y; ++y) {
            const std::uint8_t* row = picture.rgb.data() + placeOf(picture, y);
            bytes_.insert(bytes_.end(), row, row + 3 * static_cast<std::ptrdiff_t>(high_.x - low_.x));
        }
    }

    // `opacity` of the present painting.
    void shineThrough(image::Image& picture, float opacity) const {
        std::size_t i = 0;
        for (int y = low_.y; y < high_.y; ++y) {
            std::uint8_t* row = picture.rgb.data() + placeOf(picture, y);
            for (int x = 0; x < 3 * (high_.x - low_.x); ++x, ++i) {
                const auto old = static_cast<float>(bytes_[i]);
                row[x] = static_cast<std::uint8_t>(old + opacity * (static_cast<float>(row[x]) - old) + 0.5F);
            }
        }
    }

  private:
    std::ptrdiff_t placeOf(const image::Image& picture, int y) const {
        return 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + low_.x);
    }

    glm::ivec2 low_{0}, high_{0};
    std::vector<std::uint8_t> bytes_;
};

std::string milliseconds(double seconds) {
    return fmt::format("{:.3g} ms", 1e3 * seconds);
}

}  // namespace

std::string stepText(const SmallestStep& step) {
    if (step.followsState) return milliseconds(step.step);
    if (!(step.limit < 1e6)) return milliseconds(step.step) + ", no limit";
    return fmt::format("{:.3g}, limit {:.3g} ms", 1e3 * step.step, 1e3 * step.limit);
}

SmallestStep smallestStep(const world::World& world) {
    SmallestStep facts{world.tickSeconds(), std::numeric_limits<double>::infinity(), !world.contact().bodies.empty()};
    for (const world::IslandInfo& island : world.islands()) {
        if (island.step > facts.step) continue;
        facts.step = island.step;
        if (island.stepLimit > 0.0) facts.limit = island.stepLimit;
        facts.followsState = island.followsState;
    }
    return facts;
}

float typeSize(int pictureHeight, float density) {
    const float height = static_cast<float>(pictureHeight) / density;
    return density * std::max(0.02F * height, std::clamp(height / 30.0F, 8.0F, 11.0F));
}

Overlay::Overlay(const std::filesystem::path& font, const SmallestStep& step)
    : letters_(render::Font(font)), step_(step) {}

void Overlay::add(const Moment& moment) {
    const std::lock_guard lock(mutex_);
    moments_.push_back(moment);
}

PictureBox Overlay::paint(image::Image& picture, double time, std::span<const OverlayLine> above,
                          const OverlayLook& look) {
    std::vector<Moment> shown;
    {
        const std::lock_guard lock(mutex_);
        // One moment before the span stays: the curves come in from the edge.
        while (moments_.size() > 1 && moments_[1].time < time - span) moments_.pop_front();
        for (const Moment& moment : moments_)
            if (moment.time <= time + 1e-9) shown.push_back(moment);
    }
    if (shown.empty()) return {};
    const Moment& now = shown.back();

    std::vector<OverlayLine> lines(above.begin(), above.end());
    lines.emplace_back(fmt::format("t {:.3f} s", now.time), fmt::format("tick {}", now.tick));
    lines.emplace_back("step h", stepText(step_));
    lines.emplace_back("largest strain", fmt::format("{:.2f} %", 100.0 * now.maxStrain));
    if (step_.bodiesTouch)
        lines.emplace_back(
            "bodies", fmt::format("{} contact{}, {} crossing{}", now.bodyContacts, now.bodyContacts == 1 ? "" : "s",
                                  now.crossings, now.crossings == 1 ? "" : "s"));

    Painting painting(picture, letters_);
    const glm::vec2 size(picture.width, picture.height);
    const float em = typeSize(picture.height, look.density);
    const float textHeight = 2.0F * edge + static_cast<float>(lines.size() + 2) * lineHeight + 0.3F;
    const bool hasGraph = (textHeight + graphHeight) * em < largestPart * size.y;
    const float height = textHeight + (hasGraph ? graphHeight : 0.0F);
    float inside = std::max((panelWidth - 2.0F * edge) * em, legendWidth(painting, em, shown));
    for (const auto& [name, value] : lines) inside = std::max(inside, painting.pairWidth(name, value, em));
    const float width = std::min(inside + 2.0F * edge * em, size.x - 2.0F * margin * em);

    const glm::vec2 corner =
        glm::round(glm::vec2(look.isAtRight ? size.x - margin * em - width : margin * em, margin * em));
    const PictureBox panel{corner, glm::round(corner + glm::vec2(width, height * em))};
    std::optional<Behind> behind;
    if (look.opacity < 1.0F) behind.emplace(picture, panel);
    painting.plate(panel, 0.5F * em, plateInk, plateStrength);
    const float left = panel.low.x + edge * em, right = panel.high.x - edge * em;
    float y = panel.low.y + (edge + 0.85F) * em;
    for (const auto& [name, value] : lines) {
        painting.pair(left, right, y, name, nameInk, value, valueInk, em);
        y += lineHeight * em;
    }
    const float top = y - (hasGraph ? 0.5F : 0.8F) * em;
    const PictureBox graph{{left, top}, {right, hasGraph ? top + graphHeight * em : top}};
    paintEnergies(painting, graph, em, shown, now.time);
    if (behind) behind->shineThrough(picture, look.opacity);
    return panel;
}

}  // namespace taut::pipeline
