// What is changed of an island between two ticks. A system is always what the plan and the forces say, so that both
// together are enough to make it again.
#include <algorithm>

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
    winds_.clear();
    anchors_.clear();
    auto gravity = std::make_unique<mechanics::Gravity<Real>>(forces_.gravity);
    gravity_ = gravity.get();
    system_.add(std::move(gravity));
    for (const Body* body : plan_.bodies) {
        std::vector<mechanics::VolumeCell> cells;
        for (std::size_t c = 0; c < body->model.cells.size(); ++c) {
            if (body->damage.isCellGone(c)) continue;
            cells.push_back(body->model.cells[c]);
            for (int& i : cells.back().points) i = body->pointOf[static_cast<std::size_t>(i)];
        }
        if (cells.empty()) continue;
        auto volume =
            std::make_unique<mechanics::VolumePreservation<Real>>(cells, plan_.positions, body->workingStretch);
        volumes_.push_back({body, volume.get()});
        system_.add(std::move(volume));
    }
    for (std::size_t w = 0; w < forces_.winds.size(); ++w) {
        const WindOn& wind = forces_.winds[w];
        std::vector<std::array<int, 3>> triangles;
        for (const Body* body : plan_.bodies) {
            if (std::find(wind.bodies.begin(), wind.bodies.end(), body) == wind.bodies.end()) continue;
            for (std::size_t t = 0; t < body->model.triangles.size(); ++t) {
                if (body->damage.isTriangleGone(t)) continue;
                triangles.push_back(body->model.triangles[t]);
                for (int& i : triangles.back()) i = body->pointOf[static_cast<std::size_t>(i)];
            }
        }
        if (triangles.empty()) continue;
        auto generator = std::make_unique<mechanics::Wind<Real>>(triangles, wind.velocity, wind.settings);
        winds_.emplace_back(w, generator.get());
        system_.add(std::move(generator));
    }
    for (std::size_t a = 0; a < forces_.anchors.size(); ++a) {
        const AnchorOn& anchor = forces_.anchors[a];
        if (std::find(plan_.bodies.begin(), plan_.bodies.end(), anchor.body) == plan_.bodies.end()) continue;
        std::vector<int> points;
        for (int i : anchor.points) points.push_back(anchor.body->pointOf[static_cast<std::size_t>(i)]);
        auto generator =
            std::make_unique<mechanics::Anchor<Real>>(points, anchor.place.to, anchor.stiffness, anchor.damping);
        generator->setPlace(anchor.place);
        anchors_.emplace_back(a, generator.get());
        system_.add(std::move(generator));
    }
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
void IslandOf<Real>::setForces(const TickTime& time, const IslandForces& forces) {
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
    gravity_->setAcceleration(forces_.gravity);
    for (const auto& [w, wind] : winds_) wind->setVelocity(forces_.winds[w].velocity);
    for (const auto& [a, anchor] : anchors_) anchor->setPlace(forces_.anchors[a].place);
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
    synchronise(time);
    std::vector<dvec3> v;
    for (int i = 0; i < state_.layout.count; ++i) v.push_back(at(velocity_, i));
    return v;
}

#define TAUT_ISLAND_CHANGES(Real)                                                                                \
    template mechanics::MassSpringSystem<Real> IslandOf<Real>::systemOf(const IslandPlan&);                      \
    template void IslandOf<Real>::rebuild();                                                                     \
    template void IslandOf<Real>::addGenerators();                                                               \
    template void IslandOf<Real>::leadGrips();                                                                   \
    template void IslandOf<Real>::synchronise(const TickTime&);                                                  \
    template void IslandOf<Real>::open(const TickTime&);                                                         \
    template void IslandOf<Real>::close(const TickTime&);                                                        \
    template IslandPlan& IslandOf<Real>::change(const TickTime&);                                                \
    template void IslandOf<Real>::push(const TickTime&, std::span<const int>, const dvec3&);                     \
    template void IslandOf<Real>::stop(const TickTime&, std::span<const int>);                                   \
    template void IslandOf<Real>::lead(const TickTime&, const std::string&, const mechanics::LinearPath&, bool); \
    template void IslandOf<Real>::setForces(const TickTime&, const IslandForces&);                               \
    template mechanics::StabilityShare IslandOf<Real>::stabilityShare(double) const;                             \
    template void IslandOf<Real>::chooseStepFor(Envelope&, double, double);                                      \
    template void IslandOf<Real>::watchLimit(double);                                                            \
    template std::vector<dvec3> IslandOf<Real>::velocities(const TickTime&);
TAUT_ISLAND_CHANGES(float)
TAUT_ISLAND_CHANGES(double)
#undef TAUT_ISLAND_CHANGES

}  // namespace taut::world
