#include "world/island.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mechanics/anchor.h"
#include "mechanics/gravity.h"
#include "mechanics/volume.h"
#include "ode/method_table.h"
#include "world/divergence.h"
#include "world/motion.h"

namespace taut::world {
namespace {

// Faster than this nothing in a scene moves: a point that does has left its stable step behind. [m/s]
constexpr double speedLimit = 3000.0;

template <class Real>
class IslandOf final : public Island {
  public:
    IslandOf(IslandPlan plan, const IslandForces& forces, double ticksPerSecond, double t)
        : plan_(std::move(plan)), system_(pointsOf(plan_), rangesOf(plan_), plan_.springs), state_(system_.layout()) {
        addGenerators(forces);
        for (std::size_t i = 0; i < plan_.positions.size(); ++i)
            for (int p = 0; p < 3; ++p) {
                state_.x[index(static_cast<int>(i), p)] = static_cast<Real>(plan_.positions[i][p]);
                state_.v[index(static_cast<int>(i), p)] = static_cast<Real>(plan_.velocities[i][p]);
            }
        mechanics::StabilityShare share{std::vector<double>(plan_.points.size(), 0.0),
                                        std::vector<double>(plan_.points.size(), 0.0)};
        for (const auto& generator : system_.generators()) generator->addStability(motion(t), share);
        choice_ = chooseStep(plan_, share, 1.0 / ticksPerSecond);
        const SolverSpec& solver = plan_.solver;
        method_ = ode::makeMethod<Real>(solver.integrator,
                                        {solver.newtonSteps, solver.cgTolerance, solver.cgIterations});
        method_->start(system_, t, choice_.step, state_);
        before_ = core::AlignedArray<Real>(system_.layout().size());
        velocity_ = before_;
        good_ = state_;
    }

    void setColliders(collision::Colliders colliders) override { colliders_ = std::move(colliders); }

    std::optional<Fault> tick(const TickTime& time, std::span<const ColliderMotion> moving) override {
        if (frozen_) return std::nullopt;
        copyState(state_, good_);
        const bool mayFreeze = plan_.solver.onDivergence == OnDivergence::freeze;
        const bool collides = colliders_.size() > 0 && std::any_of(plan_.bodies.begin(), plan_.bodies.end(),
                                                                   [](const Body* b) { return b->common.collide; });
        for (int s = 0; s < choice_.substeps; ++s) {
            if (mayFreeze) copyState(state_, good_);
            if (collides) std::copy(state_.x.begin(), state_.x.end(), before_.begin());
            method_->step(system_, time.at(s, choice_.substeps), choice_.step, state_);
            if (!isBounded()) return giveUp(time.at(s + 1, choice_.substeps));
            if (collides) collide(moving, s);
            if (!contacts_.empty() && !isBounded()) return giveUp(time.at(s + 1, choice_.substeps));
            if (!mayFreeze) continue;
            if (const auto fault = overstrained(time.at(s + 1, choice_.substeps))) return fault;
        }
        watchVolumes(time.at(choice_.substeps, choice_.substeps));
        return std::nullopt;
    }

    void undoTick() override { copyState(good_, state_); }

    void freeze(const Fault& fault, const TickTime& time) override {
        copyState(good_, state_);
        contacts_.clear();
        FrozenIsland frozen;
        frozen.name = plan_.bodies.front()->fullName();
        for (const Body* body : plan_.bodies) frozen.bodies.push_back(body->fullName());
        frozen.time = fault.time - choice_.step;
        frozen.divergence = diagnose(fault, time);
        frozen_ = std::move(frozen);
    }
    const FrozenIsland* frozen() const override { return frozen_ ? &*frozen_ : nullptr; }

    const IslandPlan& plan() const override { return plan_; }
    double step() const override { return choice_.step; }
    std::span<const collision::Contact> contacts() const override { return contacts_; }
    dvec3 position(int point) const override { return at(state_.x, point); }

    void addToHash(const Body& body, core::Hash& hash) const override {
        for (const core::AlignedArray<Real>* array : {&state_.x, &state_.v})
            for (int i : body.pointOf)
                for (int p = 0; p < 3; ++p) hash.add((*array)[index(i, p)]);
    }

