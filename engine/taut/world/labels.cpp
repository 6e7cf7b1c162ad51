#include "taut/world/private/labels.h"

#include <algorithm>
#include <cstdio>

#include "taut/drawing/drawing.h"

namespace taut::world {
namespace {

// In text sizes.
constexpr float lift = 0.75F;       // of the lowest line above the body
constexpr float lineHeight = 1.3F;  // distance of lines
constexpr float statusSize = 0.8F;  // of the second line
const glm::vec3 alarm(1.0F, 0.4F, 0.32F);

view::Align alignOf(Align align) {
    return align == Align::left ? view::Align::left : align == Align::right ? view::Align::right : view::Align::centre;
}

// The place above the held points, which do not swing; above all points if none is held.
glm::vec3 placeAbove(const LabelSubject& subject) {
    dvec3 low(1e300), high(-1e300);
    const std::vector<bool> isHeld = heldPointsOf(subject.island->plan());
    const auto include = [&](bool heldOnly) {
        for (int i : subject.body->pointOf) {
            if (heldOnly && !isHeld[i]) continue;
            low = glm::min(low, subject.island->position(i));
            high = glm::max(high, subject.island->position(i));
        }
    };
    include(true);
    if (low.x > high.x) include(false);
    return glm::vec3(0.5 * (low.x + high.x), high.y, 0.5 * (low.z + high.z));
}

}  // namespace

void addLabels(const LabelSpec& spec, std::span<const LabelSubject> subjects, std::vector<view::Label>& labels) {
    view::Label label;
    label.text = spec.text.value_or("");
    label.align = alignOf(spec.align);
    label.size = static_cast<float>(spec.size);
    label.colour = linearColour(spec.colour);
    label.plate = static_cast<float>(spec.plate);
    if (spec.of.empty()) {
        if (spec.at) label.at = glm::vec3(*spec.at);
        if (spec.screen) label.screen = glm::vec2(*spec.screen);
        labels.push_back(std::move(label));
        return;
    }
    for (const LabelSubject& subject : subjects) {
        const FrozenIsland* frozen = subject.island->frozen();
        label.at = placeAbove(subject);
        label.shift.y = -(lift + lineHeight * statusSize) * label.size;  // room for the second line
        const SolverSpec& solver = subject.island->plan().solver;
        if (!spec.text) label.text = methodsOf(solver).find(solver.integrator)->title;
        labels.push_back(label);
        if (frozen == nullptr) continue;
        char text[64];
        std::snprintf(text, sizeof text, "diverged at %.2f s", frozen->divergence.time);
        view::Label status = label;
        status.text = text;
        status.shift.y = -lift * label.size;
        status.size = statusSize * label.size;
        status.colour = alarm;
        labels.push_back(std::move(status));
    }
}

}  // namespace taut::world
