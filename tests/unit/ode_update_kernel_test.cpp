#include "taut/ode/private/update_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "taut/core/private/instruction_set.h"
#include "taut/ode/method_table.h"

namespace taut::ode {
namespace {

template <class Real>
class UpdateKernelsOf : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(UpdateKernelsOf, Precisions, );

template <class Real>
std::vector<Real> randomValues(std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Real> values(n);
    for (Real& value : values) value = static_cast<Real>(std::uniform_real_distribution<>(-2.0, 2.0)(random));
    return values;
}

TYPED_TEST(UpdateKernelsOf, LeapfrogIsItsFormulaToTheBitOnEveryInstructionSet) {
    using Real = TypeParam;
    const core::InstructionSet before = core::instructionSet();
    for (const core::InstructionSet set :
         {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512}) {
        if (!core::isSupported(set)) continue;
        core::useInstructionSet(set);
        for (const int n : {1, 2, 3, 4, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100, 257}) {
            const std::size_t room = static_cast<std::size_t>(n) + 5;  // data behind it must stay
            const auto a = randomValues<Real>(room, 1), keep = randomValues<Real>(room, 2),
                       gain = randomValues<Real>(room, 3), x0 = randomValues<Real>(room, 4),
                       v0 = randomValues<Real>(room, 5), w0 = randomValues<Real>(room, 6);
            std::vector<Real> x = x0, v = v0, w = w0;
            const Real h = Real(0.3);
            Real fastest = 0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
                fastest = std::max(fastest, std::abs(keep[i] * v0[i] + gain[i] * a[i]));
            const auto update = [&](Real limit) {
                x = x0, v = v0, w = w0;
                return leapfrogUpdate<Real>()(n, a.data(), keep.data(), gain.data(), h, limit, x.data(), v.data(),
                                              w.data());
            };
            ASSERT_FALSE(update(fastest)) << core::nameOf(set) << ", n " << n;
            ASSERT_TRUE(update(std::nextafter(fastest, Real(10)))) << core::nameOf(set) << ", n " << n;
            for (std::size_t i = 0; i < room; ++i) {
                const bool isIn = i < static_cast<std::size_t>(n);
                const Real kept = keep[i] * v0[i], gained = gain[i] * a[i];
                const Real after = kept + gained;
                const Real ahead = Real(1.5) * after, behind = Real(0.5) * v0[i], way = h * after;
                ASSERT_EQ(v[i], isIn ? after : v0[i]) << core::nameOf(set) << ", n " << n;
                ASSERT_EQ(w[i], isIn ? ahead - behind : w0[i]) << core::nameOf(set) << ", n " << n;
                ASSERT_EQ(x[i], isIn ? x0[i] + way : x0[i]) << core::nameOf(set) << ", n " << n;
            }
        }
    }
    core::useInstructionSet(before);
}

// Points that fall, handed over in two ranges.
template <class Real>
class Falling final : public SecondOrderSystem<Real> {
  public:
    explicit Falling(std::vector<Real> drag) : drag_(std::move(drag)), a_(drag_.size(), Real(-1)) {}
    Layout layout() const override {
        const int n = static_cast<int>(drag_.size());
        return {n, n, 1};
    }
    const Real* dragRates() const override { return drag_.data(); }
    void accelerate(double, const Real*, const Real*, AccelerationSink<Real>& sink) override {
        const int n = static_cast<int>(drag_.size());
        const Real *front = a_.data(), *back = front + 5;
        sink.take(0, 5, &front);
        sink.take(5, n, &back);
    }

  private:
    std::vector<Real> drag_, a_;
};

// One drag for all points takes a shorter way through the tables than drags that differ.
TYPED_TEST(UpdateKernelsOf, LeapfrogGivesAPointTheSameWhateverTheDragOfOthers) {
    using Real = TypeParam;
    std::vector<Real> drags(20, Real(0.5));
    Falling<Real> alike(drags);
    drags[2] = Real(3);
    drags[17] = Real(0);
    Falling<Real> mixed(drags);
    State<Real> a(alike.layout()), b(mixed.layout());
    for (auto [system, state] : {std::pair{&alike, &a}, std::pair{&mixed, &b}}) {
        const auto method = makeMethod<Real>("leapfrog");
        method->start(*system, 0.0, 0.125, *state);
        for (int i = 0; i < 10; ++i) method->step(*system, 0.0, 0.125, *state);
    }
    for (std::size_t i = 0; i < 20; ++i)
        if (i == 2 || i == 17)
            EXPECT_NE(a.x[i], b.x[i]);
        else
            EXPECT_EQ(a.x[i], b.x[i]);
    EXPECT_GT(a.x[17], b.x[17]);  // without drag it falls further
}

}  // namespace
}  // namespace taut::ode
