#include "taut/contact/solver.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/contact/rigid_step.h"
#include "taut/contact/row_arithmetic.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

using glm::dmat3;

constexpr double fastestOut = 1.0;        // [m/s] limit of the position correction
constexpr double slopShare = 0.2;         // of the thickness: by which pairs of deformable bodies may overlap
constexpr std::size_t parallelRows = 64;  // fewer rows are solved on one thread, which is faster
// Solids have no springs that take up what the sweeps leave: a stack leans by it.
constexpr int sweepsOfSolids = 60;  // of a step
// Of the inverse mass of a row's heavier side, in a position correction: corrections that contradict each other end.
// One alone is not less by it.
constexpr double softnessOfShift = 2.0;
constexpr int sweepsOfShift = 10;        // of a position correction
constexpr double settledNearRest = 0.1;  // times the change that ends sweeps
constexpr double nearRest = 4.0;         // times the speed below which nothing bounces

// Of the same contact in every block.
std::uint64_t keyOf(const ContactConstraint& pair) {
    const std::uint64_t kind = pair.places ? 3 : pair.isPoint ? 1 : 2;
    return kind << 62U | static_cast<std::uint64_t>(pair.a) << 31U | static_cast<std::uint64_t>(pair.b);
}
// The number is that among the contacts of its point.
std::uint64_t keyOf(const KinematicContact& contact, int number) {
    return static_cast<std::uint64_t>(contact.point()) << 31U | static_cast<std::uint64_t>(number);
}

// Of a symmetric inverse mass or inertia: along a normal, and the least across it.
struct AlongAndAcross {
    double along, across;
};
AlongAndAcross effectiveOf(const dmat3& inverse, const dvec3& normal) {
    const dvec3 t = acrossOf(normal), b = glm::cross(normal, t);
    const double tt = glm::dot(t, inverse * t), bb = glm::dot(b, inverse * b), tb = glm::dot(t, inverse * b);
    const double along = glm::dot(normal, inverse * normal), difference = 0.5 * (tt - bb);
    return {1.0 / along, 1.0 / (0.5 * (tt + bb) + std::sqrt(difference * difference + tb * tb))};
}

// [1/kg] Of the heavier side of a row that moves at all.
double inverseOfHeavierSide(const Row& row) {
    double first = 0, second = 0;
    for (std::size_t k = 0; k < 4; ++k) (row.weights[k] > 0 ? first : second) += row.weights[k] * row.gains[k];
    return first > 0 && second > 0 ? std::min(first, second) : std::max(first, second);
}

}  // namespace

void ContactSolver::setSolids(std::span<const Solid> solids, std::size_t pointCount) {
    solids_ = solids;
    solidAt_.assign(solids.empty() ? 0 : pointCount, -1);
    for (std::size_t s = 0; s < solids.size(); ++s)
        for (int i : solids[s].points) solidAt_[static_cast<std::size_t>(i)] = static_cast<int>(s);
}

const Solid* ContactSolver::solidOf(int point) const {
    const int solid = solidAt_.empty() ? -1 : solidAt_[static_cast<std::size_t>(point)];
    return solid >= 0 && solids_[static_cast<std::size_t>(solid)].moves ? &solids_[static_cast<std::size_t>(solid)]
                                                                        : nullptr;
}
bool ContactSolver::isTouched(const Solid& solid) const {
    return solid.moves && parent_[static_cast<std::size_t>(solid.points.front())] >= 0;
}
bool ContactSolver::isFixed(int point) const {
    return !(block_.inverseMass[static_cast<std::size_t>(point)] > 0) && solidOf(point) == nullptr;
}
int ContactSolver::leaderOf(int point) const {
    const Solid* solid = solidOf(point);
    return solid != nullptr ? solid->points.front() : point;
}

// Whether its row may close its gap, and pushes out what overlaps; other contacts with colliders only hold.
bool ContactSolver::isLikePair(const Row& row) const {
    const auto source = static_cast<std::size_t>(row.source), pairCount = block_.pairs.size();
    return source < pairCount || block_.kinematic[source - pairCount].isWhole;
}

ContactConstraint::Kind ContactSolver::kindOf(const Row& row) const {
    const auto source = static_cast<std::size_t>(row.source);
    return source < block_.pairs.size() ? block_.pairs[source].kind : ContactConstraint::Kind::contact;
}

