#include "taut/island/private/island.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/island/private/island_report.h"
#include "taut/plan/constraint.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/private/motion.h"

namespace taut::world {
namespace {

constexpr int mostToPress = 1024;  // steps of contact in a tick
constexpr int leastParts = 4;      // of a tick of bodies that touch others, even if their method allows longer steps

std::string insideWarning(const Body& body, const std::string& collider, int points, double depth) {
    char text[200];
    std::snprintf(text, sizeof text, ": %d of its points start inside ", points);
    std::string warning = body.fullName() + text + collider;
    std::snprintf(text, sizeof text, ", up to %.3g m deep; they come out at %g m/s: move the body or the collider",
                  depth, emergingSpeed);
    return warning + text;
}

}  // namespace

Island::Island(IslandPlan plan, const ForceList& forces, const Envelope& envelope, double ticksPerSecond, double t,
               bool keepsStep, int parts)
    : tickSeconds_(1.0 / ticksPerSecond),
      keepsStep_(keepsStep),
      quietParts_(parts),
      plan_(std::move(plan)),
      forces_(forces) {
    dynamics_ = makeDynamics(plan_, forces_);
    const mechanics::FastestNow now = dynamics_->fastestNow();
    choice_ = chooseStep(
        envelope,
        envelope.isStatic ? dynamics_->stabilityShare(t)
                          : makeDynamics(envelope.plan, envelope.forces)->stabilityShare(t),
        1.0 / ticksPerSecond,
        [&] {
            std::vector<double> inverseMasses = inverseMassesOf(plan_);
            const std::vector<bool> isHeld = heldPointsOf(plan_);
            for (std::size_t i = 0; i < isHeld.size(); ++i)
                if (isHeld[i]) inverseMasses[i] = 0;
            return mechanics::leastFrequency(inverseMasses, stiffnessAt(plan_.positions));
        },
        keepsStep ? nullptr : &now, [&](int substeps) { return inParts(substeps); });
    now_.substeps = choice_.substeps;
    now_.step = choice_.step;
    if (choice_.need)
        now_.following = StepFollowing((*choice_.need)(now), choice_.need->safety, static_cast<int>(ticksPerSecond));
    if (choice_.splits) dynamics_->split(true);
    ownSubsteps_ = now_.substeps;
    shortensForContact_ = !keepsStep && !plan_.solver.dt;
    dynamics_->start(t, now_.step);
    precision_.foresee(plan_, *dynamics_, t, tickSeconds_, now_.step, choice_.limitingSpring);
    for (const Since moment : {Since::tick, Since::step}) dynamics_->keep(moment);
    yielding_.watch(plan_, *dynamics_);
    mayFreeze_ = plan_.solver.onDivergence == OnDivergence::freeze;
    isChanged_ = !plan_.grips.empty();  // grips follow paths that the scene alone does not tell
    hasCells_ = std::any_of(plan_.bodies.begin(), plan_.bodies.end(),
                            [](const Body* body) { return !body->model.cells.empty(); });
}

void Island::setColliders(collision::Colliders colliders, std::span<const std::string> names) {
    colliders_ = std::move(colliders);
    mayCollide_ = colliders_.size() > 0 &&
                  std::any_of(plan_.bodies.begin(), plan_.bodies.end(), [](const Body* b) { return b->spec->collide; });
    if (!mayCollide_) now_.contacts.clear();
    // Without restitution an impact takes ½ m v² from its point, and its shift adds ½ k (v h)². That is less while ω h
    // < 1. At the limits it is little enough for the sum to stay below 2 % (measured on stiff nets).
    const bool takesMore =
        method().symplectic && !colliders_.bounces() && (choice_.need || now_.step <= choice_.limit * (1 + 1e-9));
    dynamics_->watchContacts(mayCollide_ && !takesMore);
    if (!hasLooked_ && mayCollide_) findInside(names);
    hasLooked_ = true;
}

// Points that come out within one step at emergingSpeed do not count.
void Island::findInside(std::span<const std::string> names) {
    for (const Body* body : plan_.bodies) {
        if (!body->spec->collide || body->spec->meetsCollidersAsWhole()) continue;
        std::vector<int> count(names.size(), 0);
        std::vector<double> depth(names.size(), 0.0);
        for (int i = body->firstPoint; i < body->lastPoint; ++i) {
            const collision::Colliders::Inside at = colliders_.inside(position(i));
            if (at.depth <= emergingSpeed * now_.step) continue;
            now_.inside.push_back(i);
            if (!isFree(plan_, i)) continue;
            const auto c = static_cast<std::size_t>(at.collider);
            ++count[c];
            depth[c] = std::max(depth[c], at.depth);
        }
        for (std::size_t c = 0; c < names.size(); ++c)
            if (count[c] > 0) insideWarnings_.push_back(insideWarning(*body, names[c], count[c], depth[c]));
    }
}

std::optional<Fault> Island::tick(const TickTime& time, std::span<const ColliderMotion> moving) {
    beginTick(time);
    if (isStill()) return std::nullopt;
    for (;;) {
        beginTry();
        auto fault = advance(time, moving, 0, 1);
        const TickVerdict verdict = judge(time, fault);
        if (verdict == TickVerdict::fails) return fault;
        if (verdict == TickVerdict::stands) break;
        tryAgain(time, verdict);
    }
    endTick(time);
    return std::nullopt;
}

void Island::beginTick(const TickTime& time) {
    yielding_.keep();
    if ((mayFreeze_ && frozen_) || isAsleep()) return;
    TAUT_EXPECTS(!isOpen_);
    hasMoved_ = true;
    takeParts(time, parts_);
    tries_ = {};
}

void Island::beginTry() {
    if (isStill()) return;
    dynamics_->keep(Since::tick);
    before_ = now_;
    dynamics_->forgetImpulses();
    tieLoad_.begin(plan_);
    dynamics_->takeContactWork();  // drops the work of a try that other islands gave up
}

std::optional<Fault> Island::advance(const TickTime& time, std::span<const ColliderMotion> moving, int part,
                                     int parts) {
    if (isStill()) return std::nullopt;
    TAUT_EXPECTS(now_.substeps % parts == 0);
    const int each = now_.substeps / parts;
    return takeSubsteps(time, moving, part * each, (part + 1) * each);
}

void Island::endTick(const TickTime& time) {
    if (isStill()) return;
    if (hasCells_) watchVolumes(time.at(1, 1));
    precision_.look(plan_, *dynamics_, tickSeconds_, now_.step, choice_.limitingSpring);
}

TickVerdict Island::judge(const TickTime& time, std::optional<Fault>& fault) {
    if (isStill()) return TickVerdict::stands;
    if (choice_.need || shortensForContact_) return judgeSteps(time, fault);
    if (fault) return TickVerdict::fails;
    now_.budget.add(dynamics_->takeContactWork(), tickSeconds_);
    return TickVerdict::stands;
}

// A tick stands if its steps are within the bound of the state at its end and if contact adds little energy.
TickVerdict Island::judgeSteps(const TickTime& time, std::optional<Fault>& fault) {
    constexpr int mostRescues = 3;  // of a diverging tick, as the state may have stiffened within it
    constexpr int fairTrial = 3;    // doublings of substeps, after which contact should add less
    if (fault && !choice_.need) return TickVerdict::fails;
    const ContactWork work = dynamics_->takeContactWork();
    bool isTooLong = fault.has_value();
    double need = 2.0 * now_.following.substeps();
    if (!fault && choice_.need) {
        mechanics::FastestNow fastest = dynamics_->fastestNow();
        fastest.omega2 += dynamics_->turning(time.at(1, 1), tickSeconds_);
        need = (*choice_.need)(fastest);
        isTooLong = now_.following.isExceededBy(need / now_.budget.factor);
    }
    // If shorter steps have not helped, still shorter ones will not either.
    const bool isInVain = tries_.doublings >= fairTrial && work.added > 0.75 * tries_.addedFirst;
    if (!isTooLong && (isInVain || !addsTooMuch(work))) {
        if (isInVain) now_.budget.factor = std::max(1, now_.budget.factor >> tries_.doublings);
        if (choice_.need) now_.following.lengthenIfCalm(need);
        now_.budget.add(work, tickSeconds_);
        return TickVerdict::stands;
    }
    // Infinite velocities are hopeless. With constraints they may mean a step that turns too far, and shorter steps
    // help.
    const bool isHopeless = fault && !fault->isNumber && plan_.constraints.empty();
    if (fault && (isHopeless || ++tries_.rescues > mostRescues || need > mostSubsteps)) return TickVerdict::fails;
    if (!isTooLong) {
        now_.budget.factor *= 2;
        now_.budget.calmTicks = 0;
        if (tries_.doublings++ == 0) tries_.addedFirst = work.added;
    } else if (need <= mostSubsteps) {
        now_.following.shorten(need);
        while (now_.budget.factor > 1 && wantedSubsteps() > mostSubsteps) now_.budget.factor /= 2;
    } else {
        fault = Fault{.point = 0, .time = time.at(1, 1), .isTooStiff = true};
        return TickVerdict::fails;
    }
    return TickVerdict::again;
}

void Island::tryAgain(const TickTime& time, TickVerdict verdict) {
    if (isStill()) return;
    const StepFollowing following = now_.following;
    const ContactBudget budget = now_.budget;
    undoTick();
    if (verdict != TickVerdict::again) return;
    // The new steps outlive the undone try.
    now_.following = following;
    now_.budget.factor = budget.factor;
    now_.budget.calmTicks = budget.calmTicks;
    dynamics_->synchronise(time.start(), now_.contacts);
    startWith(time, wantedSubsteps(), true);
}

// For a tick without pressure. Small numbers of substeps become a power of two.
int Island::inParts(int substeps) const {
    if (substeps >= quietParts_) return (substeps + quietParts_ - 1) / quietParts_ * quietParts_;
    int parts = plan_.solver.dt ? 1 : std::min(quietParts_, leastParts);
    while (parts < substeps) parts *= 2;
    return parts;
}

int Island::stepsToPress(bool bounces) const {
    const int substeps = quietSubsteps();
    if (bounces || !std::isfinite(choice_.limit)) return substeps;
    const double turn = choice_.mode.omega * tickSeconds_ / ownSubsteps_;
    const int each = turn < longestTurn ? static_cast<int>(std::min(longestTurn / turn, 1.0 * substeps)) : 1;
    return std::clamp((substeps + each - 1) / each, quietParts_, std::max(quietParts_, mostToPress));
}

void Island::takeParts(const TickTime& time, int parts) {
    parts_ = parts;
    if (isStill() || wantedSubsteps() == now_.substeps) return;
    dynamics_->synchronise(time.start(), now_.contacts);
    startWith(time, wantedSubsteps(), false);
}

void Island::read(std::span<dvec3> x, std::span<dvec3> v) const {
    dynamics_->positions(x);
    if (frozen_)
        std::fill(v.begin(), v.end(), dvec3(0.0));
    else
        dynamics_->velocities(v);
}

void Island::place(std::span<const int> points, std::span<dvec3> x, std::span<dvec3> v) {
    dynamics_->place(mayCollide_ ? &colliders_ : nullptr, points, x, v);
}

void Island::undoTick() {
    if (isAsleep()) return;
    dynamics_->goBack(Since::tick);
    yielding_.undo(plan_, *dynamics_, forces_);
    now_ = before_;
    dynamics_->setStep(now_.step);
}

void Island::startWith(const TickTime& time, int substeps, bool isRepeated) {
    if (substeps != now_.substeps) now_.stepChanges.push_back({time.start(), now_.substeps, substeps, isRepeated});
    now_.substeps = substeps;
    now_.step = 1.0 / time.ticksPerSecond / substeps;
    dynamics_->start(time.start(), now_.step);
    precision_.restart();
}

// Keeps the contacts of the last substep.
std::optional<Fault> Island::takeSubsteps(const TickTime& time, std::span<const ColliderMotion> moving, int first,
                                          int last) {
    now_.contacts.clear();
    for (int s = first; s < last; ++s) {
        const auto end = [&] { return time.at(s + 1, now_.substeps); };
        if (mayFreeze_) dynamics_->keep(Since::step);
        if (mayCollide_) dynamics_->rememberPositions();
        dynamics_->step(time.at(s, now_.substeps));
        if (!dynamics_->isBounded()) return giveUp(end());
        if (mayCollide_) {
            moveColliders(moving, s);
            const bool isLast = s + 1 == last;
            const bool touches = dynamics_->collide(colliders_, isLast ? &now_.contacts : nullptr);
            now_.hasTouched = now_.hasTouched || touches;
            if (!now_.inside.empty()) {
                dynamics_->emerge(colliders_, now_.inside);
                now_.budget.sum.atTouch =
                    now_.budget.energyAtTouch(dynamics_->takeContactWork());  // the start added it, not a step
            }
            const bool settles = touches && dynamics_->settle();
            if (touches && !(settles ? dynamics_->isBounded() : dynamics_->isTouchedBounded())) return giveUp(end());
        }
        if (mayFreeze_)
            if (const auto fault = overstrained(end())) return fault;
        if (yielding_.isOn() && yielding_.giveWay(plan_, *dynamics_, forces_))
            isChanged_ = true;  // only of steps that stand
        if (tieLoad_.isOn()) tieLoad_.add(plan_, *dynamics_, end());
    }
    return std::nullopt;
}

void Island::moveColliders(std::span<const ColliderMotion> moving, int substep) {
    const double n = now_.substeps;
    for (const ColliderMotion& m : moving)
        colliders_.move(m.collider, between(m.from, m.to, substep / n), between(m.from, m.to, (substep + 1) / n));
}

void Island::freeze(const Fault& fault, const TickTime& time) {
    dynamics_->goBack(Since::step);
    now_.contacts.clear();
    now_.pressed.clear();
    FrozenIsland frozen;
    frozen.name = plan_.bodies.front()->fullName();
    for (const Body* body : plan_.bodies) frozen.bodies.push_back(body->fullName());
    frozen.time = fault.time - now_.step;
    frozen.divergence = diagnose(*this, fault, time);
    frozen_ = std::move(frozen);
}

Fault Island::giveUp(double t) const {
    const std::vector<dvec3> v = dynamics_->velocities();
    int fastest = -1;
    double most = -1;
    for (int i = 0; i < static_cast<int>(v.size()); ++i) {
        const double speed = glm::length(v[i]);
        const bool isHeld = plan_.points[i].held;  // 0 times infinity is no number
        if (!std::isfinite(speed) && !isHeld) return {.point = i, .time = t, .isNumber = false};
        if (speed > most) fastest = i;
        most = std::max(most, speed);
    }
    return {.point = fastest, .time = t};
}

// Finds the spring furthest from its rest length, if that is further than freezing allows. Bending springs span two
// cells and add no information.
std::optional<Fault> Island::overstrained(double t) {
    Fault fault;
    dynamics_->positions(x_);
    for (std::size_t i = 0; i < plan_.springs.size(); ++i) {
        const mechanics::Spring& s = plan_.springs[i];
        if (s.kind == mechanics::SpringKind::bend || !(s.restLength > 0) || plan_.broken[i]) continue;
        const double strain = std::abs(lengthOf(s, x_) - s.restLength) / s.restLength;
        if (strain <= std::max(fault.strain, plan_.solver.freezeStrain)) continue;
        fault.strain = strain;
        fault.point = plan_.points[s.a].held ? s.b : s.a;
    }
    if (fault.point < 0) return std::nullopt;
    fault.time = t;
    return fault;
}

// Beyond the working stretch a fixed step may not hold, and a collapsed cell may not recover. Each is
// reported once.
void Island::watchVolumes(double t) {
    const bool stretches = !choice_.need && stretchWarning_.empty();
    if (!stretches && !collapseWarning_.empty()) return;
    char text[200];
    for (const auto& [body, report] : dynamics_->volumes(t, stretches)) {
        if (report.overstretched > 0) {
            std::snprintf(text, sizeof text,
                          ": stretched beyond working_stretch at %.3f s; raise it if the block diverges", t);
            stretchWarning_ = plan_.bodies.front()->fullName() + text;
        }
        if (report.collapsed > 0 && collapseWarning_.empty()) {
            std::snprintf(text, sizeof text,
                          ": squashed to %.2g of its volume in a cell at %.3f s (%d cells below a tenth, %d turned "
                          "inside out); raise bulk_Pa or young_Pa",
                          report.smallestRatio, t, report.collapsed, report.inverted);
            collapseWarning_ = plan_.bodies.front()->fullName() + text;
        }
    }
}

// Changes between two ticks.

void Island::open(const TickTime& time) {
    if (isOpen_) return;
    if (!isStill()) dynamics_->synchronise(time.start(), now_.contacts);
    isOpen_ = true;
}

void Island::close(const TickTime& time) {
    if (!isOpen_) return;
    TAUT_EXPECTS(!isAsleep());
    rest_ = {};
    if (changes_.any()) {
        dynamics_->take(changes_, forces_);
        yielding_.watch(plan_, *dynamics_);
        watchLimit(time.start());
    }
    if (choice_.need) {
        if (changes_.any() || haveForcesJumped_)
            choice_.need->raise(dynamics_->stabilityShare(time.start()), inverseMassesOf(plan_));
        const double need = (*choice_.need)(dynamics_->fastestNow());
        if (now_.following.isExceededBy(need)) now_.following.shorten(need);
    }
    startWith(time, wantedSubsteps(), false);
    changes_.reset();
    haveForcesJumped_ = false;
    isOpen_ = false;
}

IslandPlan& Island::change(const TickTime& time, Change what) {
    open(time);
    changes_.add(what);
    isChanged_ = true;
    return plan_;
}

void Island::push(const TickTime& time, std::span<const int> points, const dvec3& velocity) {
    open(time);
    const std::vector<dvec3> v = dynamics_->velocities();
    for (int i : points) dynamics_->setVelocity(i, v[i] + velocity);
}

void Island::stop(const TickTime& time, std::span<const int> points) {
    open(time);
    for (int i : points) dynamics_->setVelocity(i, dvec3(0.0));
}

void Island::lead(const TickTime& time, const std::string& hand, const mechanics::PosePath& path, bool bends) {
    if (frozen_) return;
    for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
        if (plan_.grips[g].ofCollider || plan_.grips[g].holder != hand) continue;
        if (bends) open(time);
        setPath(g, path);
    }
}

