#include "taut/study/mechanical_subject.h"

#include <algorithm>
#include <cmath>

#include "taut/mechanics/gravity.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/private/stability.h"
#include "taut/ode/method_table.h"
#include "taut/study/fehlberg78.h"
#include "taut/study/perturbation.h"

namespace taut::study {
namespace {

using glm::dvec3;

constexpr int checkEvery = 64;  // steps between looks at the speed

template <class Real>
class MechanicalTrial final : public Trial {
  public:
    MechanicalTrial(const MechanicalProblem& problem, const RunPlan& plan)
        : problem_(problem),
          plan_(plan),
          system_(problem.model),
          method_(methodOf(plan)),
          state_(system_.layout()),
          velocity_(system_.layout().size()) {
        system_.add(std::make_unique<mechanics::Gravity<Real>>(problem.gravity));
        const mechanics::Model& model = problem.model;
        for (int i = 0; i < model.pointCount(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            for (int p = 0; p < 3; ++p) {
                const double shift = model.held[at] ? 0.0 : plan.perturbation * perturbationOf(i, p);
                state_.x[index(i, p)] = static_cast<Real>(model.positions[at][p] + shift);
                state_.v[index(i, p)] = static_cast<Real>(model.velocities[at][p]);
            }
        }
        method_->start(system_, 0.0, plan.step(), state_);
    }

    bool advance() override {
        const double duration = plan_.grid.duration(), h = plan_.step();
        const auto steps = static_cast<double>(plan_.steps());
        for (long long i = 0; i < plan_.stepsPerSample; ++i) {
            method_->step(system_, duration * static_cast<double>(done_++) / steps, h, state_);
            if (done_ % checkEvery == 0 && !isSlow()) return false;
        }
        return isSlow();
    }

    Observation observe() override {
        const double t = plan_.grid.duration() * static_cast<double>(done_) / static_cast<double>(plan_.steps());
        method_->synchronise(system_, t, plan_.step(), state_, velocity_.data());
        const auto count = static_cast<std::size_t>(problem_.model.pointCount());
        std::vector<dvec3> x(count), v(count);
        Observation seen;
        for (std::size_t i = 0; i < count; ++i)
            for (int p = 0; p < 3; ++p) {
                x[i][p] = static_cast<double>(state_.x[index(static_cast<int>(i), p)]);
                v[i][p] = static_cast<double>(velocity_[index(static_cast<int>(i), p)]);
                if (!problem_.model.held[i]) seen.values.push_back(x[i][p]);
            }
        const Energies energies = energiesOf(problem_.model, problem_.gravity, x, v);
        seen.kinetic = energies.kinetic;
        seen.energy = energies.kinetic + energies.potential;
        return seen;
    }

    ode::Work work() const override { return method_->work(); }

  private:
    static std::unique_ptr<ode::Method<Real>> methodOf(const RunPlan& plan) {
        ode::MethodOptions options;
        options.tolerance = plan.tolerance > 0 ? plan.tolerance : plan.solverShare * options.tolerance;
        return referenceMethods()->make<Real>(plan.method, options);
    }
    std::size_t index(int point, int plane) const {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plane) * state_.layout.stride + point);
    }
    bool isSlow() const {
        const Real limit = static_cast<Real>(mechanics::speedLimit);
        bool slow = true;
        for (const Real v : state_.v) slow &= v < limit && v > -limit;
        return slow;
    }

    const MechanicalProblem& problem_;
    RunPlan plan_;
    mechanics::MassSpringSystem<Real> system_;
    std::unique_ptr<ode::Method<Real>> method_;
    ode::State<Real> state_;
    core::AlignedArray<Real> velocity_;
    long long done_ = 0;
};

class MechanicalSubject final : public Subject {
  public:
    explicit MechanicalSubject(MechanicalProblem problem) : problem_(std::move(problem)) {
        const mechanics::Model& model = problem_.model;
        std::vector<double> inverseMasses;
        bool isFirst = true;
        for (std::size_t i = 0; i < model.masses.size(); ++i) {
            inverseMasses.push_back(model.held[i] ? 0.0 : 1.0 / model.masses[i]);
            if (model.held[i]) continue;
            mode_.drag = isFirst ? model.dragRates[i] : std::min(mode_.drag, model.dragRates[i]);
            mode_.largestDrag = std::max(mode_.largestDrag, model.dragRates[i]);
            isFirst = false;
        }
        for (const mechanics::Spring& spring : model.springs) mode_.tau = std::max(mode_.tau, spring.dampingTime);
        mode_.omega = mechanics::boundAnywhere({model.springs, inverseMasses}, {}).omega;
    }

    const std::string& name() const override { return problem_.name; }
    const std::string& title() const override { return problem_.title; }
    int dimensions() const override { return 3; }
    std::string unit() const override { return "m"; }
    bool hasEnergy() const override { return true; }
    double duration() const override { return problem_.duration; }
    bool accepts(const ode::MethodInfo&) const override { return true; }

    Grid grid(double duration, double window) const override {
        const int samples = std::clamp(static_cast<int>(std::ceil(10 * duration / window - 1e-9)), 10, 640);
        return {duration / samples, samples};
    }

    std::unique_ptr<Trial> begin(const RunPlan& plan) const override {
        if (plan.precision == Precision::single_) return std::make_unique<MechanicalTrial<float>>(problem_, plan);
        return std::make_unique<MechanicalTrial<double>>(problem_, plan);
    }

    double stepLimit(const ode::MethodInfo& method) const override { return method.largestStep(mode_); }

    std::optional<Observation> exact(double t) const override {
        if (!problem_.solution) return std::nullopt;
        const mechanics::Model& model = problem_.model;
        std::vector<dvec3> x = model.positions, v(model.positions.size(), dvec3(0.0));
        problem_.solution(t, x, v);
        const Energies energies = energiesOf(model, problem_.gravity, x, v);
        Observation seen;
        for (std::size_t i = 0; i < x.size(); ++i)
            for (int p = 0; p < 3 && !model.held[i]; ++p) seen.values.push_back(x[i][p]);
        seen.kinetic = energies.kinetic;
        seen.energy = energies.kinetic + energies.potential;
        return seen;
    }

  private:
    MechanicalProblem problem_;
    ode::FastestMode mode_;
};

}  // namespace

Energies energiesOf(const mechanics::Model& model, const dvec3& gravity, std::span<const dvec3> x,
                    std::span<const dvec3> v) {
    Energies energies;
    for (std::size_t i = 0; i < x.size(); ++i) {
        energies.kinetic += 0.5 * model.masses[i] * glm::dot(v[i], v[i]);
        energies.potential -= model.masses[i] * glm::dot(gravity, x[i]);
    }
    for (const mechanics::Spring& spring : model.springs) {
        const dvec3 d = x[spring.b] - x[spring.a];
        const double stretch = std::sqrt(glm::dot(d, d)) - spring.restLength;
        energies.potential += 0.5 * spring.stiffness * stretch * stretch;
    }
    return energies;
}

std::unique_ptr<Subject> makeMechanicalSubject(MechanicalProblem problem) {
    return std::make_unique<MechanicalSubject>(std::move(problem));
}

}  // namespace taut::study