    void addMetrics(const TickTime& time, Metrics& metrics) override {
        if (frozen_) return;
        const double t = time.at(0, 1);
        method_->synchronise(system_, t, choice_.step, state_, velocity_.data());
        for (int i = 0; i < system_.layout().count; ++i) {
            const double m = plan_.points[static_cast<std::size_t>(i)].mass;
            const dvec3 x = at(state_.x, i), v = at(velocity_, i);
            metrics.kinetic += 0.5 * m * glm::dot(v, v);
            metrics.momentum += m * v;
            metrics.angularMomentum += m * glm::cross(x, v);
        }
        for (const mechanics::Spring& s : plan_.springs) {
            const dvec3 d = at(state_.x, s.b) - at(state_.x, s.a);
            const double stretch = std::sqrt(glm::dot(d, d)) - s.restLength;
            metrics.elastic += 0.5 * s.stiffness * stretch * stretch;
            if (s.restLength > 0 && s.kind != mechanics::SpringKind::bend) metrics.maxStrain = std::max(metrics.maxStrain, std::abs(stretch) / s.restLength);
        }
        for (const auto& generator : system_.generators())
            (generator.get() == gravity_ ? metrics.gravitational : metrics.elastic) +=
                generator->potentialEnergy(motion(t));
        for (const auto* volume : volumes_) {
            const mechanics::VolumeReport state = volume->inspect(motion(t));
            metrics.minVolumeRatio = std::min(metrics.minVolumeRatio, state.smallestRatio);
            metrics.invertedCells += state.inverted;
        }
        metrics.contacts += static_cast<int>(contacts_.size());
        metrics.work += work();
    }

    ode::Work work() const override { return method_->work(); }
    IslandInfo info() const override;
    std::vector<std::string> warnings() const override {
        std::vector<std::string> all = choice_.warnings;
        for (const std::string& warning : {stretchWarning_, collapseWarning_})
            if (!warning.empty()) all.push_back(warning);
        if (work().unconverged > 0) all.push_back(unconvergedWarning(work(), plan_));
        if (frozen_) all.push_back(explainFreeze(*frozen_, choice_, methodTitle()));
        return all;
    }
    Divergence diagnose(const Fault& fault, const TickTime& time) const override;

  private:
    using System = mechanics::MassSpringSystem<Real>;

    static std::vector<typename System::PointMass> pointsOf(const IslandPlan& plan) {
        std::vector<typename System::PointMass> points;
        for (const auto& p : plan.points) points.push_back({p.mass, p.dragRate, p.held});
        return points;
    }
    static std::vector<typename System::Body> rangesOf(const IslandPlan& plan) {
        std::vector<typename System::Body> ranges;
        for (const auto& r : plan.ranges) ranges.push_back({r.firstPoint, r.row});
        return ranges;
    }

    void addGenerators(const IslandForces& forces);

    std::size_t index(int point, int plane) const {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plane) * state_.layout.stride + point);
    }
    dvec3 at(const core::AlignedArray<Real>& planes, int point) const {
        return {static_cast<double>(planes[index(point, 0)]), static_cast<double>(planes[index(point, 1)]),
                static_cast<double>(planes[index(point, 2)])};
    }
    mechanics::Motion<Real> motion(double t) const { return system_.motion(t, state_.x.data(), state_.v.data()); }

    static void copyState(const ode::State<Real>& from, ode::State<Real>& to) {
        std::copy(from.x.begin(), from.x.end(), to.x.begin());
        std::copy(from.v.begin(), from.v.end(), to.v.begin());
        for (std::size_t i = 0; i < from.memory.size(); ++i)
            std::copy(from.memory[i].begin(), from.memory[i].end(), to.memory[i].begin());
    }

    // Every velocity is a number below the limit; written so that NaN fails.
    bool isBounded() const {
        const Real limit = static_cast<Real>(speedLimit);
        const Real* v = state_.v.data();
        const int size = static_cast<int>(state_.v.size());
        int bad = 0;
        for (int i = 0; i < size; ++i) bad |= static_cast<int>(!(v[i] < limit)) | static_cast<int>(!(v[i] > -limit));
        return bad == 0;
    }

    Fault giveUp(double t) const {
        Fault fault;
        fault.time = t;
        double fastest = -1;
        for (int i = 0; i < state_.layout.count; ++i) {
            const dvec3 v = at(state_.v, i);
            const double speed = std::sqrt(glm::dot(v, v));
            if (!std::isfinite(speed)) {
                fault.point = i;
                fault.isNumber = false;
                break;
            }
            if (speed > fastest) {
                fastest = speed;
                fault.point = i;
            }
        }
        return fault;
    }

    // The spring furthest from its rest length, if that is further than freezing allows. Springs of bending span two
    // cells and tell nothing that the others do not.
    std::optional<Fault> overstrained(double t) const {
        Fault fault;
        for (const mechanics::Spring& s : plan_.springs) {
            if (s.kind == mechanics::SpringKind::bend || !(s.restLength > 0)) continue;
            const dvec3 d = at(state_.x, s.b) - at(state_.x, s.a);
            const double strain = std::abs(std::sqrt(glm::dot(d, d)) - s.restLength) / s.restLength;
            if (strain <= std::max(fault.strain, plan_.solver.freezeStrain)) continue;
            fault.strain = strain;
            fault.point = plan_.points[static_cast<std::size_t>(s.a)].held ? s.b : s.a;
        }
        if (fault.point < 0) return std::nullopt;
        fault.time = t;
        return fault;
    }

