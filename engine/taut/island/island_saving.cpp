// An island as bytes. The scene builds an unchanged plan again, so only changes are written.
#include <algorithm>
#include <cmath>

#include "taut/island/private/cutting.h"
#include "taut/island/private/island.h"
#include "taut/plan/constraint.h"

namespace taut::world {
namespace {

// Marks a grip that a collider has, or that turns. No name, with which all other grips begin, has such a length.
constexpr std::uint64_t poseMark = 0xfff8'7461'7574'0003ULL;

// Marks the largest forces of a grip; differs from the other marks and from any length of a name.
constexpr std::uint64_t mostForceMark = 0xfff8'7461'7574'0006ULL;

// Marks the tie of a grip that belongs to one tie; also different.
constexpr std::uint64_t tieMark = 0xfff8'7461'7574'0005ULL;

// Marks the lengths of a grip's springs; also different.
constexpr std::uint64_t lengthsMark = 0xfff8'7461'7574'0008ULL;

void visitPart(StateBytes& bytes, Grip& grip, const IslandPlan& plan) {
    const std::size_t pointCount = plan.points.size();
    mechanics::PosePath& path = grip.path;
    if (bytes.mark(mostForceMark, !grip.mostForce.empty())) bytes.list(grip.mostForce);
    if (bytes.mark(lengthsMark, !grip.lengths.empty())) bytes.list(grip.lengths);
    if (bytes.mark(tieMark, grip.tie >= 0)) {
        bytes(grip.tie);
        bytes.require(grip.tie >= 0 && grip.tie < static_cast<int>(plan.ties.size()));
    }
    if (bytes.mark(poseMark, grip.ofCollider || path.isTurned())) {
        bytes(grip.ofCollider);
        for (glm::dquat* rotation : {&path.from, &path.to}) bytes(*rotation);
        bytes(path.t0);
        bytes(path.t1);
        bytes.require(path.t0 < path.t1);
    }
    bytes(grip.holder);
    bytes(grip.rigid);
    bytes.list(grip.points);
    bytes.list(grip.offsets);
    bytes.list(grip.stiffness);
    bytes.list(grip.damping);
    bytes(path.place);
    const std::size_t count = grip.points.size(), forces = grip.rigid ? 0 : count;
    bytes.require(count > 0 && grip.offsets.size() == count && grip.stiffness.size() == forces &&
                  grip.damping.size() == forces);
    bytes.require(grip.mostForce.empty() || grip.mostForce.size() == forces);
    bytes.require(grip.lengths.empty() || (grip.lengths.size() == forces && grip.mostForce.empty()));
    for (std::size_t i = 0; i < count; ++i)
        bytes.require(grip.points[i] > (i == 0 ? -1 : grip.points[i - 1]) &&
                      static_cast<std::size_t>(grip.points[i]) < pointCount);
    for (const std::vector<double>* list : {&grip.stiffness, &grip.damping, &grip.lengths})
        for (double number : *list) bytes.require(number >= 0 && std::isfinite(number));
    for (double number : grip.mostForce) bytes.require(number > 0 && std::isfinite(number));
}

void visitPart(StateBytes& bytes, Damage& damage, const mechanics::Model& model) {
    struct Severed {
        int a = 0, b = 0;
        double share = 0;
    };
    std::vector<Severed> edges;
    for (const auto& [edge, share] : damage.edges()) edges.push_back({edge.first, edge.second, share});
    bytes.each(edges, [&](Severed& edge) {
        bytes(edge.a);
        bytes(edge.b);
        bytes(edge.share);
        bytes.require(edge.a >= 0 && edge.a < edge.b && edge.b < model.pointCount() && edge.share >= 0 &&
                      edge.share <= 1);
    });
    if (!bytes.isReading()) return;
    damage = {};
    for (const Severed& edge : edges) damage.sever(edge.a, edge.b, edge.share);
    damage.assess(model);
}

void visitPart(StateBytes& bytes, Body& body) {
    visitPart(bytes, body.damage, body.model);
    double bulk = body.model.cells.empty() ? 0.0 : body.model.cells.front().bulkModulus;
    bytes.notNegative(bulk);
    const MeshSource* source = body.spec->meshSource();
    const bool isFilled = source != nullptr && source->meshData != nullptr;  // then each cell has its own
    for (mechanics::VolumeCell& cell : body.model.cells) {
        if (bytes.isReading()) cell.bulkModulus = bulk;
        if (isFilled) bytes.notNegative(cell.bulkModulus);
    }
    for (auto* limit : {&body.plasticity.yieldStrain, &body.plasticity.breakStrain}) {
        bool has = limit->has_value();
        double strain = limit->value_or(0.0);
        bytes(has);
        bytes.notNegative(strain);
        *limit = has ? std::optional<double>(strain) : std::nullopt;
    }
    bytes.notNegative(body.plasticity.breakCell);
}

// The bytes between a number and the next are zero, so that equal states are equal files.
void visitPart(StateBytes& bytes, std::vector<ContactAcceleration>& pressed) {
    struct Filled {
        int point = 0, between = 0;
        dvec3 acceleration{0.0};
    };
    static_assert(sizeof(Filled) == sizeof(ContactAcceleration));
    std::vector<Filled> filled;
    for (const ContactAcceleration& one : pressed) filled.push_back({one.point, 0, one.acceleration});
    bytes.list(filled);
    pressed.clear();
    for (const Filled& one : filled) pressed.push_back({one.point, one.acceleration});
}

void visitPart(StateBytes& bytes, Divergence& d) {
    bytes(d.tick);
    bytes.raw(d.time);
    bytes(d.body);
    bytes(d.point);
    bytes(d.spring);
    for (double* number : {&d.omegaH, &d.limit, &d.safeStep}) bytes.raw(*number);
    bytes(d.message);
}

// Marks an island with points that began inside a collider. No name, with which all other islands begin, has such a
// length.
constexpr std::uint64_t insideMark = 0xfff8'7461'7574'0002ULL;

// Marks an island that may sleep; also different.
constexpr std::uint64_t sleepMark = 0xfff8'7461'7574'0007ULL;

}  // namespace

void Island::visitPlan(StateBytes& bytes) {
    for (mechanics::Spring& spring : plan_.springs)
        for (double* number : {&spring.stiffness, &spring.restLength, &spring.dampingTime}) bytes.notNegative(*number);
    for (std::size_t s = 0; s < plan_.broken.size(); ++s) {
        bool broken = plan_.broken[s];
        bytes(broken);
        plan_.broken[s] = broken;
    }
    for (auto& point : plan_.points) {
        bytes.notNegative(point.mass);
        bytes.require(plan_.solver.precision == Precision::double_ ? point.mass > 0
                                                                   : static_cast<float>(point.mass) > 0);
        bytes.notNegative(point.dragRate);
        bytes(point.held);
    }
    for (Body* body : plan_.bodies) visitPart(bytes, *body);
    bytes.each(plan_.grips, [&](Grip& grip) { visitPart(bytes, grip, plan_); });
    std::vector<bool> isLed(plan_.points.size(), false);
    for (const Grip& grip : plan_.grips) {
        if (!grip.rigid) continue;
        for (int i : grip.points) {
            bytes.require(!isLed[i]);
            isLed[i] = true;
        }
    }
}

void Island::visitInside(StateBytes& bytes) {
    const bool has = bytes.mark(insideMark, !insideWarnings_.empty() || !now_.inside.empty());
    if (bytes.isReading()) {
        now_.inside.clear();
        insideWarnings_.clear();
    }
    if (!has) return;
    bytes.list(now_.inside);
    for (int i : now_.inside) bytes.require(i >= 0 && i < static_cast<int>(plan_.points.size()));
    bytes.each(insideWarnings_, [&](std::string& warning) { bytes(warning); });
}

void Island::visitSleep(StateBytes& bytes) {
    const bool has = bytes.mark(sleepMark, plan_.solver.sleepError > 0);
    if (bytes.isReading()) {
        rest_ = {};
        sleep_ = {};
    }
    if (!has) return;
    bytes.require(plan_.solver.sleepError > 0);
    rest_.visit(bytes, plan_.points.size());
    bytes(sleep_.company);
    bytes.notNegative(sleep_.taken.energy);
    bytes(sleep_.taken.momentum);
}

void Island::visitStep(StateBytes& bytes) {
    bool follows = choice_.need.has_value();
    int substeps = now_.substeps;
    bool splits = choice_.splits;
    bytes(follows);
    int own = ownSubsteps_;
    bytes(own);
    bytes(parts_);
    bytes.require(parts_ > 0 && parts_ <= mostSubsteps);
    bytes(splits);
    bytes(substeps);
    bytes(now_.budget.factor);
    bytes(now_.budget.calmTicks);
    bytes.require(now_.budget.factor >= 1 && now_.budget.factor <= mostContactFactor && now_.budget.calmTicks >= 0);
    // Contact may have raised their number, which may be about to fall again.
    const bool isOwn = own == ownSubsteps_ && substeps > 0 && substeps <= mostSubsteps;
    if (follows != choice_.need.has_value() || (splits && !follows) || (!follows && !isOwn))
        misfit("the steps of " + plan_.bodies.front()->fullName() + " are others");
    bytes.each(now_.stepChanges, [&](StepChange& change) {
        bytes(change.time);
        bytes(change.from);
        bytes(change.to);
        bytes(change.isRepeated);
        bytes.require(change.from > 0 && change.from <= mostSubsteps && change.to > 0 && change.to <= mostSubsteps);
    });
    for (double* number : {&now_.budget.sum.added, &now_.budget.sum.atTouch, &now_.budget.most}) bytes.raw(*number);
    precision_.visit(bytes);
    if (!follows) {
        if (!bytes.isReading()) return;
        now_.substeps = substeps;
        now_.step = tickSeconds_ / substeps;
        dynamics_->setStep(now_.step);
        return;
    }
    double safety = choice_.need->safety;
    bytes(safety);
    if (safety != choice_.need->safety)
        misfit("the rule for the steps of " + plan_.bodies.front()->fullName() + " is another");
    now_.following.visit([&](auto& number) { bytes(number); });
    bytes.notNegative(choice_.need->moreOmega2);
    bytes.notNegative(choice_.need->others.rate);
    bytes.require(substeps > 0 && substeps <= mostSubsteps && now_.following.isSound());
    if (!bytes.isReading()) return;
    now_.substeps = substeps;
    now_.step = choice_.need->tickSeconds / substeps;
    // Splitting was decided when the island was made, perhaps with other springs.
    const bool isOther = splits != choice_.splits;
    choice_.splits = choice_.need->splits = splits;
    dynamics_->setStep(now_.step);
    if (!isOther) return;
    bytes.require(plan_.solver.integrator == "leapfrog");
    dynamics_->split(splits);
    dynamics_->start(0.0, now_.step);
}

void Island::visit(StateBytes& bytes) {
    const std::string name = plan_.bodies.front()->fullName();
    // The facts that must agree with the scene, and the steps.
    visitInside(bytes);
    visitSleep(bytes);
    bytes.expect(name, "the bodies are others");
    bytes.expect(plan_.solver.integrator, "the methods of its bodies are others");
    visitStep(bytes);
    auto springs = static_cast<std::uint64_t>(plan_.springs.size());
    bytes(springs);
    if (springs != plan_.springs.size()) misfit("the springs of " + name + " are others");
    // The plan, if changed; forces, constraints and the colliders that carry them.
    bytes(isChanged_);
    if (isChanged_) visitPlan(bytes);
    world::visit(bytes, forces_);
    for (auto& constraint : plan_.constraints) {
        std::shared_ptr<Constraint> changed = constraint->copy();
        changed->visit(bytes);
        constraint = std::move(changed);
    }
    for (Carrier& carrier : plan_.carriers) {
        bytes(carrier.path.place);
        for (glm::dquat* rotation : {&carrier.path.from, &carrier.path.to}) bytes(*rotation);
        bytes(carrier.path.t0);
        bytes(carrier.path.t1);
        bytes.require(carrier.path.t0 < carrier.path.t1);
    }
    // The moving points, and the state after the last tick.
    dynamics_->visit(bytes);
    bool isPending = changes_.any() || haveForcesJumped_;
    for (bool* flag : {&isOpen_, &isPending, &hasMoved_}) bytes(*flag);
    bytes.list(now_.contacts);
    for (const collision::Contact& contact : now_.contacts)
        bytes.require(
            contact.point >= 0 && contact.point < static_cast<int>(plan_.points.size()) && contact.friction >= 0 &&
            std::isfinite(glm::dot(contact.normal, contact.normal) + glm::dot(contact.carried, contact.carried)));
    visitPart(bytes, now_.pressed);
    for (const ContactAcceleration& one : now_.pressed)
        bytes.require(one.point >= 0 && one.point < static_cast<int>(plan_.points.size()) &&
                      std::isfinite(glm::dot(one.acceleration, one.acceleration)));
    for (std::string* warning : {&stretchWarning_, &collapseWarning_, &limitWarning_}) bytes(*warning);
    precision_.visitWarning(bytes);
    ode::Work done = work();
    for (std::int64_t* number : {&done.evaluations, &done.iterations, &done.unconverged}) bytes(*number);
    bytes.optional(frozen_, [&](FrozenIsland& frozen) {
        bytes.raw(frozen.time);
        visitPart(bytes, frozen.divergence);
    });
    if (!bytes.isReading()) return;
    // Makes the island anew from the values read.
    haveForcesJumped_ = false;  // the forces were set for these values; a pending jump is in isPending
    workElsewhere_ = done;
    bytes.require(!frozen_ || mayFreeze_);
    if (frozen_) {
        frozen_->name = name;
        for (const Body* body : plan_.bodies) frozen_->bodies.push_back(body->fullName());
    }
    dynamics_->take(Changes{}.add(Change::shape), forces_);
    if (isPending) changes_.add(Change::shape);
    yielding_.watch(plan_, *dynamics_);
}

}  // namespace taut::world
