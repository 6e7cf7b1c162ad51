#include "taut/world/private/rigid_contacts.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "taut/core/private/parallel.h"

namespace taut::world {
namespace {

using collision::Frame;
using collision::Manifold;

// Of the thickness:
constexpr double nearShare = 0.05;   // nearer pairs count even if they do not approach
constexpr double metShare = 0.01;    // nearer pairs touch at the start
constexpr double foundShare = 1e-9;  // of the moment when they meet
constexpr int mostMoments = 20;      // at which it is sought
constexpr int pairsAtOnce = 32;

// Between two frames, at a share of the way. Their rotations are not far from each other.
Frame frameBetween(const Frame& from, const Frame& to, double share) {
    const glm::dquat a = glm::quat_cast(from.rotation), b = glm::quat_cast(to.rotation);
    const glm::dquat near = glm::dot(a, b) < 0 ? -b : b;
    return {glm::mat3_cast(glm::normalize(a * (1 - share) + near * share)),
            from.position + share * (to.position - from.position), true};
}

// Where a place of a body that is at one frame is when the body is at another.
dvec3 carriedBy(const Frame& from, const Frame& to, const dvec3& place) {
    return to.toWorld(from.toLocal(place));
}

}  // namespace

// Where all shapes are -> shapes_.
void RigidContacts::takeShapes(std::span<const dvec3> x0, std::span<const dvec3> x1,
                               std::span<const ShapeInMotion> colliders) {
    shapes_.clear();
    for (const Solid& own : solids_) {
        const auto at = [&](std::span<const dvec3> x) {
            std::array<dvec3, 3> now;
            for (std::size_t k = 0; k < 3; ++k) now[k] = x[own.marks.points[k]];
            return own.marks.motionTo(now).of(own.piece.at);
        };
        const auto stays = [&](int i) { return x0[i] == x1[i]; };
        const bool isStill = std::all_of(own.marks.points.begin(), own.marks.points.end(), stays);
        const Frame from = at(x0);
        shapes_.push_back(inMotion(
            {own.piece.shape.get(), own.surface, -1, from, isStill ? from : at(x1), own.thickness, 0, {}, isStill}));
    }
    shapes_.insert(shapes_.end(), colliders.begin(), colliders.end());
    for (ShapeInMotion& shape : shapes_) shape.box.grow(nearShare * shape.thickness);
}

// Shapes whose boxes overlap, a solid first -> pairs_.
void RigidContacts::findPairs(const MayTouch& mayTouch) {
    pairs_.clear();
    const auto take = [&](int a, int b) {
        const ShapeInMotion &first = shapes_[std::min(a, b)], &second = shapes_[std::max(a, b)];
        if (first.surface < 0 || !mayTouch(first.surface, second.surface, second.collider)) return;
        pairs_.push_back(std::minmax(a, b));
    };
    swept_.clear();
    core::Aabb all;
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
        if (shapes_[k].convex->isHalfSpace()) continue;
        swept_.push_back({shapes_[k].box, static_cast<int>(k)});
        all.add(shapes_[k].box.centre());
    }
    // A half-space has no box, so every other shape is a pair with it.
    for (std::size_t plane = 0; plane < shapes_.size(); ++plane)
        if (shapes_[plane].convex->isHalfSpace())
            for (const Swept& own : swept_) take(own.shape, static_cast<int>(plane));
    const dvec3 size = all.halfSize();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto overlap = [](const core::Aabb& a, const core::Aabb& b, int k) {
        return a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
    };
    std::sort(swept_.begin(), swept_.end(), [axis](const Swept& a, const Swept& b) {
        return a.box.low[axis] < b.box.low[axis] || (a.box.low[axis] == b.box.low[axis] && a.shape < b.shape);
    });
    for (auto own = swept_.begin(); own != swept_.end(); ++own) {
        const double end = own->box.high[axis];
        for (auto other = own + 1; other != swept_.end() && other->box.low[axis] <= end; ++other)
            if (overlap(own->box, other->box, (axis + 1) % 3) && overlap(own->box, other->box, (axis + 2) % 3))
                take(own->shape, other->shape);
    }
    std::sort(pairs_.begin(), pairs_.end());
}

