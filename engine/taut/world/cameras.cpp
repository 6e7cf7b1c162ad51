#include "taut/world/private/cameras.h"

#include "taut/spec/private/motion.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

std::optional<dvec3> middleOf(const std::vector<Body*>& bodies) {
    dvec3 sum(0.0);
    std::size_t count = 0;
    for (const Body* body : bodies) {
        const Island& island = islandOf(*body);
        for (const int i : body->pointOf) sum += island.position(i);
        count += body->pointOf.size();
    }
    if (count == 0) return std::nullopt;
    return sum / static_cast<double>(count);
}

}  // namespace

view::Camera cameraOf(const CameraPart& part, double time, double ahead) {
    view::Camera camera = cameraAt(part.spec, time);
    if (!part.followedFrom) return camera;
    const glm::vec3 moved(part.moved + ahead * part.movingAt);
    camera.eye += moved;
    camera.target += moved;
    return camera;
}

// The lag is that of a first-order filter, by implicit Euler steps: stable for every lag, and without one exact.
void followBodies(WorldImpl& w) {
    const double tick = 1.0 / w.ticksPerSecond;
    w.registry.each<CameraPart>([&](ecs::Entity, CameraPart& part) {
        if (part.spec.follow.empty()) return;
        const std::optional<dvec3> middle = middleOf(matchBodies(bodiesOf(w), part.spec.follow));
        if (!part.followedFrom) part.followedFrom = middle;
        if (!middle) return;
        part.movingAt = (*middle - *part.followedFrom - part.moved) / (part.spec.followLag + tick);
        part.moved += tick * part.movingAt;
    });
}

bool followsAny(const WorldImpl& w) {
    bool follows = false;
    w.registry.each<CameraPart>([&](ecs::Entity, const CameraPart& part) { follows |= !part.spec.follow.empty(); });
    return follows;
}

}  // namespace taut::world
