// What is changed of an island between two ticks. A system is always what the plan and the forces say, so that both
// together are enough to make it again.
#include <algorithm>
#include <type_traits>

#include "taut/world/island_of.h"

namespace taut::world {

template <class Real>
mechanics::MassSpringSystem<Real> IslandOf<Real>::systemOf(const IslandPlan& plan) {
    std::vector<typename System::PointMass> points;
    for (const auto& p : plan.points) points.push_back({p.mass, p.dragRate, p.held});
    for (const Grip& grip : plan.grips)
        if (grip.rigid)
            for (int i : grip.points) points[static_cast<std::size_t>(i)].held = true;
    std::vector<typename System::Body> ranges;
    for (const auto& r : plan.ranges) ranges.push_back({r.firstPoint, r.row});
    return System(points, ranges, plan.springs);
}

template <class Real>
void IslandOf<Real>::rebuild() {
    system_ = systemOf(plan_);
    leadGrips();
    addGenerators();
}

template <class Real>
void IslandOf<Real>::addGenerators() {
    volumes_.clear();
    acting_.clear();
    for (std::size_t number = 0; number < forces_.size(); ++number) {
        if (number == 1) addVolumes();  // after gravity
        std::unique_ptr<mechanics::ForceGenerator<Real>> generator;
        if constexpr (std::is_same_v<Real, float>)
            generator = forces_[number]->inSingle(plan_);
        else
            generator = forces_[number]->inDouble(plan_);
        if (!generator) continue;
        acting_.emplace_back(number, generator.get());
        system_.add(std::move(generator));
    }
    if (forces_.size() < 2) addVolumes();
    gripAnchors_.clear();
    for (const Grip& grip : plan_.grips) {
        gripAnchors_.push_back(nullptr);
        if (grip.rigid) continue;
        auto anchor = std::make_unique<mechanics::Anchor<Real>>(grip.points, grip.path.from, grip.stiffness,
                                                                grip.damping, grip.offsets);
        anchor->setPlace(grip.path);
        gripAnchors_.back() = anchor.get();
        system_.add(std::move(anchor));
    }
}

// What keeps the volume of each body that has cells.
template <class Real>
void IslandOf<Real>::addVolumes() {
    for (const Body* body : plan_.bodies) {
        std::vector<mechanics::VolumeCell> cells;
        for (std::size_t c = 0; c < body->model.cells.size(); ++c) {
            if (body->damage.isCellGone(c)) continue;
            cells.push_back(body->model.cells[c]);
            for (int& i : cells.back().points) i = body->pointOf[static_cast<std::size_t>(i)];
        }
        if (cells.empty()) continue;
        auto volume =
            std::make_unique<mechanics::VolumePreservation<Real>>(cells, plan_.positions, body->model.workingStretch);
        volumes_.push_back({body, volume.get()});
        system_.add(std::move(volume));
    }
}

// Points in a rigid grip go where the hand goes.
template <class Real>
void IslandOf<Real>::leadGrips() {
    for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
        if (!plan_.grips[g].rigid) continue;
        system_.lead({plan_.grips[g].points, [this, g](double t, std::span<dvec3> x, std::span<dvec3> v) {
                          const Grip& grip = plan_.grips[g];
                          const dvec3 place = grip.path.at(t), rate = grip.path.rate(t);
                          for (std::size_t i = 0; i < x.size(); ++i) {
                              x[i] = place + grip.offsets[i];
                              v[i] = rate;
                          }
                      }});
    }
}

template <class Real>
void IslandOf<Real>::synchronise(const TickTime& time) {
    if (frozen_)
        std::fill(velocity_.begin(), velocity_.end(), Real(0));
    else if (isOpen_)
        std::copy(state_.v.begin(), state_.v.end(), velocity_.begin());
    else
        method_->synchronise(system_, time.start(), choice_.step, state_, velocity_.data());
}

// Asking changes nothing, the work of the run least of all.
template <class Real>
void IslandOf<Real>::ask(const TickTime& time) {
    const ode::Work before = method_->work();
    synchronise(time);
    workOfQueries_ += method_->work();
    workOfQueries_ -= before;
}

template <class Real>
void IslandOf<Real>::open(const TickTime& time) {
    if (isOpen_) return;
    synchronise(time);
    std::copy(velocity_.begin(), velocity_.end(), state_.v.begin());
    isOpen_ = true;
}

template <class Real>
void IslandOf<Real>::close(const TickTime& time) {
    if (!isOpen_) return;
    if (isReshaped_) {
        rebuild();
        watchLimit(time.start());
    }
    method_->start(system_, time.start(), choice_.step, state_);
    isOpen_ = isReshaped_ = false;
}

template <class Real>
IslandPlan& IslandOf<Real>::change(const TickTime& time) {
    open(time);
    isReshaped_ = isChanged_ = true;
    return plan_;
}

template <class Real>
void IslandOf<Real>::push(const TickTime& time, std::span<const int> points, const dvec3& velocity) {
    open(time);
    for (int i : points)
        for (int p = 0; p < 3; ++p) {
            Real& v = state_.v[index(i, p)];
            v = static_cast<Real>(static_cast<double>(v) + velocity[p]);
        }
}

