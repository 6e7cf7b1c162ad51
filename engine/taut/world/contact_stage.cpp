#include "taut/world/contact_stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "taut/bodies/bare_faces.h"
#include "taut/contact/penetration.h"
#include "taut/core/parallel.h"

namespace taut::world {
namespace {

constexpr double longestInstant = 1.1e-3;  // [s] in which anything touches
constexpr int mostForWays = 64;            // instants of a tick, for what is fast
constexpr double calmWay = 4.0;     // of the distance kept, that neighbours may move in an instant without contact
constexpr double wayOfKeep = 0.35;  // of the distance kept, that two may approach in an instant

using Clock = std::chrono::steady_clock;  // of what is reported only

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool meetsColliders(const BodySpec& spec) {
    return spec.collide && (spec.meetsFaces || spec.touch != Touch::nothing);
}

bool isMet(const BodySpec& spec) {
    return spec.touch != Touch::nothing || meetsColliders(spec);
}

}  // namespace

int fewestInstants(double tickSeconds) {
    int instants = 1;
    while (instants < mostForWays && tickSeconds / instants > longestInstant) instants *= 2;
    return instants;
}

bool touches(const IslandPlan& plan) {
    return std::any_of(
        plan.bodies.begin(), plan.bodies.end(), [](const Body* body) { return isMet(*body->spec); });
}

contact::Surface surfaceOf(const Body& body, int offset, int bond) {
    const mechanics::Model& model = body.model;
    contact::Surface surface;
    surface.thickness = body.spec->thickness;
    surface.friction = body.spec->friction;
    surface.meetsItself = body.spec->touch == Touch::all;
    surface.meetsOthers = body.spec->touch != Touch::nothing;
    surface.meetsRigid = meetsColliders(*body.spec);
    surface.bond = bond;
    const auto at = [&](int i) { return offset + body.pointOf[static_cast<std::size_t>(i)]; };
    std::vector<std::array<int, 3>> triangles = model.triangles;
    const std::vector<std::array<int, 3>> bare = bareFaces(body);
    triangles.insert(triangles.end(), bare.begin(), bare.end());
    for (const std::array<int, 3>& t : triangles) surface.triangles.push_back({at(t[0]), at(t[1]), at(t[2])});
    std::vector<bool> isOutside(model.positions.size(), model.triangles.empty());
    for (const std::array<int, 3>& t : triangles)
        for (int i : t) isOutside[static_cast<std::size_t>(i)] = true;
    if (model.triangles.empty())
        for (const mechanics::Spring& s : model.springs)
            if (s.kind == mechanics::SpringKind::structural) surface.lines.push_back({at(s.a), at(s.b)});
    for (int i = 0; i < model.pointCount(); ++i)
        if (isOutside[static_cast<std::size_t>(i)]) surface.points.push_back(at(i));
    return surface;
}

ContactStage::ContactStage(std::span<const std::unique_ptr<Island>> islands, const ContactSpec& spec,
                           double tickSeconds, StepFollowing& pace,
                           const std::function<std::vector<TouchedCollider>()>& colliders)
    : spec_(spec), tickSeconds_(tickSeconds), fewest_(fewestInstants(tickSeconds)), pace_(pace) {
    std::vector<contact::Surface> surfaces;
    std::vector<dvec3> rest;
    for (const auto& island : islands) {
        if (!touches(island->plan())) continue;
        const int offset = static_cast<int>(rest.size());
        const std::vector<dvec3>& start = island->plan().positions;
        rest.insert(rest.end(), start.begin(), start.end());
        for (const Body* body : island->plan().bodies) {
            if (!isMet(*body->spec)) continue;
            surfaces.push_back(surfaceOf(*body, offset, static_cast<int>(islands_.size())));
            bodies_.push_back(body);
            for (std::size_t i = 0; i < body->pointOf.size(); ++i) {
                const int point = offset + body->pointOf[i];
                rest[static_cast<std::size_t>(point)] = body->model.positions[i] - jitterOf(*body, static_cast<int>(i));
            }
        }
        islands_.push_back(island.get());
        rooms_.push_back({island.get(), offset, static_cast<int>(rest.size())});
    }
    if (islands_.empty()) return;
    if (std::any_of(bodies_.begin(), bodies_.end(), [](const Body* body) { return meetsColliders(*body->spec); }))
        rigids_ = ColliderSurfaces(colliders(), surfaces, rest);
    for (auto* list : {&x0_, &x1_, &v_}) list->resize(rest.size());
    inverseMass_.resize(rest.size());
    damage_.assign(bodies_.size(), 0);
    contact::ContactOptions options;
    options.friction = spec.friction;
    group_ = std::make_unique<contact::ContactGroup>(std::move(surfaces), std::move(rest), options);
    rigids_.placeAll(x1_);
    x0_ = x1_;
}

double ContactStage::facePenetration(const std::function<bool(const Body&)>& wanted) {
    if (isEmpty() || rigids_.isEmpty()) return 0.0;
    return contact::penetrationOf(group_->elements(), crossings(), x1_,
                                  [&](int surface) { return isOfBody(surface) && wanted(bodyOf(surface)); });
}

void ContactStage::takeDamage() {
    bool isOther = false;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Body& body = *bodies_[s];
        const std::size_t severed = body.damage.edges().size();
        if (severed == damage_[s]) continue;
        damage_[s] = severed;
        isOther = true;
        int offset = 0;
        for (const Part& room : rooms_)
            if (room.island == body.island) offset = room.first;
        std::vector<int> own(static_cast<std::size_t>(body.island->plan().points.size()), -1);
        for (std::size_t i = 0; i < body.pointOf.size(); ++i)
            own[static_cast<std::size_t>(body.pointOf[i])] = static_cast<int>(i);
        group_->elements().setGone(
            static_cast<int>(s), [&](std::size_t triangle) { return body.damage.isTriangleGone(triangle); },
            [&](int a, int b) {
                return body.damage.isSevered(own[static_cast<std::size_t>(a - offset)],
                                             own[static_cast<std::size_t>(b - offset)]);
            });
    }
    if (!isOther) return;
    group_->elements().refresh();
    drop();
}

