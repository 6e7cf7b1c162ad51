#include "taut/world/private/contact_stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "taut/core/private/parallel.h"

namespace taut::world {
namespace {

constexpr double longestStep = 1.1e-3;  // [s] of contact with deformable bodies
constexpr int stepsOfBlock = 2;         // of the longest ones, in a block of the usual length
constexpr int mostStepsForSpeed = 64;   // in a tick
constexpr int mostGrowth = 2;           // of a block after a calm one, times the usual length
constexpr int freeGrowth = 4;           // of a block after one without rows, times the usual length
// Of two sides from one another or past, times their thickness:
constexpr double mostWay = 3.0;  // in a block, and in a step
constexpr double calmWay = 1.0;  // in a block of which the next one is longer, and in any block where something bounces
// Of an element past a solid in a block: the solid stands on the rows of such elements.
constexpr double mostWayOnSolid = 0.2;

using Clock = std::chrono::steady_clock;  // for reports only

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

int fewestSteps(double tickSeconds) {
    int steps = 1;
    while (tickSeconds / steps > longestStep) steps *= 2;
    return steps;
}

std::optional<std::pair<int, int>> ContactStage::sidesOf(const contact::Crossing& crossing) const {
    int a = elements().edges()[static_cast<std::size_t>(crossing.edge)].surface;
    int b = elements().triangles()[static_cast<std::size_t>(crossing.triangle)].surface;
    if (elements().isRigid(a)) return std::nullopt;
    if (!isOfBody(a) || (isOfBody(b) && sortsBefore(bodyOf(b), bodyOf(a)))) std::swap(a, b);
    return std::pair{a, b};
}

double ContactStage::depthOf(const contact::Crossing& crossing) const {
    const auto at = [&](std::size_t k) { return position(crossing.points[k]); };
    const dvec3 normal = glm::cross(at(3) - at(2), at(4) - at(2));
    const double size = std::sqrt(glm::dot(normal, normal));
    if (!(size > 0)) return 0;
    const double a = std::abs(glm::dot(normal, at(0) - at(2))), b = std::abs(glm::dot(normal, at(1) - at(2)));
    return std::min(a, b) / size;
}

void ContactStage::readAll() {
    for (const Part& part : parts_) {
        const auto first = static_cast<std::size_t>(part.first), count = static_cast<std::size_t>(part.last) - first;
        part.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
    group_->carried().follow(x1_, v_);
}

int ContactStage::commonSubsteps() const {
    int common = 0;
    for (const Island* island : islands_)
        if (!island->isStill()) common = std::gcd(common, island->substeps());
    return std::max(common, 1);
}

// Whether bodies of an island give back a part of an impact among themselves.
bool ContactStage::bounces(const Island& island) const {
    return spec_.restitution > 0 &&
           std::any_of(
               island.plan().bodies.begin(), island.plan().bodies.end(),
               [](const Body* body) { return body->spec->facesMeet() && body->spec->restitution > 0; });
}

// How many steps any body may need, whatever touches.
int ContactStage::mostSteps() const {
    int most = fewest_;
    for (const Island* island : islands_)
        if (!island->isStill()) most = std::max(most, island->stepsToPress(bounces(*island)));
    return most;
}

// Makes the islands' substeps a multiple of the pace, which has room for `steps` -> steps_, these or a few more.
void ContactStage::takeSteps(const TickTime& time, int steps) {
    room_ = steps;
    if (pace_.isExceededBy(room_)) pace_.shorten(room_);
    for (Island* island : islands_) island->takeParts(time, pace_.substeps());
    const int common = commonSubsteps();
    steps_ = std::min(steps, common);
    while (common % steps_ != 0) ++steps_;
}

// Whether a surface may meet anything in this tick, by boxes (surfaces) of ways.
bool ContactStage::isNearAny(int surface, std::span<const core::Aabb> boxes) const {
    if (elements().surface(surface).meetsItself || elements().surface(surface).meetsShapes ||
        bodyOf(surface).spec->meetsCollidersAsWhole())
        return true;
    for (std::size_t other = 0; other < boxes.size(); ++other)
        if (static_cast<int>(other) != surface && elements().mayTouch(surface, static_cast<int>(other)) &&
            boxes[other].overlaps(boxes[static_cast<std::size_t>(surface)], 0.0))
            return true;
    return false;
}

// The number of steps of the tick: as many as the stiffest body needs that may meet another -> steps_.
void ContactStage::chooseSteps(const TickTime& time) {
    const std::vector<contact::ContactSurface>& surfaces = elements().surfaces();
    std::vector<core::Aabb> boxes(surfaces.size());
    std::vector<double> speeds(surfaces.size(), 0.0);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        for (const int i : surfaces[s].points) {
            const auto k = static_cast<std::size_t>(i);
            boxes[s].add(x1_[k]);
            boxes[s].add(x1_[k] + tickSeconds_ * v_[k]);
            speeds[s] = std::max(speeds[s], glm::dot(v_[k], v_[k]));
        }
        boxes[s].grow(2 * surfaces[s].thickness);
    }
    int steps = 1;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Island& island = *bodies_[s]->island;
        if (island.isStill() || !isNearAny(static_cast<int>(s), boxes)) continue;
        steps = std::max(steps, island.stepsToPress(bounces(island)));
        const double way = mostWay * surfaces[s].thickness, speed = std::sqrt(speeds[s]);
        while (steps < mostStepsForSpeed && tickSeconds_ * speed > steps * way) steps *= 2;
    }
    takeSteps(time, steps);
}

// Updates damage, masses, colliders and places.
void ContactStage::beginTick(const TickTime& time, std::span<const ColliderMotion> moving) {
    for (Island* island : islands_) {
        island->takeParts(time, pace_.substeps());
        island->beginTick(time);
    }
    areCrossingsKnown_ = false;
    weight_ = 0;
    for (const Island* island : islands_) {
        const dvec3 gravity = island->dynamics().gravity(time.start());
        weight_ = std::max(weight_, std::sqrt(glm::dot(gravity, gravity)));
    }
    takeDamage();
    takeMasses();
    hasJumped_ = colliders_.move(moving, time.end(), tickSeconds_, group_->elements(), v_) || hasJumped_;
    convex_.move(moving, tickSeconds_);
    readAll();
    colliders_.place(0.0, x1_);
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
}

std::optional<ContactStage::Outcome> ContactStage::tick(const TickTime& time, std::span<const ColliderMotion> moving,
                                                        bool watchesFriction) {
    if (isAtRest()) {
        hasJumped_ = colliders_.move(moving, time.end(), tickSeconds_, group_->elements(), v_) || hasJumped_;
        convex_.move(moving, tickSeconds_);
        return std::nullopt;
    }
    beginTick(time, moving);

    // Crossings, and the number of steps. An island that keeps its step needs the largest number from the first tick.
    const auto start = Clock::now();
    group_->begin(x1_, keptForces_);
    if (anySleeps()) wakeCrossed(time);
    if (islands_.front()->keepsStep())
        takeSteps(time, mostSteps());
    else
        chooseSteps(time);
    total_.seconds += secondsSince(start);

    // Tries until one stands.
    for (;;) {
        std::vector<std::optional<Fault>> faults(islands_.size());
        for (Island* island : islands_) island->beginTry();
        readAll();
        colliders_.place(0.0, x1_);
        presses_.assign(watchesFriction ? x1_.size() : 0, {});
        pressing_.clear();
        footholds_.clear();
        reached_.clear();
        pressed_.clear();
        for (const Part& part : parts_)
            for (const ContactAcceleration& one : part.island->pressed())
                pressed_.push_back({part.first + one.point, one.acceleration});
        takeBlocks(time, moving, faults);
        std::vector<TickVerdict> verdicts(islands_.size(), TickVerdict::stands);

        // Judges the try. Each island has a say. If one diverged it may be frozen, and the others go on beside it.
        bool isAgain = !reached_.empty();
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            if (!reached_.empty()) continue;
            verdicts[k] = islands_[k]->judge(time, faults[k]);
            if (verdicts[k] == TickVerdict::fails) {
                if (islands_[k]->plan().solver.onDivergence != OnDivergence::freeze)
                    return Outcome{islands_[k], *faults[k]};
                islands_[k]->freeze(*faults[k], time);
                verdicts[k] = TickVerdict::stands;
                const Part& part = parts_[k];
                std::fill(inverseMass_.begin() + part.first, inverseMass_.begin() + part.last, 0.0);
                isAgain = true;
            }
            isAgain = isAgain || verdicts[k] == TickVerdict::again;
        }
        if (!isAgain) break;

        // Goes back to the start of the tick.
        for (std::size_t k = 0; k < islands_.size(); ++k) islands_[k]->tryAgain(time, verdicts[k]);
        readAll();
        colliders_.place(0.0, x1_);
        group_->rewind(x1_, keptForces_);
        if (!reached_.empty()) wake(time, reached_);
        if (!islands_.front()->keepsStep()) chooseSteps(time);
    }