    std::string_view methodTitle() const { return ode::findMethod(plan_.solver.integrator)->title; }

    void collide(std::span<const ColliderMotion> moving, int substep) {
        contacts_.clear();
        const double n = choice_.substeps;
        for (const ColliderMotion& m : moving)
            colliders_.move(m.collider, between(m.from, m.to, substep / n), between(m.from, m.to, (substep + 1) / n));
        for (const Body* body : plan_.bodies) {
            if (!body->common.collide || body->lastPoint == body->firstPoint) continue;
            collision::MovingPoints<Real> points;
            points.first = body->firstPoint;
            points.last = body->lastPoint;
            points.stride = state_.layout.stride;
            points.xBefore = before_.data();
            points.x = state_.x.data();
            points.v = state_.v.data();
            points.inverseMass = system_.inverseMasses();
            points.thickness = body->common.thickness;
            points.friction = body->common.friction;
            colliders_.resolve(points, choice_.step, contacts_);
        }
        touched_.clear();
        for (const collision::Contact& contact : contacts_) touched_.push_back(contact.point);
        if (!touched_.empty()) method_->touch(state_, touched_);
    }

    // Beyond the working stretch the step may not hold, and a collapsed cell may not come back: each said once.
    void watchVolumes(double t) {
        if (volumes_.empty() || (!stretchWarning_.empty() && !collapseWarning_.empty())) return;
        char text[200];
        for (const auto* volume : volumes_) {
            const mechanics::VolumeReport report = volume->inspect(motion(t));
            const std::string name = plan_.bodies.front()->fullName();
            if (report.overstretched > 0 && stretchWarning_.empty()) {
                std::snprintf(text, sizeof text,
                              ": stretched beyond working_stretch at %.3f s; raise it if the block diverges", t);
                stretchWarning_ = name + text;
            }
            if (report.collapsed > 0 && collapseWarning_.empty()) {
                std::snprintf(text, sizeof text,
                              ": squashed to %.2g of its volume in a cell at %.3f s (%d cells below a tenth, %d turned "
                              "inside out); raise bulk_Pa or young_Pa",
                              report.smallestRatio, t, report.collapsed, report.inverted);
                collapseWarning_ = name + text;
            }
        }
    }

    IslandPlan plan_;
    System system_;
    const mechanics::ForceGenerator<Real>* gravity_ = nullptr;
    std::vector<const mechanics::VolumePreservation<Real>*> volumes_;
    StepChoice choice_;
    std::unique_ptr<ode::Method<Real>> method_;
    ode::State<Real> state_, good_;                  // good: as the tick began, or the step where it may freeze
    core::AlignedArray<Real> before_, velocity_;     // (3 · stride) scratch
    collision::Colliders colliders_;
    std::vector<collision::Contact> contacts_;       // of the last step
    std::vector<int> touched_;
    std::string stretchWarning_, collapseWarning_;
    std::optional<FrozenIsland> frozen_;
};

template <class Real>
void IslandOf<Real>::addGenerators(const IslandForces& forces) {
    auto gravity = std::make_unique<mechanics::Gravity<Real>>(forces.gravity);
    gravity_ = gravity.get();
    system_.add(std::move(gravity));
    for (const Body* body : plan_.bodies) {
        std::vector<mechanics::VolumeCell> cells = body->model.cells;
        for (mechanics::VolumeCell& cell : cells)
            for (int& i : cell.points) i = body->pointOf[static_cast<std::size_t>(i)];
        if (cells.empty()) continue;
        auto volume = std::make_unique<mechanics::VolumePreservation<Real>>(cells, plan_.positions, body->workingStretch);
        volumes_.push_back(volume.get());
        system_.add(std::move(volume));
    }
    for (const WindOn& wind : forces.winds) {
        std::vector<std::array<int, 3>> triangles;
        for (const Body* body : plan_.bodies) {
            if (std::find(wind.bodies.begin(), wind.bodies.end(), body) == wind.bodies.end()) continue;
            for (std::array<int, 3> t : body->model.triangles) {
                for (int& i : t) i = body->pointOf[static_cast<std::size_t>(i)];
                triangles.push_back(t);
            }
        }
        if (!triangles.empty())
            system_.add(std::make_unique<mechanics::Wind<Real>>(triangles, wind.velocity, wind.settings));
    }
    for (const AnchorOn& anchor : forces.anchors) {
        if (std::find(plan_.bodies.begin(), plan_.bodies.end(), anchor.body) == plan_.bodies.end()) continue;
        std::vector<int> points;
        for (int i : anchor.points) points.push_back(anchor.body->pointOf[static_cast<std::size_t>(i)]);
        system_.add(std::make_unique<mechanics::Anchor<Real>>(points, anchor.place, anchor.stiffness, anchor.damping));
    }
}