template <class Real>
void IslandOf<Real>::stop(const TickTime& time, std::span<const int> points) {
    open(time);
    for (int i : points)
        for (int p = 0; p < 3; ++p) state_.v[index(i, p)] = Real(0);
}

template <class Real>
void IslandOf<Real>::lead(const TickTime& time, const std::string& hand, const mechanics::LinearPath& path,
                          bool bends) {
    if (frozen_) return;
    for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
        if (plan_.grips[g].hand != hand) continue;
        if (bends) open(time);
        plan_.grips[g].path = path;
        // A grip that is younger than the system gets its anchor when that is made anew.
        if (!isReshaped_ && gripAnchors_[g] != nullptr) gripAnchors_[g]->setPlace(path);
    }
}

template <class Real>
void IslandOf<Real>::setForces(const TickTime& time, const ForceList& forces) {
    if (frozen_) return;
    if (!goesOn(forces_, forces)) {
        open(time);  // on the forces so far
        forces_ = forces;
        if (isReshaped_) return;
        system_.removeGenerators();
        addGenerators();
        return;
    }
    forces_ = forces;
    if (isReshaped_) return;
    for (const auto& [number, generator] : acting_) forces_[number]->steer(*generator);
}

template <class Real>
mechanics::StabilityShare IslandOf<Real>::stabilityShare(double t) const {
    mechanics::StabilityShare share{std::vector<double>(plan_.points.size(), 0.0),
                                    std::vector<double>(plan_.points.size(), 0.0)};
    for (const auto& generator : system_.generators()) generator->addStability(motion(t), share);
    return share;
}

// Once, before the first step. For the envelope's forces the island is the envelope for a moment.
template <class Real>
void IslandOf<Real>::chooseStepFor(Envelope& envelope, double tickSeconds, double t) {
    const auto exchange = [&] {
        std::swap(plan_, envelope.plan);
        std::swap(forces_, envelope.forces);
        rebuild();
    };
    if (!envelope.isStatic) exchange();
    mechanics::StabilityShare share = stabilityShare(t);
    if (!envelope.isStatic) exchange();
    choice_ = chooseStep(envelope, std::move(share), tickSeconds);
}

// What is changed while it runs may go beyond what the step was chosen for; that is said once.
template <class Real>
void IslandOf<Real>::watchLimit(double t) {
    if (!limitWarning_.empty() || !(choice_.step <= choice_.limit)) return;
    const double limit = stepLimit(plan_, stabilityShare(t));
    if (choice_.step <= limit * (1 + 1e-6)) return;  // single precision computes the share a little differently
    limitWarning_ = plan_.bodies.front()->fullName() + ": since " + inSeconds(t) + " its step of " +
                    inSeconds(choice_.step) + " is over the stability limit, which has fallen to " + inSeconds(limit) +
                    ": it may diverge; a shorter dt, or [hand] in the scene, allows for it";
}

template <class Real>
std::vector<dvec3> IslandOf<Real>::velocities(const TickTime& time) {
    ask(time);
    std::vector<dvec3> v;
    for (int i = 0; i < state_.layout.count; ++i) v.push_back(at(velocity_, i));
    return v;
}

#define TAUT_ISLAND_CHANGES(Real)                                                                                \
    template mechanics::MassSpringSystem<Real> IslandOf<Real>::systemOf(const IslandPlan&);                      \
    template void IslandOf<Real>::rebuild();                                                                     \
    template void IslandOf<Real>::addGenerators();                                                               \
    template void IslandOf<Real>::addVolumes();                                                                  \
    template void IslandOf<Real>::leadGrips();                                                                   \
    template void IslandOf<Real>::synchronise(const TickTime&);                                                  \
    template void IslandOf<Real>::ask(const TickTime&);                                                          \
    template void IslandOf<Real>::open(const TickTime&);                                                         \
    template void IslandOf<Real>::close(const TickTime&);                                                        \
    template IslandPlan& IslandOf<Real>::change(const TickTime&);                                                \
    template void IslandOf<Real>::push(const TickTime&, std::span<const int>, const dvec3&);                     \
    template void IslandOf<Real>::stop(const TickTime&, std::span<const int>);                                   \
    template void IslandOf<Real>::lead(const TickTime&, const std::string&, const mechanics::LinearPath&, bool); \
    template void IslandOf<Real>::setForces(const TickTime&, const ForceList&);                               \
    template mechanics::StabilityShare IslandOf<Real>::stabilityShare(double) const;                             \
    template void IslandOf<Real>::chooseStepFor(Envelope&, double, double);                                      \
    template void IslandOf<Real>::watchLimit(double);                                                            \
    template std::vector<dvec3> IslandOf<Real>::velocities(const TickTime&);
TAUT_ISLAND_CHANGES(float)
TAUT_ISLAND_CHANGES(double)
#undef TAUT_ISLAND_CHANGES

}  // namespace taut::world