void ContactStage::readAll() {
    for (const Part& room : rooms_) {
        const auto first = static_cast<std::size_t>(room.first), count = static_cast<std::size_t>(room.last) - first;
        room.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
}

int ContactStage::commonSubsteps() const {
    int common = 0;
    for (const Island* island : islands_)
        if (island->frozen() == nullptr) common = std::gcd(common, island->substeps());
    return std::max(common, 1);
}

// What presses each other these surfaces need, of bodies or not: whatever else is in the group.
int ContactStage::instantsFor(std::span<const int> surfaces) const {
    int needed = 1;
    for (int s : surfaces)
        if (isOfBody(s) && bodyOf(s).island->frozen() == nullptr)
            needed = std::max(needed, bodyOf(s).island->instantsToPress());
    return needed;
}

// Whatever presses what, of those that move.
int ContactStage::mostInstants() const {
    int most = spec_.instants.value_or(fewest_);
    if (!spec_.instants)
        for (const Island* island : islands_)
            if (island->frozen() == nullptr) most = std::max(most, island->instantsToPress());
    return most;
}

// That many, or a few more: all bodies take their steps in as many parts.
int ContactStage::takeInstants(const TickTime& time, int needed) {
    if (pace_.isExceededBy(needed)) pace_.shorten(needed);
    for (Island* island : islands_) island->takeParts(time, pace_.substeps());
    const int common = commonSubsteps();
    int instants = std::min(needed, common);
    while (common % instants != 0) ++instants;
    return instants;
}

// How many the tick is to have; less than nothing where it is a trial, in which nothing should meet.
int ContactStage::chooseInstants(const TickTime& time) {
    if (spec_.instants) return takeInstants(time, *spec_.instants);
    const contact::Forecast forecast = group_->forecast(x1_, v_, inverseMass_, 1.0 / time.ticksPerSecond / fewest_);
    // As many as it takes for a way at that speed [m/s] to be no longer in any.
    const auto enough = [&](int instants, double speed, double way) {
        while (instants < mostForWays && tickSeconds_ * speed > instants * way) instants *= 2;
        return instants;
    };
    // Where nothing meets, by what is cheapest.
    if (!forecast.meets) {
        const int common = commonSubsteps();
        return -takeInstants(time, std::min(common, enough(1, forecast.deformationRate, calmWay)));
    }
    return takeInstants(time, enough(std::max(fewest_, instantsFor(forecast.surfaces)), forecast.closing,
                                     wayOfKeep * forecast.leastThickness));
}

std::optional<ContactStage::Outcome> ContactStage::tick(const TickTime& time, std::span<const ColliderMotion> moving) {
    for (Island* island : islands_) {
        island->takeParts(time, pace_.substeps());
        island->beginTick(time);
    }
    areCrossingsKnown_ = false;
    takeDamage();
    for (const Part& room : rooms_) {
        const IslandPlan& plan = room.island->plan();
        for (int i = room.first; i < room.last; ++i) {
            const int own = i - room.first;
            const bool moves = room.island->frozen() == nullptr && isFree(plan, own);
            inverseMass_[static_cast<std::size_t>(i)] =
                moves ? 1.0 / plan.points[static_cast<std::size_t>(own)].mass : 0.0;
        }
    }
    hasJumped_ = rigids_.lead(moving, tickSeconds_, group_->elements(), v_) || hasJumped_;
    readAll();
    rigids_.place(0.0, x1_);
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
    const auto start = Clock::now();
    group_->begin(x1_);
    // Steps that stay are such from the first tick on that anything may press anything.
    if (islands_.front()->keepsStep()) takeInstants(time, mostInstants());
    int instants = chooseInstants(time);
    total_.seconds += secondsSince(start);
    for (;;) {
        std::vector<std::optional<Fault>> faults(islands_.size());
        for (Island* island : islands_) island->beginTry();
        readAll();
        rigids_.place(0.0, x1_);
        const bool isTrial = instants < 0;
        instants_ = std::abs(instants);
        const bool isCoarse = tryTick(time, moving, instants_, faults, isTrial);
        std::vector<Verdict> verdicts(islands_.size(), Verdict::stands);
        bool isAgain = isCoarse;
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            if (isCoarse) continue;
            verdicts[k] = islands_[k]->judge(time, faults[k]);
            if (verdicts[k] == Verdict::fails) {
                if (islands_[k]->plan().solver.onDivergence != OnDivergence::freeze)
                    return Outcome{islands_[k], *faults[k]};
                islands_[k]->freeze(*faults[k], time);
                verdicts[k] = Verdict::stands;
                const Part& room = rooms_[k];
                std::fill(inverseMass_.begin() + room.first, inverseMass_.begin() + room.last, 0.0);
                isAgain = true;  // the others, beside it as it stays
            }
            isAgain = isAgain || verdicts[k] == Verdict::again;
        }
        if (!isAgain) break;
        for (std::size_t k = 0; k < islands_.size(); ++k) islands_[k]->tryAgain(time, verdicts[k]);
        std::swap(x0_, x1_);
        readAll();
        rigids_.place(0.0, x1_);
        group_->rewind(x0_, x1_);
        instants = isCoarse ? takeInstants(time, std::max({fewest_, 2 * instants_, instantsFor(result_.surfaces)}))
                            : chooseInstants(time);
    }
    for (Island* island : islands_) island->endTick(time);
    bear();
    pace_.lengthenIfCalm(islands_.front()->keepsStep() ? mostInstants() : instants_);
    total_.instants += instants_;
    ++total_.ticks;
    return std::nullopt;
}

