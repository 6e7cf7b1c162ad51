#include "taut/study/first_order_subject.h"

#include <cmath>

#include "taut/ode/method_table.h"

namespace taut::study {
namespace {

template <class Real>
class Equation final : public ode::System<Real> {
  public:
    explicit Equation(const FirstOrderProblem& problem) : problem_(problem) {}
    std::size_t size() const override { return 1; }
    void derivative(double t, const Real* y, Real* dydt) override {
        ++evaluations;
        if constexpr (std::is_same_v<Real, float>)
            dydt[0] = problem_.single(t, y[0]);
        else
            dydt[0] = problem_.full(t, y[0]);
    }
    long long evaluations = 0;

  private:
    const FirstOrderProblem& problem_;
};

template <class Real>
class EquationTrial final : public Trial {
  public:
    EquationTrial(const FirstOrderProblem& problem, const RunPlan& plan)
        : start_(problem.start),
          plan_(plan),
          equation_(problem),
          method_(ode::makeFirstOrderMethod<Real>(plan.method)),
          y_(static_cast<Real>(problem.y0 + plan.perturbation)) {}

    bool advance() override {
        const double duration = plan_.grid.duration(), h = plan_.step();
        const auto steps = static_cast<double>(plan_.steps());
        for (long long i = 0; i < plan_.stepsPerSample; ++i, ++done_)
            method_->step(equation_, start_ + duration * static_cast<double>(done_) / steps, h, &y_);
        return isBounded(static_cast<double>(y_));
    }

    Observation observe() override {
        Observation seen;
        seen.values = {static_cast<double>(y_)};
        return seen;
    }

    ode::Work work() const override {
        ode::Work work;
        work.evaluations = equation_.evaluations;
        return work;
    }

  private:
    double start_;
    RunPlan plan_;
    Equation<Real> equation_;
    std::unique_ptr<ode::FirstOrderMethod<Real>> method_;
    Real y_;
    long long done_ = 0;
};

class FirstOrderSubject final : public Subject {
  public:
    explicit FirstOrderSubject(const FirstOrderProblem& problem) : problem_(problem) {}

    const std::string& name() const override { return problem_.name; }
    const std::string& title() const override { return problem_.title; }
    int dimensions() const override { return 1; }
    std::string unit() const override { return ""; }
    bool hasEnergy() const override { return false; }
    double duration() const override { return problem_.duration; }
    bool accepts(const ode::MethodInfo& method) const override { return method.isFirstOrder(); }
    Grid grid(double duration, double) const override { return {duration / 10, 10}; }

    std::unique_ptr<Trial> begin(const RunPlan& plan) const override {
        if (plan.precision == Precision::single_) return std::make_unique<EquationTrial<float>>(problem_, plan);
        return std::make_unique<EquationTrial<double>>(problem_, plan);
    }

    // A growing solution is meant to grow: no step is unstable.
    double stepLimit(const ode::MethodInfo&) const override { return HUGE_VAL; }

    std::optional<Observation> exact(double t) const override {
        Observation seen;
        seen.values = {problem_.solution(problem_.start + t)};
        return seen;
    }

  private:
    FirstOrderProblem problem_;
};

}  // namespace

std::unique_ptr<Subject> makeFirstOrderSubject(const FirstOrderProblem& problem) {
    return std::make_unique<FirstOrderSubject>(problem);
}

}  // namespace taut::study
