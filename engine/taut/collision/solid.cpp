#include "taut/collision/private/solid.h"

#include <string>

#include "taut/collision/convex.h"
#include "taut/core/error.h"

namespace taut::collision {

namespace {

[[noreturn]] void fail(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "collider " + what);
}

glm::dquat unit(const glm::dquat& q) {
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(length > 0.0) || !isFinite(length)) fail("pose: the rotation is not a quaternion of length above zero");
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}

}  // namespace

Frame frameOf(const Pose& pose) {
    if (!isFinite(pose.position)) fail("pose: the position is not finite");
    const glm::dquat q = unit(pose.rotation);
    return {glm::mat3_cast(q), pose.position, q.x != 0.0 || q.y != 0.0 || q.z != 0.0};
}

void appendSolids(const Shape& shape, const Frame& inCollider, std::vector<Solid>& solids) {
    if (shape.form != nullptr) {
        const std::optional<core::Aabb> bounds = shape.form->bounds();
        Solid& solid = solids.emplace_back();
        solid.form = shape.form;
        solid.inCollider = inCollider;
        solid.convex = shape.form->isConvex();
        solid.closed = shape.form->closed();
        solid.feet = shape.form->feet();
        solid.bounded = bounds.has_value();
        if (bounds) solid.localBounds = *bounds;
        return;
    }
    if (shape.parts.empty()) fail("compound: has no parts");
    for (const Shape::Part& part : shape.parts) appendSolids(part.shape, inCollider.of(frameOf(part.pose)), solids);
}

ConvexParts convexOf(const Shape& shape) {
    ConvexParts all;
    if (shape.convex != nullptr) all.shapes.push_back({shape.convex, {}});
    all.areAll = shape.convex != nullptr || !shape.parts.empty();
    for (const Shape::Part& part : shape.parts) {
        const Frame at = frameOf(part.pose);
        const ConvexParts own = convexOf(part.shape);
        all.areAll = all.areAll && own.areAll;
        for (const PlacedConvex& one : own.shapes) all.shapes.push_back({one.shape, at.of(one.at)});
    }
    return all;
}

std::vector<Outline> outlinesOf(const Shape& shape) {
    std::vector<Solid> solids;
    appendSolids(shape, Frame{}, solids);
    std::vector<Outline> outlines;
    for (const Solid& solid : solids) {
        Outline outline = solid.form->outline();
        outline.isConvex = solid.form->isConvex();
        if (outline.corners.empty()) continue;
        for (dvec3& vertex : outline.vertices) vertex = solid.inCollider.toWorld(vertex);
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

void place(Solid& solid, const Pose& from, const Pose& to) {
    solid.from = frameOf(from).of(solid.inCollider);
    solid.to = frameOf(to).of(solid.inCollider);
    solid.still = from.position == to.position && from.rotation == to.rotation;
    if (solid.still) solid.to = solid.from;

    // A quaternion and its opposite are the same rotation; the nearer one turns the short way. The rotations in between
    // are normalised mixes, in pieces of less than about 25 degrees. In each piece a path is nearly straight.
    const glm::dquat a = unit(from.rotation);
    glm::dquat b = unit(to.rotation);
    double match = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
    if (match < 0.0) {
        b = -b;
        match = -match;
    }
    const double halfSine = match < 1.0 ? std::sqrt(1.0 - match * match) : 0.0;  // of half the angle
    const int pieces = 1 + static_cast<int>(halfSine / 0.2);
    solid.turn.resize(pieces - 1);
    for (int i = 1; i < pieces; ++i) {
        const double t = static_cast<double>(i) / pieces;
        const glm::dquat mix(a.w + t * (b.w - a.w), a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                             a.z + t * (b.z - a.z));
        const dvec3 position = from.position + t * (to.position - from.position);
        solid.turn[i - 1] = frameOf({position, mix}).of(solid.inCollider);
    }

    // The half-space of a plane, or the box of the whole step.
    if (!solid.bounded) {
        solid.above.normal = solid.to.directionToWorld(solid.form->nearest(dvec3(0.0)).normal);
        solid.above.offset = glm::dot(solid.above.normal, solid.to.position);
        return;
    }
    solid.bounds = boxAt(solid.from, solid.localBounds);
    const auto include = [&](const Frame& frame) {
        const core::Aabb box = boxAt(frame, solid.localBounds);
        solid.bounds.add(box.low);
        solid.bounds.add(box.high);
    };
    for (const Frame& frame : solid.turn) include(frame);
    include(solid.to);
    // A corner's arc leaves the boxes at the ends of its chord by chord / 2 · tan(angle / 4). This is less than a tenth
    // of the chord.
    if (halfSine > 0.0) solid.bounds.grow(0.1 * travelOf(solid));
}

double travelOf(const Solid& solid) {
    return travelOf(solid.bounded ? solid.localBounds : core::Aabb{dvec3(-1.0), dvec3(1.0)}, solid.from, solid.to);
}

}  // namespace taut::collision
