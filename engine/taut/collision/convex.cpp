#include "taut/collision/convex.h"

#include <cmath>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/convex_form.h"
#include "taut/core/trig.h"

namespace taut::collision {
namespace {

template <ClosedKind kind>
struct Formula {
    ClosedShape shape;
    core::Aabb filled;

    Nearest nearest(const dvec3& p) const {
        const ClosedDistance at = closedDistance<kind>(shape.size, p.x, p.y, p.z);
        return {at.distance, {at.x, at.y, at.z}};
    }
    core::Aabb bounds() const { return filled; }
    ClosedShape closed() const { return shape; }
};

template <ClosedKind kind>
std::shared_ptr<const Form> byFormula(const Convex& convex) {
    return std::make_shared<ConvexForm<Formula<kind>>>(Formula<kind>{convex.closed(), *convex.bounds()});
}

}  // namespace

Convex::Convex(std::unique_ptr<btConvexShape> bullet, double rounding, const dvec3& offset)
    : bullet_(std::move(bullet)), rounding_(rounding), offset_(offset) {
    core::Aabb box;
    for (int k = 0; k < 3; ++k)
        for (const double side : {-1.0, 1.0}) {
            dvec3 direction(0.0);
            direction[k] = side;
            box.add(support(direction) + rounding_ * direction);
        }
    bounds_ = box;
}

Convex::Convex(const dvec3& up) : up_(up) {}

Convex::~Convex() = default;

dvec3 Convex::support(const dvec3& direction) const {
    if (bullet_ == nullptr) return dvec3(0.0);
    return fromBullet(bullet_->localGetSupportVertexWithoutMarginNonVirtual(toBullet(direction))) + offset_;
}

std::shared_ptr<const Form> Convex::form() const {
    switch (closed().kind) {
        case ClosedKind::sphere: return byFormula<ClosedKind::sphere>(*this);
        case ClosedKind::box: return byFormula<ClosedKind::box>(*this);
        case ClosedKind::capsule: return byFormula<ClosedKind::capsule>(*this);
        case ClosedKind::cylinder: return byFormula<ClosedKind::cylinder>(*this);
        case ClosedKind::cone: return byFormula<ClosedKind::cone>(*this);
        case ClosedKind::halfSpace:
        case ClosedKind::none: break;
    }
    return nullptr;
}

dvec3 acrossAxis(const dvec3& direction) {
    constexpr double onAxis = 1e-9;
    const double across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    return across > onAxis ? dvec3(direction.x / across, 0.0, direction.z / across) : dvec3(1.0, 0.0, 0.0);
}

void addRim(double radius, double height, const dvec3& direction, bool isFromAbove, SupportingFace& face) {
    constexpr int sides = 8;
    face.isRim = true;
    const dvec3 first = acrossAxis(direction), second(first.z, 0.0, -first.x);
    for (int k = 0; k < sides; ++k) {
        const double angle = (isFromAbove ? 2.0 : -2.0) * core::pi * k / sides;
        face.add(radius * (core::cosine(angle) * first + core::sine(angle) * second) + dvec3(0.0, height, 0.0));
    }
}

}  // namespace taut::collision
