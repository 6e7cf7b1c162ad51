#include "taut/contact/gauss_seidel.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace taut::contact {
namespace {

dvec3 within(const dvec3& rub, double limit) {
    const double square = glm::dot(rub, rub);
    if (!(square > limit * limit)) return rub;
    return square > 0 ? rub * (limit / std::sqrt(square)) : dvec3(0.0);
}

// Impulses by which those of the points change: u += gains * impulse.
void handOver(const ContactConstraint& pair, const Row& row, const dvec3& impulse, std::span<dvec3> u) {
    for (std::size_t i = 0; i < 4; ++i) u[static_cast<std::size_t>(pair.points[i])] += row.gains[i] * impulse;
}
void handOver(const KinematicRow& support, const dvec3& impulse, std::span<dvec3> u) {
    u[static_cast<std::size_t>(support.held.point)] += impulse / support.mass;
}
dvec3 along(const Impulse& impulse, const dvec3& normal) {
    return impulse.normal * normal + impulse.rub;
}

// One visit, which changes the impulse by what it returns.
Impulse visit(const ContactConstraint& pair, Row& row, std::span<dvec3> u) {
    dvec3 way(0.0);
    for (std::size_t i = 0; i < 4; ++i) way += pair.weights[i] * u[static_cast<std::size_t>(pair.points[i])];
    const double closing = glm::dot(pair.normal, way);
    Impulse next = row.impulse;
    next.normal = std::max(0.0, next.normal - row.mass * (closing + row.open - row.bounce));
    if (pair.friction > 0)
        next.rub = within(next.rub - row.mass * (way - closing * pair.normal), pair.friction * next.normal);
    const Impulse change{next.normal - row.impulse.normal, next.rub - row.impulse.rub};
    row.impulse = next;
    if (change.normal != 0 || change.rub != dvec3(0.0)) handOver(pair, row, along(change, pair.normal), u);
    return change;
}

Impulse visit(KinematicRow& support, std::span<dvec3> u) {
    const KinematicContact& held = support.held;
    const double closing = glm::dot(u[static_cast<std::size_t>(held.point)], held.normal) - held.speed;
    Impulse next = support.impulse;
    next.normal = std::max(0.0, next.normal - support.mass * closing);
    if (held.friction > 0) {
        // What friction has to stop is what goes along the surface, seen from it.
        const dvec3 way = u[static_cast<std::size_t>(held.point)] - held.carried;
        const dvec3 across = way - glm::dot(way, held.normal) * held.normal;
        next.rub = within(next.rub - support.mass * across, held.friction * next.normal);
    }
    const Impulse change{next.normal - support.impulse.normal, next.rub - support.impulse.rub};
    support.impulse = next;
    if (change.normal != 0 || change.rub != dvec3(0.0)) handOver(support, along(change, held.normal), u);
    return change;
}

}  // namespace

int projectedGaussSeidel(std::span<const ContactConstraint> pairs, std::span<Row> rows,
                         std::span<KinematicRow> kinematicRows, int sweeps, double little, std::span<dvec3> u) {
    const auto pairOf = [&](const Row& row) -> const ContactConstraint& {
        return pairs[static_cast<std::size_t>(row.pair)];
    };
    for (const Row& row : rows) handOver(pairOf(row), row, along(row.impulse, pairOf(row).normal), u);
    for (const KinematicRow& one : kinematicRows) handOver(one, along(one.impulse, one.held.normal), u);

    thread_local std::vector<Impulse> changes, on;  // (rows, then kinematicRows)
    changes.assign(rows.size() + kinematicRows.size(), {});
    on.assign(changes.size(), {});
    double squareBefore = 0;
    for (int sweep = 1;; ++sweep) {
        double most = 0, square = 0;  // of the changes [(m/s)²], [(N s)²]
        const auto count = [&](std::size_t k, const Impulse& change, double gain) {
            changes[k] = change;
            const double own = change.normal * change.normal + glm::dot(change.rub, change.rub);
            most = std::max(most, gain * gain * own);
            square += own;
        };
        for (std::size_t r = 0; r < rows.size(); ++r) count(r, visit(pairOf(rows[r]), rows[r], u), rows[r].most);
        for (std::size_t s = 0; s < kinematicRows.size(); ++s)
            count(rows.size() + s, visit(kinematicRows[s], u), 1.0 / kinematicRows[s].mass);
        if (sweep == sweeps || most < little * little) return sweep;
        const double share = squareBefore > 0 ? square / squareBefore : 0.0;
        squareBefore = square;
        if (share > 1.0) {  // it went astray
            on.assign(on.size(), {});
            continue;
        }
        const auto goOn = [&](std::size_t k, Impulse& impulse) {
            const Impulse step{share * on[k].normal, share * on[k].rub};
            on[k] = {step.normal + changes[k].normal, step.rub + changes[k].rub};
            impulse = {impulse.normal + step.normal, impulse.rub + step.rub};
            return step;
        };
        for (std::size_t r = 0; r < rows.size(); ++r)
            handOver(pairOf(rows[r]), rows[r], along(goOn(r, rows[r].impulse), pairOf(rows[r]).normal), u);
        for (std::size_t s = 0; s < kinematicRows.size(); ++s)
            handOver(kinematicRows[s],
                     along(goOn(rows.size() + s, kinematicRows[s].impulse), kinematicRows[s].held.normal), u);
    }
}

}  // namespace taut::contact
