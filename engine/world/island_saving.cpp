// An island as bytes. What is as the scene builds it is not written: of a plan that nothing has changed, nothing.
#include <algorithm>
#include <cmath>

#include "taut/world/byte_parts.h"
#include "taut/world/cutting.h"
#include "taut/world/island_of.h"

namespace taut::world {
namespace {

using core::ByteReader;
using core::ByteWriter;

void addForces(ByteWriter& bytes, const IslandForces& forces) {
    addPath(bytes, forces.gravity);
    bytes.add(static_cast<std::uint64_t>(forces.winds.size()));
    for (const WindOn& wind : forces.winds) {
        addPath(bytes, wind.velocity);
        const mechanics::WindSettings& s = wind.settings;
        for (double number : {s.airDensity, s.drag, s.lift, s.gust.amplitude, s.gust.period, s.gust.length})
            bytes.add(number);
        bytes.add(s.gust.seed);
    }
    bytes.add(static_cast<std::uint64_t>(forces.anchors.size()));
    for (const AnchorOn& anchor : forces.anchors) {
        addPath(bytes, anchor.place);
        bytes.add(anchor.stiffness);
        bytes.add(anchor.damping);
    }
}

void readForces(ByteReader& bytes, IslandForces& forces) {
    forces.gravity = path(bytes);
    require(bytes.number<std::uint64_t>() == forces.winds.size());
    for (WindOn& wind : forces.winds) {
        wind.velocity = path(bytes);
        mechanics::WindSettings& s = wind.settings;
        for (double* number : {&s.airDensity, &s.drag, &s.lift, &s.gust.amplitude, &s.gust.period, &s.gust.length})
            *number = finite(bytes);
        s.gust.seed = bytes.number<std::int64_t>();
    }
    require(bytes.number<std::uint64_t>() == forces.anchors.size());
    for (AnchorOn& anchor : forces.anchors) {
        anchor.place = path(bytes);
        anchor.stiffness = notNegative(bytes);
        anchor.damping = notNegative(bytes);
    }
}

void addGrip(ByteWriter& bytes, const Grip& grip) {
    bytes.add(grip.hand);
    bytes.add(grip.rigid);
    bytes.addList<int>(grip.points);
    bytes.addList<dvec3>(grip.offsets);
    bytes.addList<double>(grip.stiffness);
    bytes.addList<double>(grip.damping);
    addPath(bytes, grip.path);
}

Grip readGrip(ByteReader& bytes, std::size_t pointCount) {
    Grip grip;
    grip.hand = bytes.text();
    grip.rigid = bytes.number<bool>();
    grip.points = bytes.list<int>();
    grip.offsets = bytes.list<dvec3>();
    grip.stiffness = bytes.list<double>();
    grip.damping = bytes.list<double>();
    grip.path = path(bytes);
    const std::size_t count = grip.points.size(), forces = grip.rigid ? 0 : count;
    require(count > 0 && grip.offsets.size() == count && grip.stiffness.size() == forces &&
            grip.damping.size() == forces);
    for (std::size_t i = 0; i < count; ++i)
        require(grip.points[i] > (i == 0 ? -1 : grip.points[i - 1]) &&
                static_cast<std::size_t>(grip.points[i]) < pointCount);
    for (const std::vector<double>* list : {&grip.stiffness, &grip.damping})
        for (double number : *list) require(number >= 0 && std::isfinite(number));
    return grip;
}

void addBody(ByteWriter& bytes, const Body& body) {
    bytes.add(static_cast<std::uint64_t>(body.damage.edges().size()));
    for (const auto& [edge, share] : body.damage.edges()) {
        bytes.add(edge.first);
        bytes.add(edge.second);
        bytes.add(share);
    }
    bytes.add(body.model.cells.empty() ? 0.0 : body.model.cells.front().bulkModulus);
    for (const auto& limit : {body.plasticity.yieldStrain, body.plasticity.breakStrain}) {
        bytes.add(limit.has_value());
        bytes.add(limit.value_or(0.0));
    }
}

void readBody(ByteReader& bytes, Body& body) {
    body.damage = {};
    const auto edges = bytes.number<std::uint64_t>();
    for (std::uint64_t i = 0; i < edges; ++i) {
        const int a = bytes.number<int>(), b = bytes.number<int>();
        const double share = bytes.number<double>();
        require(a >= 0 && a < b && b < body.model.pointCount() && share >= 0 && share <= 1);
        body.damage.sever(a, b, share);
    }
    body.damage.assess(body.model);
    const double bulk = notNegative(bytes);
    for (mechanics::VolumeCell& cell : body.model.cells) cell.bulkModulus = bulk;
    for (auto* limit : {&body.plasticity.yieldStrain, &body.plasticity.breakStrain}) {
        const bool has = bytes.number<bool>();
        const double value = notNegative(bytes);
        *limit = has ? std::optional<double>(value) : std::nullopt;
    }
}

void addDivergence(ByteWriter& bytes, const Divergence& d) {
    bytes.add(d.tick);
    bytes.add(d.time);
    bytes.add(d.body);
    bytes.add(d.point);
    bytes.add(d.spring);
    for (double number : {d.omegaH, d.limit, d.safeStep}) bytes.add(number);
    bytes.add(d.message);
}

Divergence readDivergence(ByteReader& bytes) {
    Divergence d;
    d.tick = bytes.number<std::int64_t>();
    d.time = bytes.number<double>();
    d.body = bytes.text();
    d.point = bytes.number<int>();
    d.spring = bytes.text();
    for (double* number : {&d.omegaH, &d.limit, &d.safeStep}) *number = bytes.number<double>();
    d.message = bytes.text();
    return d;
}

template <class Real>
void readArray(ByteReader& bytes, core::AlignedArray<Real>& array) {
    const std::vector<Real> list = bytes.list<Real>();
    require(list.size() == array.size());
    std::copy(list.begin(), list.end(), array.begin());
}

}  // namespace

template <class Real>
void IslandOf<Real>::saveSprings(ByteWriter& bytes) const {
    for (const mechanics::Spring& spring : plan_.springs)
        for (double number : {spring.stiffness, spring.restLength, spring.dampingTime}) bytes.add(number);
    for (bool broken : plan_.broken) bytes.add(broken);
    for (const auto& point : plan_.points) {
        bytes.add(point.mass);
        bytes.add(point.dragRate);
        bytes.add(point.held);
    }
    for (const Body* body : plan_.bodies) addBody(bytes, *body);
    bytes.add(static_cast<std::uint64_t>(plan_.grips.size()));
    for (const Grip& grip : plan_.grips) addGrip(bytes, grip);
}

template <class Real>
void IslandOf<Real>::restoreSprings(ByteReader& bytes) {
    for (mechanics::Spring& spring : plan_.springs)
        for (double* number : {&spring.stiffness, &spring.restLength, &spring.dampingTime})
            *number = notNegative(bytes);
    for (std::size_t s = 0; s < plan_.broken.size(); ++s) plan_.broken[s] = bytes.number<bool>();
    for (auto& point : plan_.points) {
        point.mass = notNegative(bytes);
        require(static_cast<Real>(point.mass) > Real(0));
        point.dragRate = notNegative(bytes);
        point.held = bytes.number<bool>();
    }
    for (Body* body : plan_.bodies) readBody(bytes, *body);
    const auto grips = bytes.number<std::uint64_t>();
    plan_.grips.clear();
    std::vector<bool> isLed(plan_.points.size(), false);
    for (std::uint64_t g = 0; g < grips; ++g) {
        plan_.grips.push_back(readGrip(bytes, plan_.points.size()));
        if (!plan_.grips.back().rigid) continue;
        for (int i : plan_.grips.back().points) {
            require(!isLed[static_cast<std::size_t>(i)]);
            isLed[static_cast<std::size_t>(i)] = true;
        }
    }
}

template <class Real>
void IslandOf<Real>::save(ByteWriter& bytes) const {
    bytes.add(plan_.bodies.front()->fullName());
    bytes.add(plan_.solver.integrator);
    bytes.add(choice_.substeps);
    bytes.add(static_cast<std::uint64_t>(plan_.springs.size()));
    bytes.add(isChanged_);
    if (isChanged_) saveSprings(bytes);
    addForces(bytes, forces_);
    bytes.addList(std::span<const Real>(state_.x));
    bytes.addList(std::span<const Real>(state_.v));
    bytes.add(static_cast<std::uint64_t>(state_.memory.size()));
    for (const auto& array : state_.memory) bytes.addList(std::span<const Real>(array));
    for (bool flag : {isOpen_, isReshaped_, hasMoved_}) bytes.add(flag);
    bytes.addList<collision::Contact>(contacts_);
    for (const std::string& warning : {stretchWarning_, collapseWarning_, limitWarning_}) bytes.add(warning);
    const ode::Work done = work();
    for (std::int64_t number : {done.evaluations, done.iterations, done.unconverged}) bytes.add(number);
    bytes.add(frozen_.has_value());
    if (!frozen_) return;
    bytes.add(frozen_->time);
    addDivergence(bytes, frozen_->divergence);
}

template <class Real>
void IslandOf<Real>::restore(ByteReader& bytes) {
    if (bytes.text() != plan_.bodies.front()->fullName() || bytes.text() != plan_.solver.integrator)
        misfit("the bodies or their methods are others");
    if (bytes.number<int>() != choice_.substeps)
        misfit("the steps of " + plan_.bodies.front()->fullName() + " are others");
    if (bytes.number<std::uint64_t>() != plan_.springs.size())
        misfit("the springs of " + plan_.bodies.front()->fullName() + " are others");
    isChanged_ = bytes.number<bool>();
    if (isChanged_) restoreSprings(bytes);
    readForces(bytes, forces_);
    readArray(bytes, state_.x);
    readArray(bytes, state_.v);
    require(bytes.number<std::uint64_t>() == state_.memory.size());
    for (auto& array : state_.memory) readArray(bytes, array);
    for (bool* flag : {&isOpen_, &isReshaped_, &hasMoved_}) *flag = bytes.number<bool>();
    contacts_ = bytes.list<collision::Contact>();
    for (const collision::Contact& contact : contacts_)
        require(contact.point >= 0 && contact.point < system_.layout().count);
    for (std::string* warning : {&stretchWarning_, &collapseWarning_, &limitWarning_}) *warning = bytes.text();
    for (std::int64_t* number : {&workBefore_.evaluations, &workBefore_.iterations, &workBefore_.unconverged})
        *number = bytes.number<std::int64_t>();
    frozen_.reset();
    if (bytes.number<bool>()) {
        frozen_.emplace();
        frozen_->name = plan_.bodies.front()->fullName();
        for (const Body* body : plan_.bodies) frozen_->bodies.push_back(body->fullName());
        frozen_->time = bytes.number<double>();
        frozen_->divergence = readDivergence(bytes);
    }
    rebuild();
    makeMethod();  // it has nothing of its own that the state does not have
    copyState(state_, good_);
}

#define TAUT_ISLAND_SAVING(Real)                                  \
    template void IslandOf<Real>::saveSprings(ByteWriter&) const; \
    template void IslandOf<Real>::restoreSprings(ByteReader&);    \
    template void IslandOf<Real>::save(ByteWriter&) const;        \
    template void IslandOf<Real>::restore(ByteReader&);
TAUT_ISLAND_SAVING(float)
TAUT_ISLAND_SAVING(double)
#undef TAUT_ISLAND_SAVING

}  // namespace taut::world
