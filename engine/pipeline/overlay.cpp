#include "taut/pipeline/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "taut/pipeline/energy_graph.h"

namespace taut::pipeline {
namespace {

constexpr Ink plateInk{10, 12, 16}, nameInk{176, 184, 196}, valueInk{240, 243, 247};
constexpr float plateStrength = 0.84F;

// Lengths in sizes of the type.
constexpr float panelWidth = 19.5F, edge = 0.8F, margin = 0.8F, lineHeight = 1.4F, graphHeight = 5.2F;
constexpr float largestPart = 0.6F;  // of a picture's height that figures and graph may take

std::string milliseconds(double seconds) {
    return fmt::format("{:.3g} ms", 1e3 * seconds);
}

std::string stepText(const StepFacts& step) {
    if (!(step.limit < 1e6)) return milliseconds(step.step) + ", no limit";
    return fmt::format("{:.3g}, limit {:.3g} ms", 1e3 * step.step, 1e3 * step.limit);
}

}  // namespace

StepFacts smallestStep(const world::World& world) {
    StepFacts facts{world.tickSeconds(), std::numeric_limits<double>::infinity(), !world.contact().bodies.empty()};
    for (const world::IslandInfo& island : world.islands()) {
        if (island.step > facts.step) continue;
        facts.step = island.step;
        if (island.stepLimit > 0.0) facts.limit = island.stepLimit;
    }
    return facts;
}

float typeSize(int pictureHeight) {
    const auto height = static_cast<float>(pictureHeight);
    return std::max(0.02F * height, std::clamp(height / 30.0F, 8.0F, 11.0F));
}

Overlay::Overlay(const std::filesystem::path& font, const StepFacts& step)
    : letters_(render::Font(font)), step_(step) {}

void Overlay::add(const Moment& moment) {
    const std::lock_guard lock(mutex_);
    moments_.push_back(moment);
}

void Overlay::paint(image::Image& picture, double time, std::span<const OverlayLine> above) {
    std::vector<Moment> shown;
    {
        const std::lock_guard lock(mutex_);
        // One moment before the span stays: the curves come in from the edge.
        while (moments_.size() > 1 && moments_[1].time < time - span) moments_.pop_front();
        for (const Moment& moment : moments_)
            if (moment.time <= time + 1e-9) shown.push_back(moment);
    }
    if (shown.empty()) return;
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
    const float em = typeSize(picture.height);
    const float textHeight = 2.0F * edge + static_cast<float>(lines.size() + 2) * lineHeight + 0.3F;
    const bool hasGraph = (textHeight + graphHeight) * em < largestPart * size.y;
    const float height = textHeight + (hasGraph ? graphHeight : 0.0F);
    float inside = std::max((panelWidth - 2.0F * edge) * em, legendWidth(painting, em, shown));
    for (const auto& [name, value] : lines) inside = std::max(inside, painting.pairWidth(name, value, em));
    const float width = std::min(inside + 2.0F * edge * em, size.x - 2.0F * margin * em);

    const glm::vec2 corner = glm::round(glm::vec2(margin * em));
    const Box panel{corner, glm::round(corner + glm::vec2(width, height * em))};
    painting.plate(panel, 0.5F * em, plateInk, plateStrength);
    const float left = panel.low.x + edge * em, right = panel.high.x - edge * em;
    float y = panel.low.y + (edge + 0.85F) * em;
    for (const auto& [name, value] : lines) {
        painting.pair(left, right, y, name, nameInk, value, valueInk, em);
        y += lineHeight * em;
    }
    const float top = y - (hasGraph ? 0.5F : 0.8F) * em;
    const Box graph{{left, top}, {right, hasGraph ? top + graphHeight * em : top}};
    paintEnergies(painting, graph, em, shown, now.time);
}

}  // namespace taut::pipeline