// [m/s] With it the row of a joint is content with these velocities.
double ContactSolver::closingOfJoint(const Row& row, std::span<const Four> velocities) const {
    const double kept = -glm::dot(vectorOf(row.normal), relativeVelocity(row, velocities, levers()));
    if (kindOf(row) == ContactConstraint::Kind::joint) return kept;
    return std::max(kept, gapNow(static_cast<std::size_t>(&row - rows_.data())) / block_.h);
}

void ContactSolver::keepJoints() {
    for (const Cluster& cluster : clusters_)
        for (std::size_t r = cluster.first; cluster.hasJoints && r < cluster.last; ++r)
            if (isJoint(rows_[r])) rows_[r].closing = closingOfJoint(rows_[r], u_);
}

bool ContactSolver::isNearRest(const Cluster& cluster) const {
    const double most = nearRest * block_.options.restSpeed;
    return std::none_of(rows_.begin() + static_cast<std::ptrdiff_t>(cluster.first),
                        rows_.begin() + static_cast<std::ptrdiff_t>(cluster.last), [&](const Row& row) {
                            if (isJoint(row)) return false;
                            const dvec3 velocity = relativeVelocity(row, u_, levers());
                            return !(glm::dot(velocity, velocity) <= most * most);
                        });
}

int ContactSolver::addSlot() {
    u_.emplace_back();
    return static_cast<int>(u_.size()) - 1;
}

int ContactSolver::slotOf(int point) {
    if (!isFixed(point)) return slots_[static_cast<std::size_t>(point)];
    fixed_.emplace_back(addSlot(), point);
    return fixed_.back().first;
}

// The solids that are touched -> bodies_, slots of their points.
void ContactSolver::takeSolids() {
    bodies_.resize(solids_.size());
    thread_local std::vector<dvec3> x;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        const Solid& solid = solids_[s];
        if (!isTouched(solid)) continue;
        x.clear();
        for (int i : solid.points) x.push_back(block_.x[static_cast<std::size_t>(i)]);
        Body& body = bodies_[s];
        body.start = core::rigidMotionOf(solid.masses, x, x);
        body.slot = addSlot();
        addSlot();
        for (int i : solid.points) slots_[static_cast<std::size_t>(i)] = body.slot;
    }
}

// The motion of a step, before impulses -> u_, v_, gone_, bodies_.
void ContactSolver::load(std::span<const dvec3> x, std::span<const dvec3> u, std::span<const dvec3> v) {
    const auto set = [&](int slot, const dvec3& ofU, const dvec3& ofV, const dvec3& gone) {
        const auto k = static_cast<std::size_t>(slot);
        u_[k] = four(ofU);
        v_[k] = four(ofV);
        gone_[k] = four(gone);
    };
    for (const auto* points : {&moving_, &fixed_})
        for (const auto& [slot, point] : *points) {
            const auto i = static_cast<std::size_t>(point);
            set(slot, u[i], v[i], x[i] - block_.x[i]);
        }
    for (const auto& [slot, velocity] : driven_)
        set(slot, velocity, velocity, vectorOf(gone_[static_cast<std::size_t>(slot)]));
    thread_local std::vector<dvec3> places, ofU, ofV;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        const Solid& solid = solids_[s];
        if (!isTouched(solid)) continue;
        places.clear();
        ofU.clear();
        ofV.clear();
        for (int i : solid.points) {
            const auto k = static_cast<std::size_t>(i);
            places.push_back(x[k]);
            ofU.push_back(u[k]);
            ofV.push_back(v[k]);
        }
        Body& body = bodies_[s];
        body.u = core::rigidMotionOf(solid.masses, places, ofU);
        body.v = core::rigidMotionOf(solid.masses, places, ofV);
        set(body.slot, body.u.velocity, body.v.velocity, body.u.centre - body.start.centre);
        set(body.slot + 1, body.u.spin, body.v.spin, vectorOf(gone_[static_cast<std::size_t>(body.slot) + 1]));
    }
}