template <class Real>
IslandInfo IslandOf<Real>::info() const {
    IslandInfo info;
    info.name = plan_.bodies.front()->fullName();
    std::vector<double> inverseMasses;
    for (const Body* body : plan_.bodies) {
        info.bodies.push_back(body->fullName());
        info.cells += static_cast<int>(body->model.cells.size());
    }
    for (const auto& point : plan_.points) {
        info.mass += point.mass;
        info.heldPoints += point.held ? 1 : 0;
        inverseMasses.push_back(point.held ? 0.0 : 1.0 / point.mass);
    }
    info.points = static_cast<int>(plan_.points.size());
    info.springs = static_cast<int>(plan_.springs.size());
    info.runs = static_cast<int>(system_.network().runs.size());
    info.singles = system_.network().singles.size();
    info.method = plan_.solver.integrator;
    info.omegaBound = choice_.anywhere.omega;
    info.omegaNow = choice_.here.omega;
    info.fastest = choice_.mode;
    info.stepLimit = choice_.limit;
    info.step = choice_.step;
    info.substeps = choice_.substeps;
    info.work = work();
    info.limitingSpring = choice_.limitingSpring;
    info.bytes = system_.bytes() + (3 + 2 * state_.memory.size()) * state_.layout.size() * sizeof(Real) * 2;
    core::AlignedArray<Real> u(state_.layout.size()), out(state_.layout.size());
    const mechanics::StiffnessProduct multiply = [&](std::span<const dvec3> in, std::span<dvec3> sum) {
        mechanics::addSpringStiffness(plan_.springs, plan_.positions, in, sum);
        std::fill(out.begin(), out.end(), Real(0));
        for (std::size_t i = 0; i < in.size(); ++i)
            for (int p = 0; p < 3; ++p) u[index(static_cast<int>(i), p)] = static_cast<Real>(in[i][p]);
        for (const auto& generator : system_.generators()) generator->addStiffnessProduct(motion(0.0), u.data(), out.data());
        for (std::size_t i = 0; i < in.size(); ++i) sum[i] += at(out, static_cast<int>(i));
    };
    info.omegaEstimate = mechanics::estimateFrequency(inverseMasses, multiply);
    return info;
}

template <class Real>
Divergence IslandOf<Real>::diagnose(const Fault& fault, const TickTime& time) const {
    Divergence d;
    d.tick = time.tick;
    d.time = fault.time;
    for (const Body* body : plan_.bodies)
        for (std::size_t i = 0; i < body->pointOf.size() && d.point < 0; ++i)
            if (body->pointOf[i] == fault.point) {
                d.body = body->fullName();
                d.point = static_cast<int>(i);
            }
    // The bound at that point, for the last good state.
    std::vector<mechanics::Spring> around;
    std::vector<int> numbers;
    for (std::size_t s = 0; s < plan_.springs.size(); ++s)
        if (plan_.springs[s].a == fault.point || plan_.springs[s].b == fault.point) numbers.push_back(static_cast<int>(s));
    std::vector<double> inverseMasses;
    std::vector<dvec3> positions;
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
        inverseMasses.push_back(plan_.points[i].held ? 0.0 : 1.0 / plan_.points[i].mass);
        positions.push_back(position(static_cast<int>(i)));
    }
    const mechanics::FrequencyBound here = mechanics::boundHere({plan_.springs, inverseMasses}, {}, positions);
    int worst = numbers.empty() ? here.spring : numbers.front();
    for (int s : numbers)
        if (plan_.springs[static_cast<std::size_t>(s)].stiffness > plan_.springs[static_cast<std::size_t>(worst)].stiffness)
            worst = s;
    if (worst >= 0) d.spring = describeSpring(plan_, worst);
    const ode::MethodInfo* method = ode::findMethod(plan_.solver.integrator);
    ode::FastestMode mode = choice_.mode;
    mode.omega = std::max(here.omega, choice_.here.omega);
    d.omegaH = mode.omega * choice_.step;
    d.limit = mode.omega * method->largestStep(mode);
    d.safeStep = choice_.limit;
    d.message = explainDivergence(d, fault, choice_, plan_, method->title);
    return d;
}

}  // namespace

std::unique_ptr<Island> makeIsland(IslandPlan plan, const IslandForces& forces, double ticksPerSecond,
                                   double t) {
    if (plan.solver.precision == Precision::single_)
        return std::make_unique<IslandOf<float>>(std::move(plan), forces, ticksPerSecond, t);
    return std::make_unique<IslandOf<double>>(std::move(plan), forces, ticksPerSecond, t);
}

}  // namespace taut::world
