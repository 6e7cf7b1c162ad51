// The promises of every method: its place in the table, its evaluations, its state as a checkpoint, its manners with
// arrays.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "support/oscillator.h"

namespace taut::test {
namespace {

TEST(MethodTable, NamesEachMethodOnceAndMakesIt) {
    std::set<std::string_view> names;
    for (const ode::MethodInfo& info : ode::methods()) {
        SCOPED_TRACE(info.name);
        EXPECT_TRUE(names.insert(info.name).second);
        EXPECT_FALSE(info.title.empty());
        EXPECT_GE(info.order, 1);
        EXPECT_GE(info.evaluations, 1);
        EXPECT_EQ(ode::findMethod(info.name), &info);
        EXPECT_NE(ode::makeMethod<float>(info.name), nullptr);
        EXPECT_NE(ode::makeMethod<double>(info.name), nullptr);
    }
    for (const char* name : {"leapfrog", "velocity-verlet", "euler"}) EXPECT_EQ(names.count(name), 1U) << name;
    for (const char* name : {"", "leap", "leapfrog ", "Leapfrog"}) EXPECT_EQ(ode::findMethod(name), nullptr) << name;
}

constexpr Oscillator::Values damped{3.0, 0.4, 0.5, 0.2, 0.6};

TEST(EveryMethod, MakesAsManyEvaluationsAStepAsItSays) {
    for (const ode::MethodInfo& info : ode::methods()) {
        Oscillator oscillator(damped);
        Integration<double> run = integrate(oscillator, info.name, 0.01, {1.0, 0.0});
        const int before = oscillator.evaluations;
        EXPECT_LE(before, 1) << info.name;  // to start
        run.step(50);
        EXPECT_EQ(oscillator.evaluations - before, 50 * info.evaluations) << info.name;
    }
}

TEST(EveryMethod, LeavesTheStateAsItIsWhenItSynchronises) {
    for (const ode::MethodInfo& info : ode::methods()) {
        Oscillator one(damped), two(damped);
        Integration<double> run = integrate(one, info.name, 0.01, {1.0, 0.0});
        Integration<double> watched = integrate(two, info.name, 0.01, {1.0, 0.0});
        // At the start it is the given one, but for rounding: half a step back and forth again.
        EXPECT_NEAR(watched.synchronisedVelocities()[0], 0.0, 1e-16) << info.name;
        for (int i = 0; i < 20; ++i) {
            run.step();
            watched.step();
            watched.synchronisedVelocities();
        }
        EXPECT_EQ(run.state.x[0], watched.state.x[0]) << info.name;
        EXPECT_EQ(run.state.v[0], watched.state.v[0]) << info.name;
    }
}

// A copy of the state, taken up by a method that has never seen it, goes on bit by bit; also right after a contact.
TEST(EveryMethod, GoesOnFromACopyOfTheState) {
    for (const ode::MethodInfo& info : ode::methods())
        for (bool touched : {false, true}) {
            SCOPED_TRACE(std::string(info.name) + (touched ? ", touched" : ""));
            Oscillator oscillator(damped);
            Integration<double> run = integrate(oscillator, info.name, 0.01, {1.0, 0.0});
            run.step(10);
            if (touched) {
                run.state.v[0] = -0.5;
                const int point = 0;
                run.method().touch(run.state, std::span<const int>(&point, 1));
            }
            ode::State<double> copy = run.state;
            const auto other = ode::makeMethod<double>(info.name);
            for (int i = 0; i < 10; ++i) other->step(oscillator, (10 + i) * 0.01, 0.01, copy);
            run.step(10);
            EXPECT_EQ(run.state.x[0], copy.x[0]);
            EXPECT_EQ(run.state.v[0], copy.v[0]);
        }
}

// A bounce off a wall at x = 0, reflected exactly at the end of a step: first order at worst, so the error after it
// falls with h, and is not that of a velocity half a step old seen by the dashpot.
TEST(EveryMethod, GoesOnWithTheVelocityThatATouchGaveIt) {
    for (const ode::MethodInfo& info : ode::methods()) {
        SCOPED_TRACE(info.name);
        constexpr double h = 1e-4;
        Oscillator oscillator({0.0, 0.5, 0.0, 0.0, 0.0});  // x'' = -0.5 x'
        Integration<double> run = integrate(oscillator, info.name, h, {0.0, 1.0});
        run.step(1000);
        const double v = phaseOf(run).v;
        EXPECT_NEAR(v, std::exp(-0.05), 1e-5);
        run.state.v[0] = -run.state.v[0];
        const int point = 0;
        run.method().touch(run.state, std::span<const int>(&point, 1));
        const double turned = run.state.x[0];
        run.step(1000);
        // Back by (v/c)(1 - e^{-ct}); a step of it, 1e-4 m, may be lost to the contact.
        EXPECT_NEAR(run.state.x[0], turned - v / 0.5 * (1.0 - std::exp(-0.05)), 2e-4);
        EXPECT_NEAR(phaseOf(run).v, -v * std::exp(-0.05), 2e-4);
    }
}

// Three points in two planes with gaps behind, handed over in two ranges, the later one first.
class Scattered final : public ode::SecondOrderSystem<double>, public ode::ImplicitSystem<double> {
  public:
    static constexpr int points = 3, stride = 5, planes = 2;
    ode::Layout layout() const override { return {points, stride, planes}; }
    const double* dragRates() const override { return drag_; }
    void accelerate(double, const double* x, const double* v, ode::AccelerationSink<double>& sink) override {
        double a[planes][points];
        for (int p = 0; p < planes; ++p)
            for (int i = 0; i < points; ++i) a[p][i] = -(1.0 + i + 3 * p) * x[p * stride + i] - 0.1 * v[p * stride + i];
        const double* late[planes] = {a[0] + 1, a[1] + 1};
        sink.take(1, 3, late);
        const double* early[planes] = {a[0], a[1]};
        sink.take(0, 1, early);
    }