// Gives points, and those of solids, what sweeps and bounces have changed.
void ContactSolver::store(std::span<const dvec3> x, std::span<dvec3> u, std::span<dvec3> v) {
    const auto at = [](const std::vector<Four>& field, int slot) {
        return vectorOf(field[static_cast<std::size_t>(slot)]);
    };
    const auto storedAt = [&](int slot) { return at(v_, slot) + (at(u_, slot) - at(before_, slot)); };
    for (const auto& [slot, point] : moving_) {
        const auto i = static_cast<std::size_t>(point);
        u[i] = at(u_, slot);
        v[i] = storedAt(slot);
    }
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        if (!isTouched(solids_[s])) continue;
        const auto& [start, ofU, ofV, slot] = bodies_[s];
        const dvec3 u0 = at(u_, slot) - ofU.velocity, u1 = at(u_, slot + 1) - ofU.spin;
        const dvec3 v0 = storedAt(slot) - ofV.velocity, v1 = storedAt(slot + 1) - ofV.spin;
        for (int i : solids_[s].points) {
            const auto k = static_cast<std::size_t>(i);
            const dvec3 arm = x[k] - ofU.centre;
            u[k] += u0 + glm::cross(u1, arm);
            v[k] += v0 + glm::cross(v1, arm);
        }
        Four& turned = gone_[static_cast<std::size_t>(slot) + 1];
        turned = four(vectorOf(turned) + block_.h * at(u_, slot + 1));
    }
    for (const auto& [slot, velocity] : driven_) {
        Four& gone = gone_[static_cast<std::size_t>(slot)];
        gone = four(vectorOf(gone) + block_.h * velocity);
    }
}

// What a row has of a point, at the place where its impulse acts [m] -> terms_, solidTerms_.
void ContactSolver::addTerm(int point, double weight, const dvec3& place) {
    carried_->forEachMover(
        point,
        [&](int i, double share) {
            const double own = weight * share;
            if (const Solid* solid = solidOf(i); solid != nullptr) {
                const Body& body = bodies_[static_cast<std::size_t>(solid - solids_.data())];
                auto at = std::find_if(
                    solidTerms_.begin(), solidTerms_.end(),
                    [&](const SolidTerm& other) { return other.body == &body; });
                if (at == solidTerms_.end()) at = solidTerms_.insert(at, SolidTerm{&body});
                at->weight += own;
                at->arm += own * (place - body.start.centre);
                terms_.push_back({slotOf(i), own, 1.0 / body.start.mass, &body});
                return;
            }
            const int slot = slotOf(i);
            if (i != point)  // several points of a row may go with the same
                for (Term& other : terms_)
                    if (other.slot == slot) {
                        other.weight += own;
                        return;
                    }
            terms_.push_back({slot, own, block_.inverseMass[static_cast<std::size_t>(i)]});
        });
}

// The terms become weights, gains and levers of the row. It has four velocities besides the shares, if it has so many.
void ContactSolver::putTerms(Row& row) {
    row.shares.first = static_cast<int>(shares_.size());
    for (std::size_t k = 0; k < terms_.size(); ++k) {
        const Term& term = terms_[k];
        const double gain = term.weight * term.inverseMass;
        row.largestGain = std::max(row.largestGain, std::abs(gain));
        if (k >= 4) {
            shares_.push_back({term.slot, term.weight, gain});
            continue;
        }
        row.weights[k] = term.weight;
        row.gains[k] = gain;
        row.slots[k] = term.slot;
    }
    for (std::size_t k = terms_.size(); k < 4; ++k) row.slots[k] = terms_.back().slot;
    row.shares.last = static_cast<int>(shares_.size());
    row.turns.first = static_cast<int>(turns_.size());
    for (const SolidTerm& term : solidTerms_) {
        Turn& turn = turns_.emplace_back();
        turn.slot = term.body->slot + 1;
        for (int i = 0; i < 3; ++i) {
            turn.arm[i] = term.arm[i];
            for (int j = 0; j < 3; ++j) turn.gain[3 * i + j] = term.body->start.inverseInertia[j][i];
        }
        turn.weight = term.weight;
    }
    row.turns.last = static_cast<int>(turns_.size());
}

