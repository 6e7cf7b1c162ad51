#include "taut/bodies/private/rigid_constraint.h"

#include "taut/mechanics/rigid.h"

namespace taut::world {
namespace {

constexpr double heldOver = 1e9;        // mass of a held point over that of all others
constexpr double unmovedShare = 1e-14;  // of a coordinate

// Takes `to` over where points move. Returns whether any changed by more than rounding.
bool take(std::span<const dvec3> to, std::span<const double> inverseMass, std::span<dvec3> x) {
    bool changes = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(inverseMass[i] > 0)) continue;
        const dvec3 way = to[i] - x[i];
        changes = changes || glm::dot(way, way) > unmovedShare * roundingShare * (1.0 + glm::dot(x[i], x[i]));
        x[i] = to[i];
    }
    return changes;
}

}  // namespace

bool RigidConstraint::weigh(std::span<const double> inverseMass) {
    double free = 0;
    for (const double w : inverseMass)
        if (w > 0) free += 1.0 / w;
    masses_.clear();
    for (const double w : inverseMass) masses_.push_back(w > 0 ? 1.0 / w : heldOver * free);
    return free > 0;
}

bool RigidConstraint::projectPositions(const Moment& moment) {
    if (!weigh(moment.inverseMass)) return false;
    std::vector<dvec3> x(moment.x.begin(), moment.x.end());
    mechanics::placeRigidly(masses_, rest_, moment.from, x);
    return take(x, moment.inverseMass, moment.x);
}

bool RigidConstraint::projectVelocities(const Moment& moment) {
    if (!weigh(moment.inverseMass)) return false;
    std::vector<dvec3> v(moment.v.begin(), moment.v.end());
    mechanics::moveRigidly(masses_, moment.x, v);
    return take(v, moment.inverseMass, moment.v);
}

}  // namespace taut::world
