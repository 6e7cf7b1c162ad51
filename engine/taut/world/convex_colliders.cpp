#include "taut/world/private/convex_colliders.h"

#include <algorithm>

#include "taut/spec/private/motion.h"

namespace taut::world {
namespace {

using collision::Frame;

Frame frameOfPose(const collision::Pose& pose) {
    return {glm::mat3_cast(glm::normalize(pose.rotation)), pose.position, true};
}

}  // namespace

ShapeInMotion inMotion(ShapeInMotion shape) {
    const std::optional<core::Aabb>& local = shape.convex->bounds();
    if (!local) return shape;
    if (!shape.isStill) shape.travel = travelOf(*local, shape.from, shape.to);
    shape.box = collision::boxAt(shape.from, *local);
    shape.box.grow(shape.travel);
    return shape;
}

void ConvexColliders::add(int number, const collision::ConvexParts& parts, const collision::Pose& pose) {
    if (!parts.shapes.empty()) colliders_.push_back({number, parts, pose, pose});
}

bool ConvexColliders::isAllOf(int collider) const {
    return std::any_of(
        colliders_.begin(), colliders_.end(),
        [&](const auto& own) { return own.number == collider && own.parts.areAll; });
}

void ConvexColliders::move(std::span<const ColliderMotion> moving, double tickSeconds) {
    for (Collider& own : colliders_) {
        own.from = own.to;
        for (const ColliderMotion& motion : moving) {
            if (own.number != motion.collider) continue;
            own.from = motion.from;
            own.to = motion.to;
        }
        const bool jumps = std::any_of(own.parts.shapes.begin(), own.parts.shapes.end(), [&](const auto& part) {
            const Frame from = frameOfPose(own.from).of(part.at), to = frameOfPose(own.to).of(part.at);
            return part.shape->bounds() &&
                   travelOf(*part.shape->bounds(), from, to) > collision::fastestSurface * tickSeconds;
        });
        if (jumps) own.from = own.to;
    }
}

void ConvexColliders::addTo(std::vector<ShapeInMotion>& shapes, double from, double to) const {
    for (const Collider& own : colliders_) {
        const bool isStill = own.from.position == own.to.position && own.from.rotation == own.to.rotation;
        const Frame start = frameOfPose(between(own.from, own.to, from));
        const Frame end = isStill ? start : frameOfPose(between(own.from, own.to, to));
        for (const collision::PlacedConvex& part : own.parts.shapes)
            shapes.push_back(
                inMotion({part.shape.get(), -1, own.number, start.of(part.at), end.of(part.at), 0, 0, {}, isStill}));
    }
}

}  // namespace taut::world