// Effective masses of a row with solids. The velocity that an impulse p of 1 gives along itself is p·K p.
void ContactSolver::weigh(Row& row) const {
    dmat3 inverse(0.0);  // K
    for (const Term& term : terms_)
        if (term.body == nullptr) inverse += dmat3(term.weight * term.weight * term.inverseMass);
    for (const SolidTerm& term : solidTerms_) {
        const dvec3& arm = term.arm;
        const dmat3 across(0, arm.z, -arm.y, -arm.z, 0, arm.x, arm.y, -arm.x, 0);  // arm × p
        inverse += dmat3(term.weight * term.weight / term.body->start.mass);
        inverse -= across * term.body->start.inverseInertia * across;
    }
    const AlongAndAcross effective = effectiveOf(inverse, vectorOf(row.normal));
    row.mass = effective.along;
    row.grip = effective.across;
    row.largestGain = std::max(1.0 / row.mass, 1.0 / row.grip);
}

// The torque of a row with solids against their turn. driven [rad/s]: spin of a collider.
void ContactSolver::addRoll(Row& row, const core::TurnFriction& friction, const dvec3& driven) {
    Roll& roll = rolls_.emplace_back();
    row.roll = static_cast<int>(rolls_.size()) - 1;
    dmat3 inverse(0.0);
    for (const SolidTerm& term : solidTerms_) {
        inverse += term.weight * term.weight * term.body->start.inverseInertia;
        roll.reach = std::max(roll.reach, glm::length(term.arm));
    }
    const AlongAndAcross effective = effectiveOf(inverse, vectorOf(row.normal));
    roll.friction = friction;
    roll.about = effective.along;
    roll.across = effective.across;
    roll.driven = four(driven);
}

// Appends the row of a pair, or of a contact with a collider. It starts with what it had in the last block.
void ContactSolver::addRow(int source) {
    Row& row = rows_.emplace_back();
    row.source = source;
    terms_.clear();
    solidTerms_.clear();
    const auto placeOf = [&](int point) { return block_.x[static_cast<std::size_t>(point)]; };
    const std::size_t pairCount = block_.pairs.size();
    std::uint64_t key;
    double softness = 0, gap = 0;
    core::TurnFriction turnFriction;
    dvec3 driven(0.0);
    if (const auto own = static_cast<std::size_t>(source); own < pairCount) {
        const ContactConstraint& pair = block_.pairs[own];
        key = keyOf(pair);
        row.normal = four(pair.normal);
        row.friction = pair.friction;
        if (pair.kind == ContactConstraint::Kind::joint) row.least = -1e300;
        turnFriction = pair.turnFriction;
        softness = pair.softness;
        for (std::size_t i = 0; i < 4; ++i) {
            // Where the sides meet. Each is brought there by a shift of its own.
            if (pair.places && pair.weights[i] == 0) continue;
            const bool isFirst = static_cast<int>(i) < pair.firstSide();
            const double way = (isFirst ? -pair.firstShare : 1.0 - pair.firstShare) * pair.distance;
            const dvec3 place =
                pair.places ? (*pair.places)[isFirst ? 0 : 1] : placeOf(pair.points[i]) + way * pair.normal;
            addTerm(pair.points[i], pair.weights[i], place);
        }
        gap = pair.gap() + pair.slack;
    } else {
        const std::size_t k = own - pairCount;
        const KinematicContact& contact = block_.kinematic[k];
        int number = 0;
        while (static_cast<std::size_t>(number) < k &&
               block_.kinematic[k - static_cast<std::size_t>(number) - 1].point() == contact.point())
            ++number;
        key = keyOf(contact, number);
        row.normal = four(contact.normal);
        row.friction = contact.friction;
        turnFriction = contact.turnFriction;
        driven = contact.spin;
        const dvec3 place = placeOf(contact.point()) + contact.arm;
        contact.forEachPoint([&](int point, double weight) { addTerm(point, weight, place); });
        row.closing = glm::dot(contact.normal, contact.carried) - contact.speed;
        if (contact.isWhole) gap = contact.gap;
        driven_.emplace_back(addSlot(), contact.carried);
        terms_.push_back({driven_.back().first, -1.0, 0.0});
    }
    putTerms(row);
    double inverse = 0;
    for (const Term& term : terms_) inverse += term.weight * term.weight * term.inverseMass;
    row.softness = softness * inverse;
    row.mass = 1.0 / (inverse + row.softness);
    if (!solidTerms_.empty()) weigh(row);
    if (!solidTerms_.empty() && !turnFriction.isNone()) addRoll(row, turnFriction, driven);

    keys_.push_back(key);
    gaps_.push_back(gap);
    bases_.push_back(row.closing);
    const auto last = std::lower_bound(last_.begin(), last_.end(), key,
                                       [](const KeptForce& l, std::uint64_t wanted) { return l.key < wanted; });
    if (last == last_.end() || last->key != key || (beginsTick_ && !solidTerms_.empty())) return;
    // Friction turns with the plane of the contact.
    const dvec3 normal = vectorOf(row.normal);
    const double impulse = block_.h * last->force.of[3];
    dvec3 friction = block_.h * vectorOf(last->force);
    friction = withinCone(friction - glm::dot(friction, normal) * normal, row.friction * impulse);
    row.impulse = {{friction.x, friction.y, friction.z, impulse}};
    if (row.roll >= 0) rolls_.back().impulse = four(block_.h * vectorOf(last->torque));
}