void Island::carry(const TickTime& time, const std::string& collider, const mechanics::PosePath& path) {
    if (frozen_) return;
    for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
        if (!plan_.grips[g].ofCollider || plan_.grips[g].holder != collider) continue;
        if (!goesOn(plan_.grips[g].path, path, time.start())) open(time);
        setPath(g, path);
    }
    for (Carrier& carrier : plan_.carriers) {
        if (carrier.collider != collider) continue;
        if (isAsleep() && !goesOn(carrier.path, path, time.start())) open(time);
        carrier.path = path;
    }
}

void Island::release(const TickTime& time, const std::function<bool(const JointTie&)>& wanted) {
    if (frozen_) return;
    for (std::size_t t = 0; t < plan_.ties.size(); ++t)
        if (wanted(plan_.ties[t]) && holds(plan_, plan_.ties[t])) letGo(change(time, Change::shape), t);
}

void Island::beginConstraints(const TickTime& time) {
    if (frozen_) return;
    for (std::size_t c = 0; c < plan_.constraints.size(); ++c) {
        if (!plan_.constraints[c]->isDue(time.start())) continue;
        change(time, Change::shape);
        std::shared_ptr<Constraint> begun = plan_.constraints[c]->copy();
        dynamics_->positions(x_);
        begun->begin(time.start(), x_);
        plan_.constraints[c] = std::move(begun);
    }
}

