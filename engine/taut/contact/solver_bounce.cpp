// Restitution.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/contact/row_arithmetic.h"
#include "taut/contact/solver.h"

namespace taut::contact {

// Whether two rows are between the same bodies that turn, so that they bounce as one impact.
bool ContactSolver::areOfOneImpact(const Row& a, const Row& b) const {
    const auto turnsAll = [&](const Row& row, const Row& other) {
        const auto own = row.turns.of(levers().turns), wanted = other.turns.of(levers().turns);
        return std::all_of(wanted.begin(), wanted.end(), [&](const Turn& turn) {
            return std::any_of(own.begin(), own.end(), [&](const Turn& one) { return one.slot == turn.slot; });
        });
    };
    return &a == &b || (!a.turns.of(levers().turns).empty() && turnsAll(a, b) && turnsAll(b, a));
}

// Whether a row has no point of a deformable body.
bool ContactSolver::isRigid(const Row& row) const {
    const auto isOf = [&](int point) {
        bool all = true;
        carried_->forEachMover(point, [&](int i, double) { all = all && (isFixed(i) || solidOf(i) != nullptr); });
        return all;
    };
    const auto source = static_cast<std::size_t>(row.source);
    if (source >= block_.pairs.size()) {
        const auto used = block_.kinematic[source - block_.pairs.size()].used();
        return std::all_of(used.begin(), used.end(), isOf);
    }
    const auto& points = block_.pairs[source].points;
    return std::all_of(points.begin(), points.end(), isOf);
}

// Bounces: one impact after the other, the fastest first, gives back its share of the speeds with which its rows close,
// until none closes faster than restSpeed. So momentum goes through a row of balls as from one to the next, and a box
// that lands on a face leaves it without turning. Normal impulses of an impact that each give their row its speed take
// Σ λ (1 - e) c / 2 of the energy. Friction comes after them and acts against the slip that they leave: against the
// slip before, it could add energy where the impact turns a body. The sweeps add their impulses to these.
//
//       the gap closes      now         Rigid bodies that close by c meet s before the end of the step. Until then they
//     |-------- h - s ------|--- s ---| use up the gap, then they part by e c. Forces, which change u to v by d along
//     step before                       the normal, act on until v: for h/2 + s under leap-frog, and before that on c.
//
// Springs would gain or lose by that, since their forces go with the place. A step of leap-frog from x keeps
// ½ w·Mw + V(x), where w is the velocity at x: the mean of those before and after its kick. So a row of a deformable
// body gives back its closing w, and u and v change as w does: at e = 1 this is the step before taken back.
void ContactSolver::bounce(const Cluster& cluster) {
    const std::span<const Row> rows = rowsOf(cluster);
    const std::span<double> sizes = std::span(bounces_).subspan(cluster.first, rows.size());
    thread_local std::vector<Bouncing> all;
    all.clear();
    const std::size_t pairCount = block_.pairs.size();
    for (const Row& row : rows) {
        const auto source = static_cast<std::size_t>(row.source);
        const bool isPair = source < pairCount;
        const KinematicContact* contact = isPair ? nullptr : &block_.kinematic[source - pairCount];
        const double restitution = isPair ? block_.pairs[source].restitution : contact->restitution;
        if (!(restitution > 0) || !isLikePair(row)) continue;
        const double gap = openGap(static_cast<std::size_t>(&row - rows_.data()));
        const auto closingIn = [&](std::span<const Four> velocities) {
            return -glm::dot(vectorOf(row.normal), relativeVelocity(row, velocities, levers()));
        };
        const double u = closingIn(u_);
        all.push_back({&row, restitution, gap, u - closingIn(start_), closingIn(v_) - u, 0.0, isRigid(row)});
    }
    const double h = block_.h;
    // Until the sides meet [s]; they part by e c then.
    const auto untilMet = [h](const Bouncing& own, double closing) { return std::min(own.gap / closing, h); };
    // Forces have changed the closing by so much since it was c.
    const auto parts = [](const Bouncing& own, double change) {
        return -std::max(own.restitution * (own.closing - change) - change, 0.0);
    };
    bounceIn(u_, all, rows, {}, [&](const Bouncing& own) {
        if (!own.isRigid) return parts(own, own.gained);
        const double before = untilMet(own, own.closing);
        return (before - own.restitution * (h - before)) * own.closing / h;
    });
    bounceIn(v_, all, rows, sizes, [&](const Bouncing& own) {
        if (!own.isRigid) return parts(own, own.gained + own.drift);
        const double then = own.closing - own.drift;  // of u
        const double before = then > 0 ? untilMet(own, then) : h;
        return parts(own, own.drift * (1.5 - before / h));
    });
}

// target(row): how fast it may close afterwards [m/s].
void ContactSolver::bounceIn(std::span<Four> velocities, std::vector<Bouncing>& all, std::span<const Row> rows,
                             std::span<double> sizes, const std::function<double(const Bouncing&)>& target) const {
    constexpr std::size_t mostEach = 50;  // impacts of a row, on average
    constexpr int mostSweeps = 200;
    constexpr double exactly = 1e-9;  // of the speed
    const auto measure = [&](Bouncing& own) {
        own.closing = -glm::dot(vectorOf(own.row->normal), relativeVelocity(*own.row, velocities, levers()));
    };
    std::for_each(all.begin(), all.end(), measure);
    std::vector<bool> isOther(velocities.size(), false);
    const auto forEachSlot = [&](const Row& row, const auto& each) {
        for (int slot : row.slots) each(static_cast<std::size_t>(slot));
        for (const Share& share : row.shares.of(levers().shares)) each(static_cast<std::size_t>(share.slot));
    };
    constexpr double rounding = 1e-9;  // so that all corners of a face meet in the same step
    const auto closes = [&](const Bouncing& own) {
        return own.closing > block_.options.restSpeed && own.gap < (1 + rounding) * own.closing * block_.h;
    };
    std::vector<Row> impact, joints;
    for (const Row& row : rows) {
        if (!isJoint(row)) continue;
        joints.push_back(row);
        joints.back().closing = closingOfJoint(row, velocities);
        joints.back().impulse = {};
    }
    std::vector<const Row*> own;
    for (std::size_t left = mostEach * rows.size(); left > 0; --left) {
        const Bouncing* fastest = nullptr;
        for (const Bouncing& one : all)
            if (closes(one) && (fastest == nullptr || one.closing > fastest->closing)) fastest = &one;
        if (fastest == nullptr) return;
        impact.clear();
        own.clear();
        for (const Bouncing& one : all) {
            if (!closes(one) || !areOfOneImpact(*one.row, *fastest->row)) continue;
            own.push_back(one.row);
            Row& row = impact.emplace_back(*one.row);
            row.closing = target(one);
            row.impulse = {};
            row.friction = 0;
            row.roll = -1;
        }
        impact.insert(impact.end(), joints.begin(), joints.end());
        projectedGaussSeidel(impact, mostSweeps, exactly * fastest->closing, velocities, levers());
        for (std::size_t k = 0; k < own.size(); ++k) {
            const Row& row = *own[k];
            const double size = impact[k].impulse.of[3];
            const dvec3 normal = vectorOf(row.normal), velocity = relativeVelocity(row, velocities, levers());
            const double grip = row.grip > 0 ? row.grip : row.mass;
            push(row, withinCone(-grip * (velocity - glm::dot(velocity, normal) * normal), row.friction * size),
                 velocities, levers());
            if (!sizes.empty()) sizes[static_cast<std::size_t>(&row - rows.data())] += size;
            forEachSlot(row, [&](std::size_t slot) { isOther[slot] = true; });
        }
        for (const Row& row : joints) forEachSlot(row, [&](std::size_t slot) { isOther[slot] = true; });
        for (Bouncing& one : all) {
            bool isAny = false;
            forEachSlot(*one.row, [&](std::size_t slot) { isAny = isAny || isOther[slot]; });
            if (isAny) measure(one);
        }
        for (const Row& row : impact) forEachSlot(row, [&](std::size_t slot) { isOther[slot] = false; });
    }
}

}  // namespace taut::contact