bool ContactStage::movesAny() const {
    return std::any_of(
        islands_.begin(), islands_.end(), [](const Island* island) { return !island->frozen(); });
}

// Whether an instant was too long for what it found: of a trial anything at all, else what went deep. Where nothing
// moves no shorter one finds less.
bool ContactStage::isTooCoarse(bool isTrial) const {
    if (spec_.instants || !movesAny()) return false;
    if (instants_ < instantsFor(result_.surfaces) || (isTrial && result_.active > 0)) return true;
    return instants_ < mostForWays && (result_.deepest > wayOfKeep || result_.slides > 0);
}

// Ends early where there have to be more instants, and then returns true.
bool ContactStage::tryTick(const TickTime& time, std::span<const ColliderMotion> moving, int instants,
                           std::vector<std::optional<Fault>>& faults, bool isTrial) {
    const double h = tickSeconds_ / instants;
    for (int c = 0; c < instants; ++c) {
        std::swap(x0_, x1_);
        core::parallelFor(
            static_cast<int>(islands_.size()),
            [&](int k) { return islands_[static_cast<std::size_t>(k)]->callsBack(); },
            [&](int k) {
                const auto own = static_cast<std::size_t>(k);
                faults[own] = islands_[own]->advance(time, moving, c, instants);
            });
        if (std::any_of(faults.begin(), faults.end(), [](const auto& fault) { return fault.has_value(); }))
            return false;
        readAll();
        rigids_.place(static_cast<double>(c + 1) / instants, x1_);
        meet(h);
        settle();
        if (findFaults(time.at(c + 1, instants), faults)) return false;
        if (isTooCoarse(isTrial)) return true;
    }
    return false;
}