    // Ends the tick.
    for (Island* island : islands_) island->endTick(time);
    keptForces_.assign(group_->keptForces().begin(), group_->keptForces().end());
    reportAccelerations();
    pace_.lengthenIfCalm(islands_.front()->keepsStep() ? mostSteps() : room_);
    total_.detections += blocks_;
    mostBlocks_ = std::max(mostBlocks_, blocks_);
    ++total_.ticks;
    return std::nullopt;
}

// One try of the tick, block by block. Ends early on a fault, and where something that sleeps is reached.
void ContactStage::takeBlocks(const TickTime& time, std::span<const ColliderMotion> moving,
                              std::vector<std::optional<Fault>>& faults) {
    blocks_ = 0;
    const int wanted = spec_.detections.value_or(std::max(1, fewest_ / stepsOfBlock)),
              usual = (steps_ + wanted - 1) / wanted;
    for (int first = 0, last = 0, longest = usual; first < steps_; first = last, ++blocks_) {
        xStart_ = x1_;
        last = std::min(first + longest, steps_);
        for (int step = first; step < last; ++step) {
            std::swap(x0_, x1_);
            vStart_ = v_;
            if (!advance(time, moving, step, step + 1, faults)) return;
            if (step == first) last = first + openBlock(time, step, last - first, usual);
            // Without rows there are no impulses until the block ends.
            if (!group_->hasRows()) {
                pressed_.clear();
                if (step + 1 < last && !advance(time, moving, step + 1, last, faults)) return;
                break;
            }
            vBefore_ = v_;
            group_->step({x0_, x1_, v_, vStart_});
            if (!presses_.empty()) addPresses();
            if (!presses_.empty() && !wholes_.empty()) addFootholds();
            if (anySleeps() && findReached()) return;
            takeAccelerations();
            settle();
            if (findFaults(time.at(step + 1, steps_), faults)) return;
            if (group_->hasBounced()) last = step + 1;  // it does not go where it was expected
        }
        closeBlock();
        xStart_ = x1_;
        if (findFaults(time.at(last, steps_), faults)) return;
        longest = nextLength(last - first, usual);
    }
}

