// Networks that swing in one mode, at the frequency that theory gives, for ten periods.
//
// A mode of frequency ω that starts at rest moves under leap-frog as cos(n θ), θ = 2 asin(ω h/2): no error of the
// method is left in the comparison, only rounding and how far the network is from linear.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/network.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"

namespace taut::test::linear_modes {
namespace {

using core::pi;
using mechanics::Model;

constexpr double g = 9.81;

// A bound of the fastest motion of the whole network: the slow modes too must take steps that it stands.
double fastest(const Model& model) {
    std::vector<double> inverseMasses;
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        inverseMasses.push_back(model.held[i] ? 0.0 : 1.0 / model.masses[i]);
    return mechanics::boundAnywhere({model.springs, inverseMasses}, {}).omega;
}

// Displaces the model along a shape (points) whose largest entry is about 1, releases it, and watches the share of the
// shape in the motion, for both methods that have the same positions.
void expectMode(Model model, const std::vector<dvec3>& shape, double amplitude, double omega, double tolerance,
                dvec3 gravity = dvec3(0.0)) {
    const std::vector<dvec3> rest = model.positions;
    double square = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        model.positions[i] += amplitude * shape[i];
        square += model.masses[i] * glm::dot(shape[i], shape[i]);
    }
    const double h = std::min(0.1 / omega, 1.5 / fastest(model));
    const double angle = 2.0 * std::asin(omega * h / 2.0);
    const int steps = static_cast<int>(60.0 / angle);
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        SCOPED_TRACE(std::string(method) + ", ω = " + std::to_string(omega));
        Network network(model, method, h, gravity);
        for (int n = 1; n <= steps; ++n) {
            network.step();
            double share = 0.0;
            const std::vector<dvec3> x = network.positions();
            for (std::size_t i = 0; i < shape.size(); ++i)
                share += model.masses[i] * glm::dot(shape[i], x[i] - rest[i]) / square;
            ASSERT_NEAR(share / amplitude, std::cos(n * angle), tolerance) << "after " << n << " steps";
        }
    }
}

// n free points of mass m between two held ones, in a row along x at distance l.
Model chain(int n, double m, double l, double k, double restLength) {
    Model model;
    for (int i = 0; i <= n + 1; ++i) addPoint(model, {i * l, 0, 0}, m, i == 0 || i == n + 1);
    for (int i = 0; i <= n; ++i) addSpring(model, i, i + 1, k, restLength);
    return model;
}

std::vector<dvec3> sine(int n, int j, dvec3 direction) {
    std::vector<dvec3> shape;
    for (int i = 0; i <= n + 1; ++i)
        shape.push_back((i == 0 || i == n + 1 ? 0.0 : std::sin(i * j * pi / (n + 1))) * direction);
    return shape;
}

// Motion along the line is linear as long as nobody passes anybody. Rounding: positions near 1 carry 1e-16, that is
// 1e-14 of the amplitude of 0.02, and 600 steps add it up in phase at worst: 1e-11.
TEST(CoupledOscillators, SwingTogetherAndAgainstEachOther) {
    constexpr double k = 40.0, between = 15.0, m = 0.5;
    Model model = chain(2, m, 1.0, k, 1.0);
    model.springs[1].stiffness = between;
    const dvec3 x(1, 0, 0), none(0.0);
    expectMode(model, {none, x, x, none}, 0.02, std::sqrt(k / m), 1e-11);
    expectMode(model, {none, x, -x, none}, 0.02, std::sqrt((k + 2.0 * between) / m), 1e-11);
}

TEST(Chain, HasTheFrequenciesOfTheTheoryAlongItself) {
    constexpr int n = 7;
    constexpr double k = 300.0, m = 0.1;
    for (int j = 1; j <= n; ++j)
        expectMode(chain(n, m, 0.25, k, 0.25), sine(n, j, {1, 0, 0}), 0.002,
                   2.0 * std::sqrt(k / m) * std::sin(j * pi / (2 * (n + 1))),
                   1e-10);  // as above, a tenth of the amplitude
}

// Springs of no rest length are linear in every direction: 1e-10 as above.
TEST(TautString, OfSpringsWithoutRestLengthIsExactlyLinear) {
    constexpr int n = 6;
    constexpr double k = 50.0, m = 0.02, l = 0.1;  // T = k l
    for (int j : {1, 3, 6})
        expectMode(chain(n, m, l, k, 0.0), sine(n, j, glm::normalize(dvec3(0.3, 1.0, 0.5))), 0.05,
                   2.0 * std::sqrt(k / m) * std::sin(j * pi / (2 * (n + 1))), 1e-10);
}

// 2 √(T/mℓ) sin(κℓ/2). A swing of A lengthens the string by a share (κA)²/4 and raises its tension by as much times
// k ℓ/T = 20: with A = 1e-6 ℓ the frequency is off by less than 1e-10, after 60 radians the phase by 1e-8.
TEST(TautString, SwingsAcrossAtTheFrequencyOfItsTension) {
    constexpr int n = 8;
    constexpr double k = 500.0, m = 0.02, l = 0.1, tension = k * 0.05 * l;
    for (int j = 1; j <= n; ++j)
        for (dvec3 across : {dvec3(0, 1, 0), dvec3(0, 0.6, 0.8)})
            expectMode(chain(n, m, l, k, 0.95 * l), sine(n, j, across), 1e-6 * l,
                       2.0 * std::sqrt(tension / (m * l)) * std::sin(j * pi / (2 * (n + 1))), 1e-8);
}