std::vector<bool> Island::overloaded() const {
    return tieLoad_.isOn() && !isStill() ? tieLoad_.overloaded(plan_, *dynamics_, tickSeconds_)
                                         : std::vector<bool>(plan_.ties.size(), false);
}

void Island::setPath(std::size_t grip, const mechanics::PosePath& path) {
    plan_.grips[grip].path = path;
    // The dynamics take over new grips with their paths later.
    if (!changes_.has(Change::grips)) dynamics_->leadGrip(grip);
}

void Island::setForces(const TickTime& time, const ForceList& forces) {
    if (frozen_) return;
    const bool jumps = isAsleep() || !goesOn(forces_, forces);
    if (jumps) open(time);  // with the forces so far
    haveForcesJumped_ = haveForcesJumped_ || jumps;
    forces_ = forces;
    if (jumps)
        dynamics_->setForces(forces_);
    else
        dynamics_->steer(forces_);
}

// A change during the run may lower the limit below a fixed step; that is reported once. The limit does not depend on
// rest lengths.
void Island::watchLimit(double t) {
    if (choice_.need || changes_ == Changes{}.add(Change::lengths) || !limitWarning_.empty() ||
        !(now_.step <= choice_.limit))
        return;
    const double limit = stepLimit(plan_, dynamics_->stabilityShare(t));
    if (now_.step <= limit * (1 + 1e-6)) return;  // single precision computes the share slightly differently
    limitWarning_ = plan_.bodies.front()->fullName() + ": since " + inSeconds(t) + " its step of " +
                    inSeconds(now_.step) + " is over the stability limit, which has fallen to " + inSeconds(limit) +
                    ": it may diverge; a shorter dt, or [hand] in the scene, allows for it";
}