void ContactStage::meet(double h) {
    held_.clear();
    for (const Part& room : rooms_)
        for (const collision::Contact& c : room.island->contacts())
            held_.push_back({room.first + c.point, c.normal, glm::dot(c.normal, c.carried), c.carried, c.friction});
    contact::Instant instant;
    instant.h = h;
    instant.x0 = x0_;
    instant.x1 = x1_;
    instant.v = v_;
    instant.inverseMass = inverseMass_;
    instant.held = held_;
    instant.take = [&](std::span<const int> points) {
        std::vector<int> own;
        std::vector<dvec3> x, v;
        for (const Part& room : rooms_) {
            const auto first = std::lower_bound(points.begin(), points.end(), room.first);
            const auto last = std::lower_bound(first, points.end(), room.last);
            if (first == last) continue;
            own.clear();
            x.clear();
            v.clear();
            for (auto i = first; i != last; ++i) {
                own.push_back(*i - room.first);
                x.push_back(x1_[static_cast<std::size_t>(*i)]);
                v.push_back(v_[static_cast<std::size_t>(*i)]);
            }
            room.island->place(own, x, v);
            for (std::size_t k = 0; k < own.size(); ++k) {
                x1_[static_cast<std::size_t>(own[k] + room.first)] = x[k];
                v_[static_cast<std::size_t>(own[k] + room.first)] = v[k];
            }
        }
    };
    vBefore_ = v_;
    const auto start = Clock::now();
    result_ = group_->resolve(instant);
    total_.seconds += secondsSince(start);
    total_.locatedInAll += static_cast<std::int64_t>(group_->testedCount());
    hasMet_ = hasMet_ || result_.active > 0;
    total_.slides += result_.slides;
    total_.zones += result_.zones;
    total_.uncertified += result_.uncertified;
}

// What contact gave points that constraints tie is shared, so that others go elsewhere too.
void ContactStage::settle() {
    for (const Part& room : rooms_) {
        if (!room.island->settle()) continue;
        const auto first = static_cast<std::size_t>(room.first), count = static_cast<std::size_t>(room.last) - first;
        room.island->read(std::span(x1_).subspan(first, count), std::span(v_).subspan(first, count));
    }
}

// Whether contact left any point without bounds, of whose islands nothing is to go on.
bool ContactStage::findFaults(double t, std::vector<std::optional<Fault>>& faults) const {
    bool areAny = false;
    for (int i : result_.moved) {
        const dvec3 &x = x1_[static_cast<std::size_t>(i)], &v = v_[static_cast<std::size_t>(i)];
        const double square = glm::dot(v, v);
        const bool isNumber = std::isfinite(square + glm::dot(x, x));
        if (isNumber && square < mechanics::speedLimit * mechanics::speedLimit) continue;
        for (std::size_t k = 0; k < rooms_.size(); ++k)
            if (i >= rooms_[k].first && i < rooms_[k].last && !faults[k])
                faults[k] = Fault{.point = i - rooms_[k].first, .time = t, .isNumber = isNumber, .byContact = true};
        areAny = true;
    }
    return areAny;
}

// What the last instant gave.
void ContactStage::bear() {
    const double h = tickSeconds_ / instants_;
    std::vector<ContactAcceleration> pressed;
    auto moved = result_.moved.begin();
    for (const Part& room : rooms_) {
        pressed.clear();
        for (; moved != result_.moved.end() && *moved < room.last; ++moved) {
            const auto i = static_cast<std::size_t>(*moved);
            pressed.push_back({*moved - room.first, (v_[i] - vBefore_[i]) / h});
        }
        room.island->bear(pressed);
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
    info.mostInstants = mostInstants();
    info.lastInstants = instants_;
    info.located = static_cast<int>(group_->testedCount());
    info.pressing = result_.active;
    info.lists = static_cast<std::int64_t>(group_->listsMade());
    info.bytes = group_->bytes();
    return info;
}

std::vector<contact::ContactPoint> ContactStage::contacts() const {
    if (isEmpty()) return {};
    return group_->contactPoints(x1_);
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
