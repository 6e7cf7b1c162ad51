#include "taut/island/island.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/spec/motion.h"

namespace taut::world {
namespace {

constexpr int mostToPress = 1024;  // instants of a tick: who has more steps is warned of them
constexpr int leastParts = 4;  // of a tick of bodies that touch others, whatever their method bears

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
    if (choice_.need)
        following_ = StepFollowing((*choice_.need)(now), choice_.need->safety, static_cast<int>(ticksPerSecond));
    if (choice_.splits) dynamics_->split(true);
    ownSubsteps_ = choice_.substeps;
    shortensForContact_ = !keepsStep && !plan_.solver.dt;
    dynamics_->start(t, choice_.step);
    foreseeFreezing(t);
    for (const Since moment : {Since::tick, Since::step}) dynamics_->keep(moment);
    watchPlasticity();
    mayFreeze_ = plan_.solver.onDivergence == OnDivergence::freeze;
    isChanged_ = !plan_.grips.empty();  // they go on ways that the scene alone does not tell
    hasCells_ = std::any_of(plan_.bodies.begin(), plan_.bodies.end(),
                            [](const Body* body) { return !body->model.cells.empty(); });
}

void Island::setColliders(collision::Colliders colliders, std::span<const std::string> names) {
    colliders_ = std::move(colliders);
    mayCollide_ = colliders_.size() > 0 &&
                  std::any_of(plan_.bodies.begin(), plan_.bodies.end(), [](const Body* b) { return b->spec->collide; });
    if (!mayCollide_) contacts_.clear();
    // Without restitution an impact takes ½ m v² from its point and its shift adds ½ k (v h)², which is less while
    // ω h < 1, and at the limits little enough for the sum to stay below 2 % (measured on stiff nets).
    const bool takesMore =
        method().symplectic && !colliders_.bounces() && (choice_.need || choice_.step <= choice_.limit * (1 + 1e-9));
    dynamics_->watchContacts(mayCollide_ && !takesMore);
    if (!hasLooked_ && mayCollide_) findInside(names);
    hasLooked_ = true;
}

// Points that come out within a step at that speed anyway do not count.
void Island::findInside(std::span<const std::string> names) {
    for (const Body* body : plan_.bodies) {
        if (!body->spec->collide) continue;
        std::vector<int> count(names.size(), 0);
        std::vector<double> depth(names.size(), 0.0);
        for (int i = body->firstPoint; i < body->lastPoint; ++i) {
            const collision::Colliders::Inside at = colliders_.inside(position(i));
            if (at.depth <= emergingSpeed * choice_.step) continue;
            inside_.push_back(i);
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
    if (frozen_) return std::nullopt;
    for (;;) {
        beginTry();
        auto fault = advance(time, moving, 0, 1);
        const Verdict verdict = judge(time, fault);
        if (verdict == Verdict::fails) return fault;
        if (verdict == Verdict::stands) break;
        tryAgain(time, verdict);
    }
    endTick(time);
    return std::nullopt;
}

void Island::beginTick(const TickTime& time) {
    keepGiven();
    if (mayFreeze_ && frozen_) return;
    TAUT_EXPECTS(!isOpen_);
    hasMoved_ = true;
    takeParts(time, parts_);
    keepTouches();
    tries_ = {};
}

void Island::beginTry() {
    if (frozen_) return;
    keepSteps();
    contacts_.clear();
    dynamics_->takeContactWork();  // of a try that others gave up
}

std::optional<Fault> Island::advance(const TickTime& time, std::span<const ColliderMotion> moving, int part,
                                     int parts) {
    if (frozen_) return std::nullopt;
    TAUT_EXPECTS(choice_.substeps % parts == 0);
    const int each = choice_.substeps / parts;
    return takeSubsteps(time, moving, part * each, (part + 1) * each);
}

void Island::endTick(const TickTime& time) {
    if (frozen_) return;
    if (hasCells_) watchVolumes(time.at(1, 1));
    watchFreezing(time);
}

Verdict Island::judge(const TickTime& time, std::optional<Fault>& fault) {
    if (frozen_) return Verdict::stands;
    if (choice_.need || shortensForContact_) return judgeSteps(time, fault);
    if (fault) return Verdict::fails;
    account(dynamics_->takeContactWork());
    return Verdict::stands;
}

// A tick stands in steps so short that they are within the bound of the state at its end, and contact adds little
// energy.
Verdict Island::judgeSteps(const TickTime& time, std::optional<Fault>& fault) {
    constexpr int mostRescues = 3;  // of a tick that diverges, perhaps because the state has stiffened within it
    constexpr int fairTrial = 3;    // doublings of steps, after which contact should add less
    if (fault && !choice_.need) return Verdict::fails;
    const ContactWork work = dynamics_->takeContactWork();
    bool isTooLong = fault.has_value();
    double need = 2.0 * following_.substeps();
    if (!fault && choice_.need) {
        need = (*choice_.need)(dynamics_->fastestNow());
        isTooLong = following_.isExceededBy(need / contactFactor_);
    }
    // Where shorter steps have not helped, still shorter ones will not.
    const bool isInVain = tries_.doublings >= fairTrial && work.added > 0.75 * tries_.addedFirst;
    if (!isTooLong && (isInVain || !addsTooMuch(work))) {
        if (isInVain) contactFactor_ = std::max(1, contactFactor_ >> tries_.doublings);
        if (choice_.need) following_.lengthenIfCalm(need);
        account(work);
        return Verdict::stands;
    }
    if (fault && (!fault->isNumber || ++tries_.rescues > mostRescues || need > mostSubsteps)) return Verdict::fails;
    if (!isTooLong) {
        contactFactor_ *= 2;
        calmTicks_ = 0;
        if (tries_.doublings++ == 0) tries_.addedFirst = work.added;
    } else if (need <= mostSubsteps) {
        following_.shorten(need);
        while (contactFactor_ > 1 && wantedSubsteps() > mostSubsteps) contactFactor_ /= 2;
    } else {
        fault = Fault{.point = 0, .time = time.at(1, 1), .isTooStiff = true};
        return Verdict::fails;
    }
    return Verdict::again;
}

void Island::tryAgain(const TickTime& time, Verdict verdict) {
    if (frozen_) return;
    const StepFollowing following = following_;
    const int factor = contactFactor_, calmTicks = calmTicks_;
    undoTick();
    if (verdict != Verdict::again) return;
    following_ = following;
    contactFactor_ = factor;
    calmTicks_ = calmTicks;
    dynamics_->synchronise(time.start(), contacts_, pressed_);
    startWith(time, wantedSubsteps(), true);
}

// While nothing presses it; few substeps become a power of two.
int Island::inParts(int substeps) const {
    if (substeps >= quietParts_) return (substeps + quietParts_ - 1) / quietParts_ * quietParts_;
    int parts = plan_.solver.dt ? 1 : std::min(quietParts_, leastParts);
    while (parts < substeps) parts *= 2;
    return parts;
}

int Island::instantsToPress() const {
    const int substeps = quietSubsteps();
    if (!std::isfinite(choice_.limit)) return substeps;
    const double turn = choice_.mode.omega * tickSeconds_ / substeps;
    const int each = turn < longestTurn ? static_cast<int>(std::min(longestTurn / turn, 1.0 * substeps)) : 1;
    return std::clamp((substeps + each - 1) / each, quietParts_, std::max(quietParts_, mostToPress));
}

void Island::takeParts(const TickTime& time, int parts) {
    parts_ = parts;
    if (frozen_ || wantedSubsteps() == choice_.substeps) return;
    dynamics_->synchronise(time.start(), contacts_, pressed_);
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

void Island::keepTouches() {
    before_.contacts = contacts_;
    before_.pressed = pressed_;
    before_.inside = inside_;
    before_.hasTouched = hasTouched_;
    before_.contactWork = contactWork_;
    before_.mostContactWork = mostContactWork_;
}

void Island::keepSteps() {
    dynamics_->keep(Since::tick);
    before_.following = following_;
    before_.contactFactor = contactFactor_;
    before_.calmTicks = calmTicks_;
    before_.stepChanges = stepChanges_.size();
    before_.substeps = choice_.substeps;
    before_.step = choice_.step;
}

void Island::undoTick() {
    dynamics_->goBack(Since::tick);
    takeBackGiven();
    contacts_ = before_.contacts;
    pressed_ = before_.pressed;
    inside_ = before_.inside;
    hasTouched_ = before_.hasTouched;
    contactWork_ = before_.contactWork;
    mostContactWork_ = before_.mostContactWork;
    following_ = before_.following;
    contactFactor_ = before_.contactFactor;
    calmTicks_ = before_.calmTicks;
    stepChanges_.resize(before_.stepChanges);
    choice_.substeps = before_.substeps;
    choice_.step = before_.step;
    dynamics_->setStep(choice_.step);
}

void Island::startWith(const TickTime& time, int substeps, bool isRepeated) {
    if (substeps != choice_.substeps) stepChanges_.push_back({time.start(), choice_.substeps, substeps, isRepeated});
    choice_.substeps = substeps;
    choice_.step = 1.0 / time.ticksPerSecond / substeps;
    dynamics_->start(time.start(), choice_.step);
    ticksToLook_ = 0;
}

// Contacts are those of the last of them.
std::optional<Fault> Island::takeSubsteps(const TickTime& time, std::span<const ColliderMotion> moving, int first,
                                          int last) {
    contacts_.clear();
    for (int s = first; s < last; ++s) {
        const auto end = [&] { return time.at(s + 1, choice_.substeps); };
        if (mayFreeze_) dynamics_->keep(Since::step);
        if (mayCollide_) dynamics_->rememberPositions();
        dynamics_->step(time.at(s, choice_.substeps));
        if (!dynamics_->isBounded()) return giveUp(end());
        if (mayCollide_) {
            moveColliders(moving, s);
            const bool isLast = s + 1 == last;
            const bool touches = dynamics_->collide(colliders_, isLast ? &contacts_ : nullptr);
            hasTouched_ = hasTouched_ || touches;
            if (!inside_.empty()) {
                dynamics_->emerge(colliders_, inside_);
                contactWork_.atTouch = energyAtTouch(dynamics_->takeContactWork());  // no step added it, but the start
            }
            const bool settles = touches && dynamics_->settle();
            if (touches && !(settles ? dynamics_->isBounded() : dynamics_->isTouchedBounded())) return giveUp(end());
        }
        if (mayFreeze_)
            if (const auto fault = overstrained(end())) return fault;
        if (mayGiveWay_) giveWay();  // of steps that stand
    }
    return std::nullopt;
}

void Island::moveColliders(std::span<const ColliderMotion> moving, int substep) {
    const double n = choice_.substeps;
    for (const ColliderMotion& m : moving)
        colliders_.move(m.collider, between(m.from, m.to, substep / n), between(m.from, m.to, (substep + 1) / n));
}

void Island::freeze(const Fault& fault, const TickTime& time) {
    dynamics_->goBack(Since::step);
    contacts_.clear();
    pressed_.clear();
    FrozenIsland frozen;
    frozen.name = plan_.bodies.front()->fullName();
    for (const Body* body : plan_.bodies) frozen.bodies.push_back(body->fullName());
    frozen.time = fault.time - choice_.step;
    frozen.divergence = diagnose(fault, time);
    frozen_ = std::move(frozen);
}

Fault Island::giveUp(double t) const {
    const std::vector<dvec3> v = dynamics_->velocities();
    int fastest = -1;
    double most = -1;
    for (int i = 0; i < static_cast<int>(v.size()); ++i) {
        const double speed = glm::length(v[static_cast<std::size_t>(i)]);
        const bool isHeld = plan_.points[static_cast<std::size_t>(i)].held;  // 0 times what is infinite
        if (!std::isfinite(speed) && !isHeld) return {.point = i, .time = t, .isNumber = false};
        if (speed > most) fastest = i;
        most = std::max(most, speed);
    }
    return {.point = fastest, .time = t};
}

// The spring furthest from its rest length, if that is further than freezing allows. Springs of bending span two
// cells and tell nothing that the others do not.
std::optional<Fault> Island::overstrained(double t) {
    Fault fault;
    dynamics_->positions(x_);
    for (std::size_t i = 0; i < plan_.springs.size(); ++i) {
        const mechanics::Spring& s = plan_.springs[i];
        if (s.kind == mechanics::SpringKind::bend || !(s.restLength > 0) || plan_.broken[i]) continue;
        const double strain = std::abs(lengthOf(s, x_) - s.restLength) / s.restLength;
        if (strain <= std::max(fault.strain, plan_.solver.freezeStrain)) continue;
        fault.strain = strain;
        fault.point = plan_.points[static_cast<std::size_t>(s.a)].held ? s.b : s.a;
    }
    if (fault.point < 0) return std::nullopt;
    fault.time = t;
    return fault;
}

// Beyond the working stretch a step that stays may not hold, and a collapsed cell may not come back: each said once.
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

}  // namespace taut::world
