// Products of the linearised forces against differences of the forces themselves, and that none is ever negative.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "taut/core/private/instruction_set.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/private/anchor.h"
#include "taut/mechanics/private/volume.h"
#include "taut/mechanics/private/wind.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using System = MassSpringSystem<double>;
using Planes = std::vector<double>;

struct Accelerations final : ode::AccelerationSink<double> {
    Accelerations(ode::Layout l) : layout(l), a(l.size(), 0.0) {}
    void take(int first, int last, const double* const* values) override {
        for (int p = 0; p < 3; ++p)
            for (int i = first; i < last; ++i) a[p * layout.stride + i] = values[p][i - first];
    }
    ode::Layout layout;
    Planes a;
};

std::unique_ptr<System> systemOf(const Model& model) {
    std::vector<System::PointMass> points;
    for (double m : model.masses) points.push_back({m, 0.0, false});
    const std::vector<System::Body> bodies{{0, model.grid[0] > 0 ? model.grid[0] + 1 : 0}};
    return std::make_unique<System>(points, bodies, model.springs);
}

Planes planesOf(const System& system, const std::vector<dvec3>& vectors) {
    const ode::Layout layout = system.layout();
    Planes planes(layout.size(), 0.0);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        for (int p = 0; p < 3; ++p) planes[static_cast<std::size_t>(p * layout.stride) + i] = vectors[i][p];
    return planes;
}

std::vector<dvec3> randomVectors(std::size_t count, double size, unsigned seed) {
    std::mt19937 generator(seed);
    std::vector<dvec3> all;
    const auto next = [&] { return size * (static_cast<double>(generator()) / 2147483648.0 - 1.0); };
    for (std::size_t i = 0; i < count; ++i) {
        const double x = next(), y = next(), z = next();
        all.emplace_back(x, y, z);
    }
    return all;
}

Planes forces(System& system, const Planes& x, const Planes& v) {
    Accelerations sink(system.layout());
    system.accelerate(0.3, x.data(), v.data(), sink);
    for (int p = 0; p < 3; ++p)
        for (int i = 0; i < system.layout().count; ++i) sink.a[p * system.layout().stride + i] *= system.masses()[i];
    return sink.a;
}

Planes product(System& system, const Planes& x, const Planes& v, double stiffness, double damping, const Planes& u) {
    system.linearise(0.3, x.data(), v.data(), stiffness, damping);
    Planes out(u.size(), 0.0);
    system.addProduct(u.data(), out.data());
    return out;
}

double norm(const Planes& a) {
    double sum = 0.0;
    for (double x : a) sum += x * x;
    return std::sqrt(sum);
}

// (F(x - eu) - F(x + eu))/2e against W u, in the same way for v. Central differences at e = 1e-6: e² of the third
// derivative and 1e-16/e of rounding, 1e-9 of the product.
void expectDerivatives(System& system, const Planes& x, const Planes& v, double tolerance = 1e-7) {
    constexpr double e = 1e-6;
    for (unsigned seed = 1; seed < 4; ++seed) {
        const Planes u = planesOf(system, randomVectors(static_cast<std::size_t>(system.layout().count), 1.0, seed));
        for (bool ofVelocity : {false, true}) {
            Planes fore = ofVelocity ? v : x, back = fore;
            for (std::size_t i = 0; i < u.size(); ++i) {
                fore[i] += e * u[i];
                back[i] -= e * u[i];
            }
            const Planes plus = ofVelocity ? forces(system, x, fore) : forces(system, fore, v);
            const Planes minus = ofVelocity ? forces(system, x, back) : forces(system, back, v);
            const Planes is = product(system, x, v, ofVelocity ? 0.0 : 1.0, ofVelocity ? 1.0 : 0.0, u);
            Planes difference(u.size());
            for (std::size_t i = 0; i < u.size(); ++i) difference[i] = is[i] - (minus[i] - plus[i]) / (2 * e);
            EXPECT_LE(norm(difference), tolerance * norm(is)) << (ofVelocity ? "C" : "K");
        }
    }
}

Model cloth() {
    return buildCloth({.size = {1.2, 0.9}, .cells = {12, 9}, .material = {0.2, 300.0, 150.0, 3.0, 2e-3, 0.0, {}}});
}

// Everything stretched: then nothing is left out. Velocities would add the dashpots' share of K, which is left out.
TEST(ImplicitProducts, AreTheDerivativesOfTheForcesOfAStretchedClothOnAnchors) {
    const Model model = cloth();
    const auto system = systemOf(model);
    system->add(std::make_unique<Anchor<double>>(std::vector<int>{3, 17, 60}, dvec3(0.2, 0.5, -0.3), 80.0, 0.7));
    std::vector<dvec3> places = model.positions, stir = randomVectors(places.size(), 0.01, 9);
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = 1.5 * places[i] + stir[i];
    const Planes x = planesOf(*system, places), v(x.size(), 0.0);
    expectDerivatives(*system, x, v);
}

TEST(ImplicitProducts, AreTheDerivativesOfVolumeForcesAtRestShape) {
    const Model block = buildBlock({.cells = {3, 2, 2}, .young = 1e4, .bulk = 3e4, .dampingTime = 1e-3});
    const auto system = systemOf(block);
    system->add(std::make_unique<VolumePreservation<double>>(block.cells, block.positions));
    const Planes x = planesOf(*system, block.positions), v(x.size(), 0.0);
    // At rest the force turns from none to some: third derivatives of 1/l² enter, 1e-12/0.1².
    expectDerivatives(*system, x, v, 1e-6);
}