// ω²_pq = (4T/mℓ) [sin²(pπ/2(n+1)) + sin²(qπ/2(n+1))]; tolerance as for the string.
TEST(SquareNet, UnderTensionHasTheFrequenciesOfADrum) {
    constexpr int n = 5;
    constexpr double l = 0.1, k = 400.0, stretch = 0.1, tension = k * stretch * l, density = 2.0;
    Model net = mechanics::buildCloth({.origin = {0, 0, 0},
                                       .size = {(n + 1) * l, (n + 1) * l},
                                       .cells = {n + 1, n + 1},
                                       .material = {density, k, 0.0, 0.0, 0.0, 0.0, mechanics::Lumping::weighted}});
    hold(net, "edges");
    for (mechanics::Spring& s : net.springs) s.restLength = (1.0 - stretch) * l;
    const double m = density * l * l;
    for (auto [p, q] : std::array<std::array<int, 2>, 4>{{{1, 1}, {2, 1}, {3, 4}, {5, 5}}}) {
        SCOPED_TRACE("mode " + std::to_string(p) + ", " + std::to_string(q));
        std::vector<dvec3> shape;
        for (int j = 0; j <= n + 1; ++j)
            for (int i = 0; i <= n + 1; ++i) {
                const bool edge = i == 0 || j == 0 || i == n + 1 || j == n + 1;
                shape.emplace_back(0, 0, edge ? 0.0 : std::sin(i * p * pi / (n + 1)) * std::sin(j * q * pi / (n + 1)));
            }
        const double sp = std::sin(p * pi / (2 * (n + 1))), sq = std::sin(q * pi / (2 * (n + 1)));
        expectMode(net, shape, 1e-6 * l, std::sqrt(4.0 * tension / (m * l) * (sp * sp + sq * sq)), 1e-8);
    }
}

// Hung from a held point; its length in equilibrium is l0. Up and down it is linear; to the side it is a pendulum,
// whose frequency an amplitude of 1e-5 changes by 1e-10/16.
TEST(ElasticPendulum, HasTwoFrequencies) {
    constexpr double l0 = 0.8, k = 70.0, m = 0.3;  // √(k/m) = 15.3 is far from twice √(g/l0) = 3.5
    Model model;
    addPoint(model, {0, 0, 0}, 1.0, true);
    addPoint(model, {0, -l0, 0}, m);
    addSpring(model, 0, 1, k, l0 - m * g / k);
    const dvec3 none(0.0), gravity(0, -g, 0);
    expectMode(model, {none, {0, 1, 0}}, 0.02, std::sqrt(k / m), 1e-11, gravity);
    expectMode(model, {none, {1, 0, 0}}, 1e-5, std::sqrt(g / l0), 1e-8, gravity);
    expectMode(model, {none, {0.8, 0, -0.6}}, 1e-5, std::sqrt(g / l0), 1e-8, gravity);
}

double laguerre(int n, double x) {
    double before = 0.0, now = 1.0;
    for (int r = 0; r < n; ++r) {
        const double next = ((2 * r + 1 - x) * now - r * before) / (r + 1);
        before = now;
        now = next;
    }
    return now;
}

// The zeros lie below 4n; the polynomial changes its sign at each.
std::vector<double> laguerreZeros(int n) {
    std::vector<double> zeros;
    constexpr double grid = 1e-3;
    for (double low = 0.0; low < 4.0 * n; low += grid) {
        double a = low, b = low + grid;
        if ((laguerre(n, a) > 0) == (laguerre(n, b) > 0)) continue;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (a + b);
            ((laguerre(n, middle) > 0) == (laguerre(n, a) > 0) ? a : b) = middle;
        }
        zeros.push_back(0.5 * (a + b));
    }
    return zeros;
}

// ω² = (g/ℓ) λ with L_n(λ) = 0, and the mass number r from the lower end swings by L_r(λ). The links have length ℓ in
// equilibrium, so that their stiffness does not enter to first order; to second it lifts the masses by A²/ℓ and
// changes tensions by a share of (k ℓ/T)(A/ℓ)², 1e-8 where A = 5e-6 ℓ and T is the weight of one mass: 6e-7 after 60
// radians. Rounding of positions near 1 m is 1e-10 of the amplitude a step.
TEST(HangingChain, SwingsAtTheZerosOfLaguerrePolynomials) {
    constexpr double l = 0.2, m = 0.05;
    for (int n : {1, 2, 3, 5}) {
        const double k = 50.0 * n * m * g / l;
        Model model;
        addPoint(model, {0, 0, 0}, 1.0, true);
        for (int i = 1; i <= n; ++i) {
            addPoint(model, {0, -i * l, 0}, m);
            addSpring(model, i - 1, i, k, l - (n - i + 1) * m * g / k);
        }
        const std::vector<double> zeros = laguerreZeros(n);
        ASSERT_EQ(zeros.size(), static_cast<std::size_t>(n));
        for (double zero : zeros) {
            SCOPED_TRACE("n = " + std::to_string(n) + ", zero " + std::to_string(zero));
            std::vector<dvec3> shape(static_cast<std::size_t>(n) + 1, dvec3(0.0));
            double largest = 0.0;
            for (int r = 0; r < n; ++r) largest = std::max(largest, std::abs(laguerre(r, zero)));
            for (int r = 0; r < n; ++r) shape[n - r] = {laguerre(r, zero) / largest, 0, 0};
            expectMode(model, shape, 5e-6 * l, std::sqrt(g / l * zero), 1e-6, {0, -g, 0});
        }
    }
}

}  // namespace
}  // namespace taut::test::linear_modes
