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

std::string milliseconds(double seconds) {
    return fmt::format("{:.3g} ms", 1e3 * seconds);
}

std::string stepText(const StepFacts& step) {
    if (!(step.limit < 1e6)) return milliseconds(step.step) + ", no limit";
    return fmt::format("{:.3g}, limit {:.3g} ms", 1e3 * step.step, 1e3 * step.limit);
}

}  // namespace

StepFacts smallestStep(const world::World& world) {
    StepFacts facts{world.tickSeconds(), std::numeric_limits<double>::infinity()};
    for (const world::IslandInfo& island : world.islands()) {
        if (island.step > facts.step) continue;
        facts = {island.step, island.stepLimit > 0.0 ? island.stepLimit : facts.limit};
    }
    return facts;
}

float typeSize(int pictureHeight) {
    return std::max(11.0F, 0.02F * static_cast<float>(pictureHeight));
}

Overlay::Overlay(const std::filesystem::path& font, const StepFacts& step)
    : letters_(render::Font(font)), step_(step) {}

void Overlay::add(const Moment& moment) {
    const std::lock_guard lock(mutex_);
    if (!hasFirst_) firstGravitational_ = moment.gravitational;
    hasFirst_ = true;
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
        for (Moment& moment : shown) moment.gravitational -= firstGravitational_;
    }
    if (shown.empty()) return;
    const Moment& now = shown.back();

    std::vector<OverlayLine> lines(above.begin(), above.end());
    lines.emplace_back(fmt::format("t {:.3f} s", now.time), fmt::format("tick {}", now.tick));
    lines.emplace_back("step h", stepText(step_));
    lines.emplace_back("largest strain", fmt::format("{:.2f} %", 100.0 * now.maxStrain));

    const float em = typeSize(picture.height);
    const auto count = static_cast<float>(lines.size());
    const float height = (2.0F * edge + count * lineHeight + 0.3F + graphHeight + 2.0F * lineHeight) * em;
    const glm::vec2 corner = glm::round(glm::vec2(margin * em));
    const Box panel{corner, glm::round(corner + glm::vec2(panelWidth * em, height))};
    Painting painting(picture, letters_);
    painting.plate(panel, 0.5F * em, plateInk, plateStrength);

    const float left = panel.low.x + edge * em, right = panel.high.x - edge * em;
    float y = panel.low.y + (edge + 0.85F) * em;
    for (const auto& [name, value] : lines) {
        painting.text({left, y}, Side::left, name, em, nameInk);
        painting.text({right, y}, Side::right, value, em, valueInk);
        y += lineHeight * em;
    }
    const float top = y - 0.5F * em;
    paintEnergies(painting, {{left, top}, {right, top + graphHeight * em}}, em, shown, now.time);
}

}  // namespace taut::pipeline