// Broadside, u along n, the drag's share is the whole derivative; lift has none of its own along n and is switched off.
// Of rods and balls it is that for any wind.
TEST(ImplicitProducts, AreTheDerivativesOfTheDragOfAClothBroadsideToTheWind) {
    const Model model = cloth();
    const auto system = systemOf(model);
    WindSettings settings;
    settings.lift = 0.0;
    system->add(std::make_unique<Wind<double>>(model.triangles, dvec3(0, 0, 6.0), settings));
    const dvec3 aslant(2.0, -5.0, 3.0);
    system->add(std::make_unique<Wind<double>>(
        WindTargets{.rounds = {{.a = 0, .b = 7, .width = 0.1}, {.a = 3, .b = 3, .area = 0.05}}},
        LinearPath{aslant, aslant}, settings));
    const Planes x = planesOf(*system, model.positions), v(x.size(), 0.0);
    const Planes u = planesOf(*system, randomVectors(model.positions.size(), 1.0, 3));
    constexpr double e = 1e-6;
    Planes fore = v, back = v;
    for (std::size_t i = 0; i < u.size(); ++i) {
        fore[i] += e * u[i];
        back[i] -= e * u[i];
    }
    const Planes plus = forces(*system, x, fore), minus = forces(*system, x, back);
    const Planes is = product(*system, x, v, 0.0, 1.0, u);
    for (std::size_t i = 0; i < u.size(); ++i)
        EXPECT_NEAR(is[i], (minus[i] - plus[i]) / (2 * e), 1e-7 * norm(is)) << i;  // as above
}

// Crumpled, squashed, blown at from anywhere: W is symmetric and never negative, its diagonal that of the products.
TEST(ImplicitProducts, AreSymmetricAndNeverNegative) {
    const Model block = buildBlock({.cells = {3, 3, 3}, .young = 1e4, .bulk = 3e4, .dampingTime = 1e-3});
    const auto system = systemOf(block);
    system->add(std::make_unique<VolumePreservation<double>>(block.cells, block.positions));
    const dvec3 flow(3, -5, 2);
    system->add(std::make_unique<Wind<double>>(
        WindTargets{.triangles = {{0, 1, 5}, {3, 9, 30}, {12, 40, 7}},
                    .rounds = {{.a = 2, .b = 9, .width = 0.3}, {.a = 5, .b = 5, .area = 0.2}}},
        LinearPath{flow, flow}, WindSettings{}));
    const std::size_t n = block.positions.size();
    for (unsigned seed = 1; seed < 6; ++seed) {
        std::vector<dvec3> places = randomVectors(n, 0.3, seed);
        if (seed == 5) places.assign(n, dvec3(0.1));  // all in one place
        const Planes x = planesOf(*system, places), v = planesOf(*system, randomVectors(n, 3.0, 50 + seed));
        for (unsigned other = 1; other < 6; ++other) {
            const Planes a = planesOf(*system, randomVectors(n, 1.0, 100 + other)),
                         b = planesOf(*system, randomVectors(n, 1.0, 200 + other));
            const Planes wa = product(*system, x, v, 0.3, 0.02, a), wb = product(*system, x, v, 0.3, 0.02, b);
            double ab = 0.0, ba = 0.0, aa = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                ab += b[i] * wa[i];
                ba += a[i] * wb[i];
                aa += a[i] * wa[i];
            }
            EXPECT_NEAR(ab, ba, 1e-10 * norm(wa) * norm(b));  // rounding
            EXPECT_GE(aa, 0.0);
        }
        Planes diagonal(x.size(), 0.0);
        system->linearise(0.3, x.data(), v.data(), 0.3, 0.02);
        system->addDiagonal(diagonal.data());
        for (std::size_t i : {std::size_t{0}, std::size_t{7}, static_cast<std::size_t>(system->layout().stride) + 3}) {
            Planes unit(x.size(), 0.0), out = unit;
            unit[i] = 1.0;
            system->addProduct(unit.data(), out.data());
            EXPECT_NEAR(out[i], diagonal[i], 1e-12 * std::abs(diagonal[i]) + 1e-300);  // rounding
        }
    }
}

TEST(ImplicitProducts, AreTheSameBitsForEveryInstructionSet) {
    const core::InstructionSet before = core::instructionSet();
    const Model model = cloth();
    Planes results[3];
    std::size_t count = 0;
    for (core::InstructionSet set :
         {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512}) {
        if (!core::isSupported(set)) continue;
        core::useInstructionSet(set);
        const auto system = systemOf(model);
        std::vector<dvec3> places = model.positions, stir = randomVectors(places.size(), 0.03, 9);
        for (std::size_t i = 0; i < places.size(); ++i) places[i] += stir[i];
        const Planes x = planesOf(*system, places), v = planesOf(*system, stir);
        results[count++] = product(*system, x, v, 1e-4, 1e-2, planesOf(*system, randomVectors(places.size(), 1.0, 4)));
    }
    core::useInstructionSet(before);
    for (std::size_t i = 1; i < count; ++i) EXPECT_EQ(results[0], results[i]);
    EXPECT_GT(norm(results[0]), 0.0);
}

}  // namespace
}  // namespace taut::mechanics
