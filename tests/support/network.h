// A model in motion under one method, without a world: points and springs as an island has them, read back as vectors.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "support/integration.h"
#include "taut/mechanics/gravity.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/model.h"

namespace taut::test {

using glm::dvec3;

// Points of a model one by one, for networks written down in a test.
inline int addPoint(mechanics::Model& model, dvec3 position, double mass, bool held = false) {
    model.positions.push_back(position);
    model.velocities.emplace_back(0.0);
    model.masses.push_back(mass);
    model.dragRates.push_back(0.0);
    model.held.push_back(held);
    return model.pointCount() - 1;
}

inline void addSpring(mechanics::Model& model, int a, int b, double stiffness, double restLength, double tau = 0.0) {
    model.springs.push_back({a, b, stiffness, restLength, tau, mechanics::SpringKind::structural});
}

inline void hold(mechanics::Model& model, std::string_view group) {
    for (int i : model.groups.at(std::string(group))) model.held[i] = true;
}

template <class Real>
class NetworkOf {
  public:
    NetworkOf(const mechanics::Model& model, std::string_view method, double h, dvec3 gravity = dvec3(0.0),
              const ode::MethodOptions& options = exactSolves)
        : model_(model), system_(model), options_(options) {
        auto field = std::make_unique<mechanics::Gravity<Real>>(gravity);
        gravity_ = field.get();
        system_.add(std::move(field));
        start(method, h);
    }

    // A force besides springs and gravity; restarts the method from the model.
    void add(std::unique_ptr<mechanics::ForceGenerator<Real>> generator, std::string_view method, double h) {
        system_.add(std::move(generator));
        start(method, h);
    }

    // Points moved by hand; restarts the method from the model.
    void lead(mechanics::LedPoints led, std::string_view method, double h) {
        system_.lead(std::move(led));
        start(method, h);
    }

    void step(std::int64_t steps = 1) { run_->step(steps); }
    double time() const { return run_->time(); }
    Integration<Real>& run() { return *run_; }
    ode::SecondOrderSystem<Real>& system() { return system_; }

    dvec3 position(int point) const { return at(run_->state.x.data(), point); }
    std::vector<dvec3> positions() const { return all(run_->state.x.data()); }
    std::vector<dvec3> velocities() { return all(run_->synchronisedVelocities().data()); }

    double kinetic() {
        double sum = 0.0;
        const std::vector<dvec3> v = velocities();
        for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * model_.masses[i] * glm::dot(v[i], v[i]);
        return sum;
    }
    double potential() const {
        double sum = gravity_->potentialEnergy(motion());
        for (const mechanics::Spring& s : model_.springs) {
            const double stretch = glm::length(position(s.b) - position(s.a)) - s.restLength;
            sum += 0.5 * s.stiffness * stretch * stretch;
        }
        return sum;
    }
    double energy() { return kinetic() + potential(); }
    dvec3 momentum() {
        dvec3 sum(0.0);
        const std::vector<dvec3> v = velocities();
        for (std::size_t i = 0; i < v.size(); ++i) sum += model_.masses[i] * v[i];
        return sum;
    }
    // About the origin.
    dvec3 angularMomentum() {
        dvec3 sum(0.0);
        const std::vector<dvec3> v = velocities();
        for (std::size_t i = 0; i < v.size(); ++i)
            sum += model_.masses[i] * glm::cross(position(static_cast<int>(i)), v[i]);
        return sum;
    }
    mechanics::Motion<Real> motion() const {
        return system_.motion(time(), run_->state.x.data(), run_->state.v.data());
    }

    // False once a number has left all bounds.
    bool isBounded(double limit) const {
        for (Real x : run_->state.x)
            if (!(std::abs(static_cast<double>(x)) < limit)) return false;
        return true;
    }

  private:
    void start(std::string_view method, double h) {
        const ode::Layout layout = system_.layout();
        std::vector<Real> x(layout.size()), v(layout.size());
        for (std::size_t i = 0; i < model_.positions.size(); ++i)
            for (int p = 0; p < 3; ++p) {
                const std::size_t to = static_cast<std::size_t>(p * layout.stride) + i;
                x[to] = static_cast<Real>(model_.positions[i][p]);
                v[to] = static_cast<Real>(model_.velocities[i][p]);
            }
        run_ = std::make_unique<Integration<Real>>(system_, method, h, x, v, options_);
    }
    dvec3 at(const Real* planes, int point) const {
        const std::ptrdiff_t stride = system_.layout().stride;
        return {static_cast<double>(planes[point]), static_cast<double>(planes[stride + point]),
                static_cast<double>(planes[2 * stride + point])};
    }
    std::vector<dvec3> all(const Real* planes) const {
        std::vector<dvec3> values;
        for (int i = 0; i < model_.pointCount(); ++i) values.push_back(at(planes, i));
        return values;
    }

    mechanics::Model model_;
    mechanics::MassSpringSystem<Real> system_;
    ode::MethodOptions options_;
    const mechanics::Gravity<Real>* gravity_ = nullptr;
    std::unique_ptr<Integration<Real>> run_;
};

using Network = NetworkOf<double>;

}  // namespace taut::test