    ode::ImplicitSystem<double>* implicitPart() override { return this; }
    const double* masses() const override { return mass_; }
    const double* inverseMasses() const override { return mass_; }
    void linearise(double, const double*, const double*, double stiffness, double damping) override {
        for (int p = 0; p < planes; ++p)
            for (int i = 0; i < points; ++i) slope_[p * stride + i] = stiffness * (1.0 + i + 3 * p) + damping * 0.1;
    }
    void addProduct(const double* u, double* out) const override {
        for (int i = 0; i < planes * stride; ++i) out[i] += slope_[i] * u[i];
    }
    void addDiagonal(double* out) const override {
        for (int i = 0; i < planes * stride; ++i) out[i] += slope_[i];
    }

  private:
    double drag_[stride] = {0.0, 0.2, 0.4, 0.0, 0.0};
    double mass_[stride] = {1.0, 1.0, 1.0, 0.0, 0.0};
    double slope_[planes * stride] = {};
};

TEST(EveryMethod, TreatsPlanesAndRangesLikeSeparateOscillatorsAndLeavesTheGaps) {
    for (const ode::MethodInfo& info : ode::methods()) {
        SCOPED_TRACE(info.name);
        Scattered system;
        std::vector<double> x(10, 0.0), v(10, 0.0);
        for (int p = 0; p < 2; ++p)
            for (int i = 0; i < 3; ++i) {
                x[5 * p + i] = 1.0 + 0.1 * i;
                v[5 * p + i] = -0.3 * p;
            }
        Integration<double> run(system, info.name, 0.02, x, v);
        run.step(100);
        for (int p = 0; p < 2; ++p)
            for (int i = 0; i < 5; ++i) {
                const auto at = static_cast<std::size_t>(5 * p + i);
                if (i >= 3) {
                    EXPECT_EQ(run.state.x[at], 0.0);
                    EXPECT_EQ(run.state.v[at], 0.0);
                    continue;
                }
                Oscillator alone({std::sqrt(1.0 + i + 3 * p), 0.1, 0.2 * i, 0.0, 0.0});
                Integration<double> other = integrate(alone, info.name, 0.02, {1.0 + 0.1 * i, -0.3 * p});
                other.step(100);
                EXPECT_NEAR(run.state.x[at], other.state.x[0], 1e-14);  // ω is squared again: rounding
            }
    }
}

TEST(FirstOrderView, StacksVelocitiesAndAccelerationsWithDrag) {
    Scattered system;
    ode::FirstOrderView<double> view(system);
    ASSERT_EQ(view.size(), 20U);
    std::vector<double> y(20, 0.0), slope(20, 0.0);
    for (std::size_t i : {0U, 1U, 2U, 5U, 6U, 7U}) {
        y[i] = 1.0 + static_cast<double>(i);
        y[10 + i] = 0.5 - static_cast<double>(i);
    }
    view.derivative(0.0, y.data(), slope.data());
    const double drag[] = {0.0, 0.2, 0.4};
    for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t at = 5 * p + i;
            EXPECT_EQ(slope[at], y[10 + at]);
            const double k = 1.0 + static_cast<double>(i + 3 * p);
            EXPECT_NEAR(slope[10 + at], -k * y[at] - (0.1 + drag[i]) * y[10 + at], 1e-13);  // rounding
        }
}

}  // namespace
}  // namespace taut::test
