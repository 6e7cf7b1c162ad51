#include "taut/scene/private/suspicions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/scene/private/fabrics.h"
#include "taut/spec/ticks.h"

namespace taut::scene {

namespace {

bool usesMaterial(const world::SceneSpec& spec, const std::string& name) {
    return std::any_of(
        spec.bodies.begin(), spec.bodies.end(),
        [&](const world::BodySpec& body) { return body.materialName() == name; });
}

// Moments are rounded to the nearest tick, which is visible where that is half a frame away. One warning for all.
void warnOfMoments(const ReadScene& scene, Problems& problems) {
    const world::Ticks ticks(scene.spec.run);
    const NameReference* first = nullptr;
    std::size_t others = 0;
    for (const NameReference& reference : scene.references) {
        if (reference.role != Role::time) continue;
        const double tick = reference.time * ticks.perSecond;
        if (std::abs(tick - std::round(tick)) < 0.5 * ticks.perFrame - 0.01) continue;
        if (first == nullptr)
            first = &reference;
        else
            ++others;
    }
    if (first == nullptr) return;
    problems.addWarning(
        first->place,
        fmt::format("{} s is midway between frames of 1/{:.6g} s: {:.9g} s is taken{}", first->time, scene.spec.run.fps,
                    ticks.secondsOf(ticks.at(first->time)),
                    others == 0 ? "" : fmt::format("; so {} {} more", others == 1 ? "is" : "are", others)));
}

}  // namespace

void reportSuspicions(const ReadScene& scene, Problems& problems) {
    const world::SceneSpec& spec = scene.spec;
    warnOfMoments(scene, problems);
    for (const auto& entry : spec.materials) {
        const std::string& name = entry.first;
        const bool isUsed = usesMaterial(spec, name);
        if (isUsed || isFabric(name)) continue;  // a fabric may only serve as `like` of another
        problems.addWarning(scene.owners.at("material." + name), fmt::format("no cloth is made of {}", name));
    }
    if (spec.bodies.empty())
        problems.addWarning({0, 1, 1}, "there is nothing to move: the scene has no cloth, rope, block or net");
}

}  // namespace taut::scene