// How many steps the next block may have, after one of so many. A block that is cut short has looked too far ahead, for
// far too many pairs.
int ContactStage::nextLength(int steps, int usual) const {
    const double way = group_->wayOfStep();
    const int calm = (group_->hasRows() ? mostGrowth : freeGrowth) * usual;
    if (!spec_.detections && !mayRoll() && way * calm < calmWay) return calm;
    const int most = std::min(usual, 2 * steps);
    return way * most > mostWayOfPair() ? std::max(1, static_cast<int>(mostWayOfPair() / way)) : most;
}

// Of two sides from one another in a block, over their thickness.
double ContactStage::mostWayOfPair() const {
    return spec_.restitution > 0 ? calmWay : mostWay;
}

// Whether a body in contact may roll.
bool ContactStage::mayRoll() const {
    return std::any_of(
               rigidPairs_.begin(), rigidPairs_.end(),
               [](const auto& pair) { return pair.kind == contact::ContactConstraint::Kind::contact; }) ||
           std::any_of(
               kinematic_.begin(), kinematic_.end(),
               [](const auto& contact) { return contact.isWhole && contact.used().size() == 1; });
}

// The islands take these steps without contact. Returns false on a fault.
bool ContactStage::advance(const TickTime& time, std::span<const ColliderMotion> moving, int first, int last,
                           std::vector<std::optional<Fault>>& faults) {
    core::parallelFor(
        static_cast<int>(islands_.size()), [&](int k) { return islands_[static_cast<std::size_t>(k)]->callsBack(); },
        [&](int k) {
            const auto own = static_cast<std::size_t>(k);
            for (int step = first; step < last && !faults[own]; ++step)
                faults[own] = islands_[own]->advance(time, moving, step, steps_);
        });
    if (std::any_of(faults.begin(), faults.end(), [](const auto& fault) { return fault.has_value(); })) return false;
    readAll();
    colliders_.place(static_cast<double>(last) / steps_, x1_);
    return true;
}