void RigidContacts::touch(const ShapeInMotion& a, const ShapeInMotion& b, double seconds,
                          std::vector<RigidTouch>& touches) const {
    const double thickness = a.thickness + b.thickness, reach = a.travel + b.travel + nearShare * thickness;
    Manifold manifold = collision::manifoldOf(*a.convex, a.from, *b.convex, b.from, reach);
    // The moment when they meet. A gap over the speed of its closing comes not too late where shapes do not turn. The
    // normal of a half-space is the same at all times.
    double moment = 0;
    Frame atA = a.from, atB = b.from;
    for (int k = 0; k < mostMoments && manifold.count > 0 && !b.convex->isHalfSpace(); ++k) {
        const auto nearest =
            std::min_element(manifold.places().begin(), manifold.places().end(),
                             [](const Manifold::Place& p, const Manifold::Place& q) { return p.gap < q.gap; });
        if (nearest->gap <= (k == 0 ? metShare : foundShare) * thickness) break;
        const auto wayOf = [&](const ShapeInMotion& own, const Frame& at, const dvec3& place) {
            return carriedBy(at, own.to, place) - carriedBy(at, own.from, place);
        };
        const double closing = -glm::dot(manifold.normal, wayOf(a, atA, nearest->onA) - wayOf(b, atB, nearest->onB));
        if (!(nearest->gap < closing * (1 - moment))) break;
        moment += nearest->gap / closing;
        atA = frameBetween(a.from, a.to, moment);
        atB = frameBetween(b.from, b.to, moment);
        manifold = collision::manifoldOf(*a.convex, atA, *b.convex, atB, reach);
    }
    int number = 0;
    for (const Manifold::Place& place : manifold.places()) {
        const dvec3 onA = carriedBy(atA, a.from, place.onA), onB = carriedBy(atB, b.from, place.onB);
        const dvec3 wayOfB = carriedBy(atB, b.to, place.onB) - onB;
        RigidTouch touch{a.surface,
                         b.surface,
                         b.collider,
                         static_cast<int>(&a - shapes_.data()),
                         static_cast<int>(&b - shapes_.data()),
                         number++,
                         manifold.normal,
                         onA,
                         onB,
                         0,
                         thickness,
                         wayOfB / seconds,
                         collision::spinBetween(b.from, b.to, seconds)};
        touch.gap = glm::dot(manifold.normal, onA - onB);
        // One place keeps the angular momentum. A ball is pressed towards its centre, at a place of its own.
        const auto isBall = [](const ShapeInMotion& own) {
            return own.convex->closed().kind == collision::ClosedKind::sphere;
        };
        if (b.surface >= 0 && (moment == 0 || !(isBall(a) || isBall(b))))
            touch.onFirst = touch.onSecond = 0.5 * (onA + onB);
        touches.push_back(touch);
    }
}

std::span<const RigidTouch> RigidContacts::find(std::span<const dvec3> x0, std::span<const dvec3> x1, double seconds,
                                                std::span<const ShapeInMotion> colliders, const MayTouch& mayTouch) {
    takeShapes(x0, x1, colliders);
    findPairs(mayTouch);
    touches_.clear();
    const int count = static_cast<int>(pairs_.size()), tasks = (count + pairsAtOnce - 1) / pairsAtOnce;
    perTask_.resize(std::max(perTask_.size(), static_cast<std::size_t>(tasks)));
    core::parallelFor(tasks, [&](int task) {
        std::vector<RigidTouch>& own = perTask_[task];
        own.clear();
        for (int k = task * pairsAtOnce; k < std::min((task + 1) * pairsAtOnce, count); ++k) {
            const auto [a, b] = pairs_[k];
            touch(shapes_[a], shapes_[b], seconds, own);
        }
    });
    for (int task = 0; task < tasks; ++task) {
        const std::vector<RigidTouch>& own = perTask_[task];
        touches_.insert(touches_.end(), own.begin(), own.end());
    }
    return touches_;
}

}  // namespace taut::world
