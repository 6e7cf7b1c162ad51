#include "taut/contact/gauss_seidel.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace taut::contact {
namespace {

// Projection onto the disk of Coulomb's friction.
dvec3 within(const dvec3& friction, double limit) {
    const double square = glm::dot(friction, friction);
    if (!(square > limit * limit)) return friction;
    return square > 0 ? friction * (limit / std::sqrt(square)) : dvec3(0.0);
}

// u += gains * impulse.
void apply(const ContactConstraint& pair, const Row& row, const dvec3& impulse, std::span<dvec3> u) {
    for (std::size_t i = 0; i < 4; ++i) u[static_cast<std::size_t>(pair.points[i])] += row.gains[i] * impulse;
}
void apply(const KinematicRow& row, const dvec3& impulse, std::span<dvec3> u) {
    u[static_cast<std::size_t>(row.contact.point)] += impulse / row.mass;
}
dvec3 total(const Impulse& impulse, const dvec3& normal) {
    return impulse.normal * normal + impulse.friction;
}

// Solves one row for the current velocities: first the normal impulse, then friction. Returns how its impulse changed.
Impulse visit(const ContactConstraint& pair, Row& row, std::span<dvec3> u) {
    dvec3 velocity(0.0);  // of the first side against the second
    for (std::size_t i = 0; i < 4; ++i) velocity += pair.weights[i] * u[static_cast<std::size_t>(pair.points[i])];
    const double parting = glm::dot(pair.normal, velocity);
    Impulse next = row.impulse;
    next.normal = std::max(0.0, next.normal - row.mass * (parting + row.gapSpeed - row.rebound));
    if (pair.friction > 0)
        next.friction =
            within(next.friction - row.mass * (velocity - parting * pair.normal), pair.friction * next.normal);
    const Impulse change{next.normal - row.impulse.normal, next.friction - row.impulse.friction};
    row.impulse = next;
    if (change.normal != 0 || change.friction != dvec3(0.0)) apply(pair, row, total(change, pair.normal), u);
    return change;
}

Impulse visit(KinematicRow& row, std::span<dvec3> u) {
    const KinematicContact& contact = row.contact;
    const double parting = glm::dot(u[static_cast<std::size_t>(contact.point)], contact.normal) - contact.speed;
    Impulse next = row.impulse;
    next.normal = std::max(0.0, next.normal - row.mass * parting);
    if (contact.friction > 0) {
        // Sliding is the tangential velocity relative to the collider's surface.
        const dvec3 velocity = u[static_cast<std::size_t>(contact.point)] - contact.carried;
        const dvec3 sliding = velocity - glm::dot(velocity, contact.normal) * contact.normal;
        next.friction = within(next.friction - row.mass * sliding, contact.friction * next.normal);
    }
    const Impulse change{next.normal - row.impulse.normal, next.friction - row.impulse.friction};
    row.impulse = next;
    if (change.normal != 0 || change.friction != dvec3(0.0)) apply(row, total(change, contact.normal), u);
    return change;
}

}  // namespace

int projectedGaussSeidel(std::span<const ContactConstraint> pairs, std::span<Row> rows,
                         std::span<KinematicRow> kinematicRows, int sweeps, double tolerance, std::span<dvec3> u) {
    const auto pairOf = [&](const Row& row) -> const ContactConstraint& {
        return pairs[static_cast<std::size_t>(row.pair)];
    };
    // The impulses that the rows already have.
    for (const Row& row : rows) apply(pairOf(row), row, total(row.impulse, pairOf(row).normal), u);
    for (const KinematicRow& row : kinematicRows) apply(row, total(row.impulse, row.contact.normal), u);

    // (rows, then kinematicRows) The change of each impulse in the last sweep, and the direction of extrapolation.
    thread_local std::vector<Impulse> changes, direction;
    changes.assign(rows.size() + kinematicRows.size(), {});
    direction.assign(changes.size(), {});
    double squareBefore = 0;
    for (int sweep = 1;; ++sweep) {
        // A sweep. It records the largest squared change of a velocity [(m/s)²], and the sum of the squared changes of
        // impulses [(N s)²].
        double largest = 0, square = 0;
        const auto record = [&](std::size_t k, const Impulse& change, double gain) {
            changes[k] = change;
            const double own = change.normal * change.normal + glm::dot(change.friction, change.friction);
            largest = std::max(largest, gain * gain * own);
            square += own;
        };
        for (std::size_t r = 0; r < rows.size(); ++r)
            record(r, visit(pairOf(rows[r]), rows[r], u), rows[r].largestGain);
        for (std::size_t s = 0; s < kinematicRows.size(); ++s)
            record(rows.size() + s, visit(kinematicRows[s], u), 1.0 / kinematicRows[s].mass);
        if (sweep == sweeps || largest < tolerance * tolerance) return sweep;

        // How far to extrapolate, after Fletcher and Reeves. If the changes grow, the direction starts anew.
        const double share = squareBefore > 0 ? square / squareBefore : 0.0;
        squareBefore = square;
        if (share > 1.0) {
            direction.assign(direction.size(), {});
            continue;
        }

        // The extrapolation. If it goes too far, the next sweep clamps it.
        const auto extrapolate = [&](std::size_t k, Impulse& impulse) {
            const Impulse step{share * direction[k].normal, share * direction[k].friction};
            direction[k] = {step.normal + changes[k].normal, step.friction + changes[k].friction};
            impulse = {impulse.normal + step.normal, impulse.friction + step.friction};
            return step;
        };
        for (std::size_t r = 0; r < rows.size(); ++r)
            apply(pairOf(rows[r]), rows[r], total(extrapolate(r, rows[r].impulse), pairOf(rows[r]).normal), u);
        for (std::size_t s = 0; s < kinematicRows.size(); ++s)
            apply(kinematicRows[s],
                  total(extrapolate(rows.size() + s, kinematicRows[s].impulse), kinematicRows[s].contact.normal), u);
    }
}

}  // namespace taut::contact