// The ways of a step of h [s] -> ways_. The islands have taken it without contact, which presses as in the last step;
// but an impact does not last, so it turns back no more than forces have changed.
void ContactStage::findWays(double h) {
    ways_.resize(x1_.size());
    for (std::size_t i = 0; i < ways_.size(); ++i) ways_[i] = x1_[i] - x0_[i];
    for (const ContactAcceleration& one : pressed_) {
        const auto k = static_cast<std::size_t>(one.point);
        const double forced = length(ways_[k] - h * vStart_[k]), push = h * h * length(one.acceleration);
        if (push > 0) ways_[k] += std::min(1.0, forced / push) * h * h * one.acceleration;
    }
}

// Begins a block of so many steps, after the first of them, which tells where all of them lead. Returns how many it
// has: fewer where something is fast.
int ContactStage::openBlock(const TickTime& time, int step, int steps, int usual) {
    const auto start = Clock::now();
    const double h = tickSeconds_ / steps_;
    findWays(h);
    const auto lookAhead = [&](double ahead) {
        ahead_.resize(x1_.size());
        for (std::size_t i = 0; i < ahead_.size(); ++i) ahead_[i] = x0_[i] + ahead * ways_[i];
    };
    lookAhead(steps);
    kinematic_.clear();
    for (const Part& part : parts_)
        for (const collision::Contact& c :
             part.island->isStill() ? std::span<const collision::Contact>{} : part.island->contacts())
            kinematic_.push_back({.points = {part.first + c.point, -1, -1},
                                  .normal = c.normal,
                                  .speed = glm::dot(c.normal, c.carried),
                                  .carried = c.carried,
                                  .friction = c.friction});
    if (!wholes_.empty()) addWholeContacts(h, (steps - 1) * h);
    const double from = static_cast<double>(step) / steps_;
    findTouches(x0_, ahead_, from, std::min(1.0, from + static_cast<double>(steps) / steps_));
    placePivots(time.at(step, steps_));
    addTouches();
    addJoints(time.at(step, steps_));
    const int longest = steps;
    if (mayRoll()) steps = std::min(steps, usual);  // normals turn with what rolls
    for (const ElementTouch& touch : elementTouches_)
        if (const double most = (touch.solid < 0 ? calmWay : mostWayOnSolid) * touch.thickness;
            touch.speed * h * steps > most)
            steps = std::max(1, static_cast<int>(most / (touch.speed * h)));
    if (steps < longest) lookAhead(steps);
    std::stable_sort(kinematic_.begin(), kinematic_.end(),
                     [](const auto& a, const auto& b) { return a.point() < b.point(); });
    contact::Block block;
    block.h = h;
    block.steps = steps;
    block.x0 = xStart_;
    block.ahead = ahead_;
    block.inverseMass = inverseMass_;
    block.kinematic = kinematic_;
    block.rigid = rigidPairs_;
    block.restSpeed = 2.0 * weight_ * steps * h;  // as with colliders
    block.place = [this](std::span<const int> points) { place(points); };
    block.mostWay = mostWayOfPair();
    const int taken = group_->open(block);
    total_.testedPairs += static_cast<std::int64_t>(group_->testedCount());
    total_.seconds += secondsSince(start);
    return taken;
}

void ContactStage::closeBlock() {
    const auto start = Clock::now();
    constexpr int mostRounds = 4;
    bool moves = group_->close(x1_, v_);
    // The certificate has the last word; the next step brings together what it has pulled off a constraint.
    for (int round = 0; round < mostRounds && moves && settle(); ++round) moves = group_->certify(x1_, v_);
    group_->finish(x1_);
    const contact::BlockResult& result = group_->result();
    hadImpulse_ = hadImpulse_ || result.impulses > 0;
    total_.slides += result.slides;
    total_.zones += result.zones;
    total_.uncertified += result.uncertified;
    total_.seconds += secondsSince(start);
}

