#include "taut/scene/suspicions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/world/ticks.h"

namespace taut::scene {

namespace {

bool usesMaterial(const world::SceneSpec& spec, const std::string& name) {
    return std::any_of(
        spec.bodies.begin(), spec.bodies.end(),
        [&](const world::BodySpec& body) { return body.materialName() == name; });
}

}  // namespace

void reportSuspicions(const ReadScene& scene, Problems& problems) {
    const world::SceneSpec& spec = scene.spec;
    const double ticks = world::Ticks(spec.run).perSecond;
    for (const Reference& reference : scene.references) {
        if (reference.role != Role::time) continue;
        const double nearest = std::round(reference.time * ticks);
        if (std::abs(reference.time * ticks - nearest) <= 0.01) continue;
        problems.addWarning(reference.place, fmt::format("{} s is not on a tick of 1/{} s: {:.9g} s is taken",
                                                         reference.time, ticks, nearest / ticks));
    }
    for (const auto& entry : spec.materials) {
        const std::string& name = entry.first;
        const bool isUsed = usesMaterial(spec, name);
        if (isUsed) continue;
        problems.addWarning(scene.owners.at("material." + name), fmt::format("no cloth is made of {}", name));
    }
    if (spec.bodies.empty())
        problems.addWarning({0, 1, 1}, "there is nothing to move: the scene has no cloth, rope, block or net");
}

}  // namespace taut::scene
