#include "taut/plan/private/rigid_constraint.h"

#include "taut/core/rigid_motion.h"
#include "taut/mechanics/rigid.h"

namespace taut::world {
namespace {

constexpr double unmovedSquare = 1e-29;  // of a coordinate squared

// Takes `to` over where points move. Returns whether any changed by more than rounding.
bool take(std::span<const dvec3> to, std::span<const double> inverseMass, std::span<dvec3> x) {
    bool changes = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(inverseMass[i] > 0)) continue;
        const dvec3 way = to[i] - x[i];
        changes = changes || glm::dot(way, way) > unmovedSquare * (1.0 + glm::dot(x[i], x[i]));
        x[i] = to[i];
    }
    return changes;
}

}  // namespace

bool RigidConstraint::projectPositions(const Moment& moment) {
    if (!(core::massesOf(moment.inverseMass, masses_) > 0)) return false;
    std::vector<dvec3> x(moment.x.begin(), moment.x.end());
    mechanics::placeRigidly(masses_, rest_, moment.from, x);
    return take(x, moment.inverseMass, moment.x);
}

bool RigidConstraint::projectVelocities(const Moment& moment) {
    if (!(core::massesOf(moment.inverseMass, masses_) > 0)) return false;
    std::vector<dvec3> v(moment.v.begin(), moment.v.end());
    mechanics::moveRigidly(masses_, moment.x, v);
    return take(v, moment.inverseMass, moment.v);
}

std::optional<core::RigidMotion> RigidConstraint::bodyAt(std::span<const dvec3> x, std::span<const dvec3> v,
                                                         std::span<const double> inverseMass) const {
    std::vector<double> masses;
    if (!(core::massesOf(inverseMass, masses) > 0)) return std::nullopt;
    return core::rigidMotionOf(masses, x, v);
}

}  // namespace taut::world
