#include "taut/study/statics.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "taut/mechanics/gravity.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/ode/method_table.h"

namespace taut::study {
namespace {

using glm::dvec3;

constexpr double shortestStep = 0.02, longestStep = 1e3;  // [s] steps
constexpr int mostRestSteps = 400;

// The largest |a| of a free point.
class LargestAcceleration final : public ode::AccelerationSink<double> {
  public:
    explicit LargestAcceleration(const mechanics::Model& model) : model_(model), square_(model.masses.size(), 0.0) {}
    void take(int first, int last, const double* const* a) override {
        for (int i = first; i < last; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const int from = i - first;
            if (!model_.held[at])
                square_[at] = a[0][from] * a[0][from] + a[1][from] * a[1][from] + a[2][from] * a[2][from];
        }
    }
    // Not a number and infinity count as the largest.
    double value() const {
        double most = 0.0;
        for (const double s : square_)
            if (!(s <= most)) most = std::isfinite(s) ? s : HUGE_VAL;
        return std::sqrt(most);
    }

  private:
    const mechanics::Model& model_;
    std::vector<double> square_;  // (points) [m²/s⁴]
};

class Settling {
  public:
    Settling(const mechanics::Model& model, const dvec3& gravity)
        : model_(model),
          weight_(glm::length(gravity)),
          system_(model),
          method_(ode::makeMethod<double>("implicit-euler", {1, 1e-10, 20000})),
          state_(system_.layout()),
          still_(system_.layout().size()) {
        system_.add(std::make_unique<mechanics::Gravity<double>>(gravity));
        for (std::size_t i = 0; i < model.positions.size(); ++i)
            for (int p = 0; p < 3; ++p) state_.x[index(i, p)] = model.positions[i][p];
        method_->start(system_, 0.0, shortestStep, state_);
    }

    Equilibrium run(double tolerance) {
        Equilibrium found;
        double h = shortestStep;
        found.residual = residual();
        while (found.residual > tolerance && found.steps < mostRestSteps) {
            method_->step(system_, 0.0, h, state_);
            ++found.steps;
            const double now = residual();
            h = now < found.residual ? std::min(2.0 * h, longestStep) : std::max(0.5 * h, shortestStep);
            found.residual = now;
        }
        found.isAtRest = found.residual <= tolerance;
        if (found.isAtRest) {  // once more, and without haste: Newton's step squares the residual
            method_->step(system_, 0.0, longestStep, state_);
            ++found.steps;
            found.residual = residual();
        }
        found.positions.resize(model_.positions.size());
        for (std::size_t i = 0; i < found.positions.size(); ++i)
            for (int p = 0; p < 3; ++p) found.positions[i][p] = state_.x[index(i, p)];
        return found;
    }

  private:
    std::size_t index(std::size_t point, int plane) const {
        return point + static_cast<std::size_t>(plane) * static_cast<std::size_t>(system_.layout().stride);
    }
    double residual() {
        LargestAcceleration largest(model_);
        system_.accelerate(0.0, state_.x.data(), still_.data(), largest);
        return largest.value() / weight_;
    }

    const mechanics::Model& model_;
    double weight_;  // [m/s²]
    mechanics::MassSpringSystem<double> system_;
    std::unique_ptr<ode::Method<double>> method_;
    ode::State<double> state_;
    core::AlignedArray<double> still_;  // velocities of zero
};

}  // namespace

Equilibrium equilibrium(const mechanics::Model& model, const dvec3& gravity, double tolerance) {
    return Settling(model, gravity).run(tolerance);
}

}  // namespace taut::study