// [m] The gap of a row before this step.
double ContactSolver::gapNow(std::size_t row) const {
    const Row& own = rows_[row];
    return gaps_[row] + glm::dot(vectorOf(own.normal), relativeVelocity(own, gone_, levers()));
}

// By which the sides may still approach. A gap that a solid would fall through from rest in a block counts as closed.
double ContactSolver::openGap(std::size_t row) const {
    const double slop = rows_[row].turns.isEmpty() ? 0.0 : 0.5 * block_.options.restSpeed * block_.seconds();
    return std::max(gapNow(row) - slop, 0.0);
}

void ContactSolver::sweep(Cluster& cluster) {
    if (!cluster.packs) return sweepSolids(cluster);
    cluster.packs->sweep(block_.options.sweeps, cluster.tolerance, block_.h, u_, gone_, levers());
    cluster.packs->read(rowsOf(cluster));
}

// Sweeps. A pile of solids near rest that does not settle soon is solved as a whole, and then swept again.
void ContactSolver::sweepSolids(const Cluster& cluster) {
    constexpr int fewSweeps = 16;
    const std::span<Row> rows = rowsOf(cluster);
    for (std::size_t r = cluster.first; r < cluster.last; ++r) {
        Row& row = rows_[r];
        if (isJoint(row)) continue;
        row.closing = bases_[r];
        if (isLikePair(row)) row.closing += openGap(r) / block_.h;
    }
    // Sweeps are good enough for what moves, and for one alone. What sweeps leave of a pile at rest, it creeps by.
    const bool isPile = (cluster.solids.size() > 1 || cluster.hasJoints) && isNearRest(cluster);
    const double tolerance = (isPile ? settledNearRest : 1.0) * cluster.tolerance;
    const int first = projectedGaussSeidel(rows, isPile ? fewSweeps : sweepsOfSolids, tolerance, u_, levers());
    if (!isPile || first < fewSweeps) return;
    stepRigidly(rows, cluster.solids, levers(), tolerance, u_);
    projectedGaussSeidel(rows, sweepsOfSolids, tolerance, u_, levers(), Start::applied);
}

// Solves 0 <= multiplier  ⊥  n·shift - target >= 0, for the pairs that overlap, press or nearly touch. Pairs that do
// not overlap have the target 0, so that a correction does not press them together, nor into colliders.
void ContactSolver::correctPositions(const Cluster& cluster) {
    thread_local std::vector<Row> rows;
    rows.clear();
    bool overlaps = false;
    for (std::size_t r = cluster.first; r < cluster.last; ++r) {
        const Row& row = rows_[r];
        double target = 0;
        if (isLikePair(row) && !isJoint(row)) {
            const auto source = static_cast<std::size_t>(row.source), pairCount = block_.pairs.size();
            const bool isPair = source < pairCount;
            const double thickness =
                isPair ? block_.pairs[source].thickness : block_.kinematic[source - pairCount].thickness;
            const double slop = slopShare * thickness;
            if (gaps_[r] > slop && !(row.impulse.of[3] > 0)) continue;
            const double restitution =
                isPair ? block_.pairs[source].restitution : block_.kinematic[source - pairCount].restitution;
            const double share = isPair ? block_.pairs[source].recovery : 1.0;
            const double overlap = -gaps_[r] - (isPair && cluster.packs != nullptr ? slop : 0.0);
            // A bounce takes sides apart by itself, and without damping nothing takes up the work of a shift.
            if (overlap > 0)
                target = std::min(block_.options.recovery * (1 - restitution) * share * overlap,
                                  fastestOut * block_.seconds());
        }
        overlaps = overlaps || target > 0;
        Row& own = rows.emplace_back(row);
        own.impulse = {};
        own.friction = 0;
        own.roll = -1;
        own.closing = -target;
        if (cluster.packs == nullptr || !(target > 0)) continue;
        own.softness = softnessOfShift * inverseOfHeavierSide(own);
        own.closing *= 1.0 + own.softness * own.mass;
        own.mass = 1.0 / (1.0 / own.mass + own.softness);
    }
    if (overlaps)
        projectedGaussSeidel(rows, cluster.packs ? sweepsOfShift : sweepsOfSolids, cluster.tolerance * block_.h, v_,
                             levers());
}