// Islands place the points that contact moved and return where these came to be.
void ContactStage::place(std::span<const int> points) {
    std::vector<int> own;
    std::vector<dvec3> x, v;
    for (const Part& part : parts_) {
        const auto first = std::lower_bound(points.begin(), points.end(), part.first);
        const auto last = std::lower_bound(first, points.end(), part.last);
        if (first == last) continue;
        own.clear();
        x.clear();
        v.clear();
        for (auto i = first; i != last; ++i) {
            own.push_back(*i - part.first);
            x.push_back(x1_[static_cast<std::size_t>(*i)]);
            v.push_back(v_[static_cast<std::size_t>(*i)]);
        }
        part.island->place(own, x, v);
        for (std::size_t k = 0; k < own.size(); ++k) {
            x1_[static_cast<std::size_t>(own[k] + part.first)] = x[k];
            v_[static_cast<std::size_t>(own[k] + part.first)] = v[k];
        }
    }
}

// Constraints inside islands share the changes by contact, which moves further points.
bool ContactStage::settle() {
    bool hasMoved = false;
    for (const Part& part : parts_) {
        if (!part.island->settle()) continue;
        hasMoved = true;
        const auto first = static_cast<std::size_t>(part.first), count = static_cast<std::size_t>(part.last) - first;
        part.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
    if (hasMoved) group_->carried().follow(x1_, v_);
    return hasMoved;
}

// Whether contact gave a point a place or velocity that is not finite or too fast: a fault of its island.
bool ContactStage::findFaults(double t, std::vector<std::optional<Fault>>& faults) const {
    bool areAny = false;
    for (int i : group_->result().moved) {
        const dvec3 &x = x1_[static_cast<std::size_t>(i)], &v = v_[static_cast<std::size_t>(i)];
        const double square = glm::dot(v, v);
        const bool isNumber = std::isfinite(square + glm::dot(x, x));
        if (isNumber && square < mechanics::speedLimit * mechanics::speedLimit) continue;
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (i >= parts_[k].first && i < parts_[k].last && !faults[k])
                faults[k] = Fault{.point = i - parts_[k].first, .time = t, .isNumber = isNumber, .byContact = true};
        areAny = true;
    }
    return areAny;
}

// The accelerations by contact in this step, before constraints share them -> pressed_.
void ContactStage::takeAccelerations() {
    pressed_.clear();
    for (const int i : group_->result().moved) {
        const auto k = static_cast<std::size_t>(i);
        pressed_.push_back({i, (v_[k] - vBefore_[k]) * (steps_ / tickSeconds_)});
    }
}

// Gives the islands those of the last step.
void ContactStage::reportAccelerations() {
    std::vector<ContactAcceleration> own;
    auto next = pressed_.begin();
    for (const Part& part : parts_) {
        own.clear();
        for (; next != pressed_.end() && next->point < part.last; ++next)
            own.push_back({next->point - part.first, next->acceleration});
        part.island->bear(own);
    }
}

ContactInfo ContactStage::info() const {
    ContactInfo info = total_;
    if (isEmpty()) return info;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        info.bodies.push_back(bodies_[s]->fullName());
        const int surface = static_cast<int>(s);
        info.surfaces.push_back({elements().surface(surface).thickness, elements().shortestEdge(surface)});
    }
    info.points = static_cast<int>(x1_.size());
    info.mostDetections = mostBlocks_;
    info.lastDetections = blocks_;
    info.lastTestedPairs = static_cast<int>(group_->testedCount());
    info.lastImpulses = group_->result().impulses;
    info.bytes = group_->bytes();
    return info;
}

std::vector<int> ContactStage::squeezed() const {
    std::vector<int> points;
    for (const auto& [point, rank] : group_->squeezed()) points.push_back(point);
    return points;
}

std::vector<contact::ContactPoint> ContactStage::contacts() const {
    if (isEmpty()) return {};
    std::vector<contact::ContactPoint> all = group_->contactPoints(x1_);
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3&) {
        const contact::KinematicContact& own = kinematic_[k];
        if (!own.isWhole) return;
        const dvec3 place = x1_[static_cast<std::size_t>(own.point())] + own.arm;
        all.push_back({place, own.normal, normal, elements().surfaceOf(own.point()), noSurface});
    });
    return all;
}

std::span<const contact::Crossing> ContactStage::crossingsBefore() const {
    if (isEmpty()) return {};
    return group_->crossings();
}

const std::vector<contact::Crossing>& ContactStage::crossings() {
    if (isEmpty()) return crossings_;
    takeDamage();
    if (areCrossingsKnown_) return crossings_;
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
    readAll();
    crossings_ = group_->crossingsAt(x1_);
    areCrossingsKnown_ = true;
    return crossings_;
}

}  // namespace taut::world
