#include "taut/mechanics/mass_spring_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <mutex>

#include "mechanics_random_net.h"
#include "taut/core/private/parallel.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/gravity.h"
#include "taut/ode/method_table.h"

namespace taut::mechanics::test {
namespace {

template <class Real>
struct Island {
    std::unique_ptr<MassSpringSystem<Real>> system;
    core::AlignedArray<Real> x, v;

    Island(const RandomNet& net, const std::vector<bool>& held = {}) {
        std::vector<typename MassSpringSystem<Real>::PointMass> points;
        for (std::size_t i = 0; i < net.masses.size(); ++i)
            points.push_back({net.masses[i], 0.0, !held.empty() && held[i]});
        const typename MassSpringSystem<Real>::Body body{0, 0};
        system = std::make_unique<MassSpringSystem<Real>>(points, std::span(&body, 1), net.springs);
        x = v = core::AlignedArray<Real>(system->layout().size());
        for (std::size_t i = 0; i < net.masses.size(); ++i)
            for (int p = 0; p < 3; ++p) {
                x[at(p, i)] = static_cast<Real>(net.positions[i][p]);
                v[at(p, i)] = static_cast<Real>(net.velocities[i][p]);
            }
    }
    std::size_t at(int plane, std::size_t point) const {
        return static_cast<std::size_t>(plane) * static_cast<std::size_t>(system->layout().stride) + point;
    }
};

// Keeps its input; on request overwrites the planes that it may overwrite.
template <class Real>
struct Keeper : ode::AccelerationSink<Real> {
    Keeper(Island<Real>& of, bool spoils) : island(of), spoil(spoils), a(of.x.size()), times(of.x.size()) {}
    void take(int first, int last, const Real* const* planes) override {
        for (int p = 0; p < 3; ++p)
            for (int i = first; i < last; ++i) {
                const std::size_t at = island.at(p, i);
                a[at] = planes[p][i - first];
                ++times[at];
                if (spoil) island.x[at] = island.v[at] = std::numeric_limits<Real>::quiet_NaN();
            }
    }
    Island<Real>& island;
    bool spoil;
    core::AlignedArray<Real> a;
    core::AlignedArray<int> times;
};

enum class Sink { reads, spoils };

template <class Real>
std::vector<Real> accelerations(Island<Real>& island, Sink kind = Sink::reads) {
    Keeper<Real> keeper(island, kind == Sink::spoils);
    island.system->accelerate(0.0, island.x.data(), island.v.data(), keeper);
    return {keeper.a.begin(), keeper.a.end()};
}

template <class Real>
constexpr double eps = static_cast<double>(std::numeric_limits<Real>::epsilon());

template <class Real>
class MassSpringSystems : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(MassSpringSystems, Precisions, );

// About a dozen chunks that reach far into each other.
RandomNet largeNet() {
    return randomNet(100000, 300000, 3000, 7);
}

// Every spring on its own, in long double, from the positions as they were rounded.
template <class Real>
void expectAccelerationsOf(const RandomNet& net, Island<Real>& island, const std::vector<Real>& actual) {
    using Wide = long double;
    std::vector<Wide> force(actual.size(), 0), size(net.masses.size(), 0);
    std::vector<int> degree(net.masses.size(), 0);
    for (const Spring& s : net.springs) {
        const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
        const Wide k = static_cast<Real>(s.stiffness), rest = static_cast<Real>(s.restLength),
                   tau = static_cast<Real>(s.dampingTime);
        Wide d[3], l2 = 0, rate = 0, speed = 0;
        for (int p = 0; p < 3; ++p) {
            d[p] = static_cast<Wide>(island.x[island.at(p, b)]) - static_cast<Wide>(island.x[island.at(p, a)]);
            const Wide u = static_cast<Wide>(island.v[island.at(p, b)]) - static_cast<Wide>(island.v[island.at(p, a)]);
            l2 += d[p] * d[p];
            rate += u * d[p];
            speed += std::fabs(u);
        }
        const Wide l = std::sqrt(l2), pull = k * (l - rest + tau * rate / l);
        for (int p = 0; p < 3; ++p) {
            force[island.at(p, a)] += pull * d[p] / l;
            force[island.at(p, b)] -= pull * d[p] / l;
        }
        for (const std::size_t end : {a, b}) {
            size[end] += k * (l + rest + tau * speed);
            ++degree[end];
        }
    }
    for (std::size_t i = 0; i < net.masses.size(); ++i) {
        const Wide w = static_cast<Real>(1.0 / net.masses[i]);
        // A spring takes about 16 roundings of terms no larger than k (l + L + τ|u|), adding it one more each.
        const Wide most = static_cast<Wide>(eps<Real>) * (16 + degree[i]) * size[i] * w;
        for (int p = 0; p < 3; ++p)
            ASSERT_NEAR(static_cast<double>(actual[island.at(p, i)]), static_cast<double>(force[island.at(p, i)] * w),
                        static_cast<double>(most))
                << "point " << i;
    }
}

TYPED_TEST(MassSpringSystems, GiveTheForcesOfTheSpringsOneByOne) {
    const RandomNet net = largeNet();
    Island<TypeParam> island(net);
    ASSERT_GT(island.system->network().chunks.size(), 5u);
    ASSERT_GT(island.system->network().runs.size(), 1000u);
    ASSERT_GT(island.system->network().singles.size(), 1000);
    expectAccelerationsOf(net, island, accelerations(island));
}

TYPED_TEST(MassSpringSystems, GiveTheSameAgainAfterAnEvaluation) {
    Island<TypeParam> island(largeNet());
    const auto once = accelerations(island);
    EXPECT_EQ(accelerations(island), once);
}

TYPED_TEST(MassSpringSystems, HandOverEachPointOnceAndNeverReadItAgain) {
    const RandomNet net = largeNet();
    const auto expected = [&] {
        Island<TypeParam> island(net);
        return accelerations(island);
    }();
    for (const int threads : {1, 7}) {
        const core::ThreadLimit limit(threads);
        Island<TypeParam> island(net);
        Keeper<TypeParam> keeper(island, true);
        island.system->accelerate(0.0, island.x.data(), island.v.data(), keeper);
        for (int p = 0; p < 3; ++p)
            for (std::size_t i = 0; i < net.masses.size(); ++i) ASSERT_EQ(keeper.times[island.at(p, i)], 1);
        EXPECT_EQ(std::vector<TypeParam>(keeper.a.begin(), keeper.a.end()), expected);
    }
}

TYPED_TEST(MassSpringSystems, GiveTheSameBitsOnEveryInstructionSetAndAnyThreads) {
    const InstructionSetGuard guard;
    const RandomNet net = largeNet();
    std::vector<TypeParam> first;
    for (const core::InstructionSet set : supportedSets())
        for (const int threads : {1, 2, 7}) {
            core::useInstructionSet(set);
            const core::ThreadLimit limit(threads);
            Island<TypeParam> island(net);
            const std::vector<TypeParam> a = accelerations(island);
            if (first.empty()) first = a;
            EXPECT_EQ(a, first) << core::nameOf(set) << ", " << threads << " threads";
        }
}

TYPED_TEST(MassSpringSystems, KeepMomentumToRounding) {
    const RandomNet net = largeNet();
    Island<TypeParam> island(net);
    const std::vector<TypeParam> a = accelerations(island);
    for (int p = 0; p < 3; ++p) {
        double sum = 0.0, sizes = 0.0;
        for (std::size_t i = 0; i < net.masses.size(); ++i) {
            const double force = net.masses[i] * static_cast<double>(a[island.at(p, i)]);
            sum += force;
            sizes += std::fabs(force);
        }
        // Each force carries a handful of roundings, of either sign: far below all of them in the same direction.
        EXPECT_LT(std::fabs(sum), eps<TypeParam> * sizes);
    }
}

TYPED_TEST(MassSpringSystems, AreLinearWithoutRestLength) {
    RandomNet net;
    net.masses = {1.0, 2.0};
    net.velocities = {glm::dvec3(0), glm::dvec3(0)};
    net.springs = {{0, 1, 8.0, 0.0, 0.0, SpringKind::structural}};
    for (const double l : {1.0, 0.1, 1e-3, 1e-9, 0.0}) {
        net.positions = {glm::dvec3(0), glm::dvec3(l, -2 * l, 0.5 * l)};
        Island<TypeParam> island(net);
        const auto a = accelerations(island);
        for (int p = 0; p < 3; ++p) {
            // Powers of two for k and the masses: exact.
            EXPECT_EQ(a[island.at(p, 0)], TypeParam(8) * island.x[island.at(p, 1)]);
            EXPECT_EQ(a[island.at(p, 1)], TypeParam(-4) * island.x[island.at(p, 1)]);
        }
    }
}

// As a single spring and in a run.
TYPED_TEST(MassSpringSystems, GiveCoincidentPointsNoForceAndCloseOnesAFiniteOne) {
    for (const int count : {1, 20})
        for (const double apart : {0.0, 1e-22, 1e-30, 1e-170}) {
            RandomNet net;
            for (int i = 0; i <= count; ++i) {
                net.masses.push_back(1.0);
                net.positions.emplace_back(i % 2 * apart, 0.0, 0.0);
                net.velocities.emplace_back(i % 2, 3.0 * i, 0.0);
                if (i > 0) net.springs.push_back({i - 1, i, 100.0, 0.5, 0.01, SpringKind::structural});
            }
            Island<TypeParam> island(net);
            const auto a = accelerations(island);
            for (const TypeParam value : a) {
                EXPECT_TRUE(std::isfinite(value)) << apart;
                if (apart == 0.0) EXPECT_EQ(value, TypeParam(0));
            }
        }
}

TYPED_TEST(MassSpringSystems, LeaveHeldPointsBitwiseWhereTheyAre) {
    const RandomNet net = randomNet(3000, 9000, 200, 5);
    std::vector<bool> held;
    for (std::size_t i = 0; i < net.masses.size(); ++i) held.push_back(i % 3 == 0);
    Island<TypeParam> island(net, held);
    island.system->add(std::make_unique<Gravity<TypeParam>>(glm::dvec3(1.0, -9.81, 2.0)));
    const auto method = ode::makeMethod<TypeParam>("leapfrog");
    ode::State<TypeParam> state(island.system->layout());
    state.x = island.x;
    const double h = 1e-4;
    method->start(*island.system, 0.0, h, state);
    for (int i = 0; i < 1000; ++i) method->step(*island.system, 0.0, h, state);
    for (int p = 0; p < 3; ++p)
        for (std::size_t i = 0; i < held.size(); ++i) {
            const std::size_t at = island.at(p, i);
            ASSERT_TRUE(std::isfinite(state.x[at]));
            if (held[i])
                ASSERT_EQ(state.x[at], island.x[at]);
            else
                ASSERT_NE(state.x[at], island.x[at]);
        }
}

// Pushes each point by a force that tells the points apart.
template <class Real>
struct Push final : ForceGenerator<Real> {
    Push(bool local, double s) : isLocal_(local), size(s) {}
    bool isLocal() const override { return isLocal_; }
    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override {
        if (!isLocal_) {
            EXPECT_EQ(first, 0);
            EXPECT_EQ(last, motion.count);
        }
        for (int p = 0; p < 3; ++p)
            for (int i = first; i < last; ++i)
                f[p * motion.stride + i] += static_cast<Real>(size * (p + 1)) * static_cast<Real>(i % 1024);
    }
    double potentialEnergy(const Motion<Real>&, const std::vector<bool>&) const override { return 0.0; }
    void addStiffnessProduct(const Motion<Real>&, const Real*, Real*) const override {}
    void addStability(const Motion<Real>&, StabilityShare&) const override {}
    bool isLocal_;
    double size;
};

TYPED_TEST(MassSpringSystems, AddGeneratorsOfEveryKindOnceEach) {
    RandomNet net = randomNet(20000, 20, 100, 5);
    for (Spring& s : net.springs) s.stiffness = 0.0;
    for (double& m : net.masses) m = 0.5;
    std::vector<bool> held(net.masses.size(), false);
    held[12345] = true;
    for (const int kinds : {0, 1, 2, 3, 4, 5, 6, 7}) {
        Island<TypeParam> island(net, held);
        double push = 0.0, g = 0.0;
        const auto add = [&](bool local, double size) {
            island.system->add(std::make_unique<Push<TypeParam>>(local, size));
            push += size;
        };
        if ((kinds & 1) != 0) add(true, 0.25);
        if ((kinds & 2) != 0) add(false, 4.0);
        if ((kinds & 4) != 0) {
            island.system->add(std::make_unique<Gravity<TypeParam>>(glm::dvec3(0.0, g = -8.0, 0.0)));
            add(true, 1.0);
        }
        for (int evaluation = 0; evaluation < 2; ++evaluation) {
            const auto a = accelerations(island);
            for (int p = 0; p < 3; ++p)
                for (int i = 0; i < static_cast<int>(held.size()); ++i) {
                    // Small whole numbers over powers of two: exact.
                    const double expected = held[i] ? 0.0 : 2.0 * push * (p + 1) * (i % 1024) + (p == 1 ? g : 0.0);
                    ASSERT_EQ(static_cast<double>(a[island.at(p, i)]), expected)
                        << "generators " << kinds << ", point " << i;
                }
        }
    }
}

TYPED_TEST(MassSpringSystems, LetEveryFreePointFallAlike) {
    const RandomNet net = randomNet(1000, 0, 1, 5);  // masses from 0.1 to 2 kg
    Island<TypeParam> island(net);
    island.system->add(std::make_unique<Gravity<TypeParam>>(glm::dvec3(0.0, -9.81, 0.0)));
    const auto a = accelerations(island);
    for (std::size_t i = 0; i < net.masses.size(); ++i) EXPECT_EQ(a[island.at(1, i)], static_cast<TypeParam>(-9.81));
}

}  // namespace
}  // namespace taut::mechanics::test