// Keeps the impulses for the next block, as forces -> last_.
void ContactSolver::end() {
    beginsTick_ = false;
    last_.clear();
    const auto forceOf = [&](Four impulse) {
        for (double& part : impulse.of) part /= block_.h;
        return impulse;
    };
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (const Row& row = rows_[r]; row.impulse.of[3] > 0 || (row.least < 0 && row.impulse.of[3] != 0))
            last_.push_back({keys_[r], forceOf(row.impulse),
                             row.roll >= 0 ? forceOf(rolls_[static_cast<std::size_t>(row.roll)].impulse) : Four{}});
    std::sort(last_.begin(), last_.end(), [](const KeptForce& a, const KeptForce& b) { return a.key < b.key; });
}

void ContactSolver::tellImpulses() const {
    if (std::exchange(areTold_, true)) return;
    impulses_.assign(block_.pairs.size() + block_.kinematic.size(), 0.0);
    frictions_.assign(impulses_.size(), dvec3(0.0));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const Row& row = rows_[r];
        const auto source = static_cast<std::size_t>(row.source);
        if (isJoint(row)) continue;
        impulses_[source] += bounces_[r];
        if (!(row.impulse.of[3] > 0)) continue;
        impulses_[source] += row.impulse.of[3];
        frictions_[source] = vectorOf(row.impulse);
    }
}

int ContactSolver::countImpulses() const {
    int count = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
        count += isLikePair(rows_[r]) && !isJoint(rows_[r]) && rows_[r].impulse.of[3] + bounces_[r] > 0 ? 1 : 0;
    return count;
}

void ContactSolver::begin(const SolverBlock& block) {
    block_ = block;
    findClusters();
    const auto bounces = [](const auto& contact) { return contact.restitution > 0; };
    anyBounces_ = std::any_of(block.pairs.begin(), block.pairs.end(), bounces) ||
                  std::any_of(block.kinematic.begin(), block.kinematic.end(), bounces);
}

// Calls each(cluster). No two share a slot, so they can go in parallel.
template <class Each>
void ContactSolver::forEachCluster(const Each& each) {
    const int count = clusters();
    const auto one = [&](int c) { each(clusters_[static_cast<std::size_t>(c)]); };
    if (rows_.size() < parallelRows)
        for (int c = 0; c < count; ++c) one(c);
    else
        core::parallelFor(count, one);
}

void ContactSolver::step(std::span<const dvec3> x, std::span<const dvec3> start, std::span<dvec3> u,
                         std::span<dvec3> v) {
    if (anyBounces_) {
        load(x, start, start);
        start_ = u_;
    }
    load(x, u, v);
    keepJoints();
    bounces_.assign(rows_.size(), 0.0);
    if (anyBounces_) forEachCluster([&](Cluster& cluster) { bounce(cluster); });
    before_ = u_;
    forEachCluster([&](Cluster& cluster) { sweep(cluster); });
    store(x, u, v);
    areTold_ = false;
}

void ContactSolver::findShift(std::span<dvec3> shift) {
    load(block_.x, shift, shift);
    v_.assign(v_.size(), Four{});
    forEachCluster([&](const Cluster& cluster) { correctPositions(cluster); });
    before_ = u_;
    store(block_.x, shift, shift);
}

}  // namespace taut::contact