std::vector<dvec3> Island::velocities(const TickTime& time) {
    if (frozen_) return std::vector<dvec3>(plan_.points.size(), dvec3(0.0));
    if (isOpen_ || isAsleep()) return dynamics_->velocities();
    // A query changes nothing, and its work does not count for the run.
    workElsewhere_ += dynamics_->work();
    std::vector<dvec3> v = dynamics_->velocitiesAt(time.start(), now_.contacts, now_.pressed);
    workElsewhere_ -= dynamics_->work();
    return v;
}

bool Island::addsTooMuch(const ContactWork& work) const {
    if (!shortensForContact_ || now_.budget.factor >= mostContactFactor || 2 * now_.substeps > mostSubsteps)
        return false;
    return now_.budget.isExceededBy(work);
}

StepChoice Island::choice() const {
    StepChoice choice = choice_;
    choice.substeps = now_.substeps;
    choice.step = now_.step;
    return choice;
}

ode::Work Island::work() const {
    ode::Work sum = workElsewhere_;
    return sum += dynamics_->work();
}

mechanics::StiffnessProduct Island::stiffnessAt(std::span<const dvec3> x) const {
    return [this, x](std::span<const dvec3> in, std::span<dvec3> sum) {
        mechanics::addSpringStiffness(plan_.springs, x, in, sum);
        dynamics_->addStiffnessProduct(in, sum);
    };
}

std::vector<std::string> Island::said() const {
    std::vector<std::string> all = insideWarnings_;
    for (const std::string& warning : {stretchWarning_, collapseWarning_, limitWarning_, precision_.warning()})
        if (!warning.empty()) all.push_back(warning);
    return all;
}

}  // namespace taut::world
