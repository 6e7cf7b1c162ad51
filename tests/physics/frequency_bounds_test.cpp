// Bounds and estimates of the fastest motion of a network, against the eigenvalues of the whole matrix.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "support/dense_stiffness.h"
#include "support/network.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"
#include "taut/mechanics/private/state_bound.h"
#include "taut/mechanics/private/volume.h"

namespace taut::test::frequency_bounds {
namespace {

using core::pi;
using mechanics::Model;

// Numbers in [0, 1) from a linear congruence (Knuth's MMIX), the same everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 2862933555777941757ULL + 3037000493ULL) {}
    double operator()() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * (*this)(); }

  private:
    std::uint64_t state_;
};

std::vector<double> inverseMassesOf(const Model& model) {
    std::vector<double> w;
    for (std::size_t i = 0; i < model.masses.size(); ++i) w.push_back(model.held[i] ? 0.0 : 1.0 / model.masses[i]);
    return w;
}

double bound1(const Model& model) {
    return mechanics::boundAnywhere({model.springs, inverseMassesOf(model)}, {}).omega;
}
double bound2(const Model& model, std::span<const dvec3> positions) {
    return mechanics::boundHere({model.springs, inverseMassesOf(model)}, {}, positions).omega;
}
mechanics::StiffnessProduct stiffnessOf(const Model& model, std::span<const dvec3> positions) {
    return [&model, positions](std::span<const dvec3> u, std::span<dvec3> out) {
        mechanics::addSpringStiffness(model.springs, positions, u, out);
    };
}
double lanczos(const Model& model, std::span<const dvec3> positions) {
    return mechanics::estimateFrequency(inverseMassesOf(model), stiffnessOf(model, positions));
}
double lowerBound(const Model& model, std::span<const dvec3> positions) {
    return mechanics::leastFrequency(inverseMassesOf(model), stiffnessOf(model, positions));
}

// Springs between random points, of rest lengths `stretch` times shorter than they are, give or take a half.
Model randomNetwork(std::uint64_t seed, double stretch) {
    Random random(seed);
    Model model;
    const int n = 6 + static_cast<int>(10.0 * random());
    for (int i = 0; i < n; ++i)
        addPoint(model, {random(), random(), random()}, std::pow(10.0, random.between(-2, 0)), random() < 0.2);
    for (int i = 0; i < 4 * n; ++i) {
        const int a = static_cast<int>(n * random()), b = static_cast<int>(n * random());
        if (a == b) continue;
        const double l = glm::length(model.positions[b] - model.positions[a]);
        addSpring(model, a, b, std::pow(10.0, random.between(1, 4)), l / stretch * random.between(0.5, 1.5));
    }
    return model;
}

// 1e-12 is rounding: the bounds themselves must not be crossed.
TEST(FrequencyBounds, AreNeverBelowTheTruthOnRandomNetworks) {
    for (double stretch : {0.5, 1.0, 2.0, 50.0})  // compressed, at rest, pretensioned, nearly without rest length
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            SCOPED_TRACE("stretch " + std::to_string(stretch) + ", seed " + std::to_string(seed));
            const Model model = randomNetwork(seed, stretch);
            const double truth = fastestFrequency(model, model.positions);
            const double here = bound2(model, model.positions), anywhere = bound1(model);
            EXPECT_GE(here * (1.0 + 1e-12), truth);
            EXPECT_GE(anywhere * (1.0 + 1e-12), here);
            EXPECT_LE(lowerBound(model, model.positions), truth * (1.0 + 1e-12));
            // And not idle: √2 at most where a light point meets heavy ones, a little more on the way there; compressed
            // springs weaken a network, which the bound does not count.
            EXPECT_LT(here, (stretch < 1.0 ? 2.5 : 1.6) * truth);
        }
}

TEST(FrequencyBounds, TheFirstHoldsWhereverThePointsGo) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Model model = randomNetwork(seed, 1.0);
        const double anywhere = bound1(model);
        Random random(seed + 1000);
        for (int i = 0; i < 5; ++i) {
            std::vector<dvec3> positions = model.positions;
            const double scale = std::pow(10.0, random.between(-2, 2));
            for (dvec3& x : positions) x = scale * dvec3(random(), random(), random());
            EXPECT_GE(anywhere * (1.0 + 1e-12), fastestFrequency(model, positions))
                << "seed " << seed << ", scale " << scale;
        }
    }
}

TEST(FrequencyBounds, CountWhatElseIsStiff) {
    Model model;
    addPoint(model, {0, 0, 0}, 0.5);
    addPoint(model, {1, 0, 0}, 2.0);
    addSpring(model, 0, 1, 100.0, 1.0);
    const std::vector<double> extra{30.0, 0.0};
    // An anchor of 30 N/m on the light point: K = [[130, -100], [-100, 100]], divided by the roots of the masses.
    Matrix matrix(2);
    matrix.at(0, 0) = 260.0;
    matrix.at(1, 1) = 50.0;
    matrix.at(0, 1) = matrix.at(1, 0) = -100.0;
    const double truth = std::sqrt(eigenvalues(matrix).back());
    const std::vector<double> inverseMasses = inverseMassesOf(model);
    const mechanics::NetworkView view{model.springs, inverseMasses};
    // Both are √(200 + 50 + 60) here, and the truth √(299.9).
    EXPECT_NEAR(mechanics::boundAnywhere(view, extra).omega, std::sqrt(310.0), 1e-12);
    EXPECT_NEAR(mechanics::boundHere(view, extra, model.positions).omega, std::sqrt(310.0), 1e-12);
    EXPECT_LT(truth, std::sqrt(310.0));
}

Model cloth(int cells, double ks, double kd, double kb, double stretch = 1.0) {
    Model model = mechanics::buildCloth({.size = {0.05 * cells, 0.05 * cells},
                                         .cells = {cells, cells},
                                         .material = {0.18, ks, kd, kb, 0.0, 0.0, mechanics::Lumping::weighted}});
    for (dvec3& x : model.positions) x *= stretch;
    return model;
}

TEST(FrequencyBounds, AreTightOnCloth) {
    for (double stretch : {1.0, 1.1, 0.95}) {
        SCOPED_TRACE("stretched to " + std::to_string(stretch));
        const Model model = cloth(7, 900, 450, 2, stretch);
        const double truth = fastestFrequency(model, model.positions);
        const double here = bound2(model, model.positions) / truth, anywhere = bound1(model) / truth;
        EXPECT_GE(here, 1.0 - 1e-12);
        EXPECT_LT(here, 1.20);  // measured on many networks: within 1–20 %
        EXPECT_GT(anywhere, 1.2);
        EXPECT_LT(anywhere, 1.55);  // about 1.4–1.5 times ω
    }
}

// M^{-1/2} K M^{-1/2} of springs and cells at these positions, K of the cells from its product with unit vectors.
double fastestOfBlock(const Model& model, std::span<const dvec3> positions) {
    Matrix matrix = scaledStiffness(model, positions);
    const mechanics::VolumePreservation<double> volume(model.cells, model.positions);
    const std::size_t n = model.positions.size();
    std::vector<double> x, u(3 * n, 0.0), product(3 * n);
    for (int p = 0; p < 3; ++p)
        for (const dvec3& position : positions) x.push_back(position[p]);
    mechanics::Motion<double> motion{.count = static_cast<int>(n), .stride = static_cast<int>(n), .x = x.data()};
    for (std::size_t column = 0; column < 3 * n; ++column) {
        u[column] = 1.0;
        std::fill(product.begin(), product.end(), 0.0);
        volume.addStiffnessProduct(motion, u.data(), product.data());
        u[column] = 0.0;
        for (std::size_t row = 0; row < 3 * n; ++row)
            matrix.at(3 * (row % n) + row / n, 3 * (column % n) + column / n) +=
                product[row] / std::sqrt(model.masses[row % n] * model.masses[column % n]);
    }
    return std::sqrt(std::max(0.0, eigenvalues(matrix).back()));
}

struct Lattice {
    dvec3 size;  // [m]
    glm::ivec3 cells;
    double bulkOverYoung;
};

class FrequencyBoundsOfBlocks : public testing::TestWithParam<Lattice> {
  protected:
    Model model_ = mechanics::buildBlock(
        {.size = GetParam().size, .cells = GetParam().cells, .young = 2e4, .bulk = 2e4 * GetParam().bulkOverYoung});
    std::vector<double> inverseMasses_ = inverseMassesOf(model_);
    mechanics::NetworkView view_{model_.springs, inverseMasses_, model_.cells};
    static constexpr double workingStretch = 1.5;

    double here(std::span<const dvec3> positions) const { return mechanics::boundHere(view_, {}, positions).omega; }
    // As looked at every tick, with weights from rest.
    double followed(std::span<const dvec3> positions) const {
        const int n = static_cast<int>(positions.size());
        mechanics::StateBound<double> bound(n, n);
        bound.setCells(model_.cells, model_.positions);
        std::vector<double> x;
        for (int p = 0; p < 3; ++p)
            for (const dvec3& position : positions) x.push_back(position[p]);
        const std::vector<mechanics::PointRange> whole{{0, 0}};
        const mechanics::SpringNetwork<double> network(n, whole, model_.springs);
        return std::sqrt(bound(network, x.data(), inverseMasses_.data()).omega2);
    }
    std::vector<dvec3> deformed(const glm::dmat3& by) const {
        std::vector<dvec3> positions = model_.positions;
        for (dvec3& x : positions) x = by * x;
        return positions;
    }
};

TEST_P(FrequencyBoundsOfBlocks, AreTightAtRestAndOverTheWorkingRange) {
    const double truth = fastestOfBlock(model_, model_.positions);
    EXPECT_GE(here(model_.positions), truth);
    EXPECT_LE(here(model_.positions), 1.45 * truth);
    EXPECT_LE(followed(model_.positions), 1.45 * truth);

    // The largest true ω of the corners of the range and of states within it.
    Random random(7);
    double largest = 0;
    const auto look = [&](const glm::dmat3& by) { largest = std::max(largest, fastestOfBlock(model_, deformed(by))); };
    look(glm::dmat3(workingStretch));
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 thick(1.0), thin(workingStretch);
        thick[axis] = -workingStretch;
        thin[axis] = -1.0 / workingStretch;
        look(glm::dmat3({thick.x, 0, 0}, {0, thick.y, 0}, {0, 0, thick.z}));
        look(glm::dmat3({thin.x, 0, 0}, {0, thin.y, 0}, {0, 0, thin.z}));
    }
    for (const dvec3& scale : {dvec3(1.5, 1, 1), dvec3(1.5, 0.02, 1.5), dvec3(1, -1, 1), dvec3(1.4, -0.5, 1.4)})
        look(glm::dmat3({scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}));
    for (int i = 0; i < 10; ++i) {
        std::vector<dvec3> positions = model_.positions;
        for (dvec3& x : positions)
            x += 0.03 * dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        largest = std::max(largest, fastestOfBlock(model_, positions));
    }
    const double within = mechanics::boundWithin(view_, {}, model_.positions, workingStretch).omega;
    EXPECT_GE(within, largest);
    EXPECT_LE(within, 1.45 * largest);
}

// Sheared, stretched, mirrored, and every point pushed by up to a cell.
TEST_P(FrequencyBoundsOfBlocks, AreNeverBelowTheTruthInWildDeformations) {
    Random random(11);
    for (int i = 0; i < 100; ++i) {
        glm::dmat3 by;
        for (int c = 0; c < 3; ++c)
            by[c] = {random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.5, 1.5)};
        std::vector<dvec3> positions = deformed(by);
        const double stir = random.between(0.0, 0.1);
        for (dvec3& x : positions)
            x += stir * dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        const double truth = fastestOfBlock(model_, positions);
        EXPECT_GE(here(positions), truth) << "deformation " << i;
        EXPECT_GE(followed(positions), truth) << "deformation " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, FrequencyBoundsOfBlocks,
    testing::Values(Lattice{{0.2, 0.2, 0.2}, {2, 2, 2}, 1.0}, Lattice{{0.2, 0.2, 0.2}, {2, 2, 2}, 0.1},
                    Lattice{{0.2, 0.2, 0.2}, {2, 2, 2}, 10.0}, Lattice{{0.4, 0.1, 0.1}, {4, 1, 1}, 1.0},
                    Lattice{{0.4, 0.1, 0.1}, {4, 1, 1}, 0.1}, Lattice{{0.4, 0.1, 0.1}, {4, 1, 1}, 10.0},
                    Lattice{{0.3, 0.1, 0.3}, {3, 1, 3}, 1.0}, Lattice{{0.3, 0.1, 0.3}, {3, 1, 3}, 0.1},
                    Lattice{{0.3, 0.1, 0.3}, {3, 1, 3}, 10.0}, Lattice{{0.3, 0.2, 0.1}, {2, 2, 2}, 1.0},
                    Lattice{{0.3, 0.2, 0.1}, {2, 2, 2}, 0.1}, Lattice{{0.3, 0.2, 0.1}, {2, 2, 2}, 10.0}));

TEST(FrequencyEstimate, IsWithinOnePercent) {
    for (double stretch : {1.0, 1.3, 0.9}) {
        const Model model = cloth(7, 900, 450, 2, stretch);
        EXPECT_NEAR(lanczos(model, model.positions) / fastestFrequency(model, model.positions), 1.0, 0.01) << stretch;
    }
    for (double stretch : {0.5, 1.0, 2.0})
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            const Model model = randomNetwork(seed, stretch);
            EXPECT_NEAR(lanczos(model, model.positions) / fastestFrequency(model, model.positions), 1.0, 0.01)
                << "stretch " << stretch << ", seed " << seed;
        }
}

TEST(FrequencyEstimate, IsExactForTheSmallestNetworks) {
    Model model;
    addPoint(model, {0, 0, 0}, 0.5);
    EXPECT_EQ(lanczos(model, model.positions), 0.0);
    addPoint(model, {0.3, 0.4, 0}, 0.25);
    addSpring(model, 0, 1, 90.0, 0.5);
    EXPECT_NEAR(lanczos(model, model.positions), std::sqrt(90.0 * 6.0), 1e-9);  // rounding of a square root of rounding
    model.held[0] = true;
    EXPECT_NEAR(lanczos(model, model.positions), std::sqrt(90.0 * 4.0), 1e-9);
    model.held[1] = true;
    EXPECT_EQ(lanczos(model, model.positions), 0.0);
}

// 2 √(k/m) cos(π/2(n+1)); rounding.
TEST(ClosedForms, GiveTheFastestMotionOfARope) {
    constexpr int n = 9;
    constexpr double k = 400.0, m = 0.05;
    Model model;
    for (int i = 0; i <= n + 1; ++i) addPoint(model, {0.1 * i, 0, 0}, m, i == 0 || i == n + 1);
    for (int i = 0; i <= n; ++i) addSpring(model, i, i + 1, k, 0.1);
    const double ought = 2.0 * std::sqrt(k / m) * std::cos(pi / (2 * (n + 1)));
    EXPECT_NEAR(fastestFrequency(model, model.positions) / ought, 1.0, 1e-12);
    EXPECT_NEAR(lanczos(model, model.positions) / ought, 1.0, 1e-3);
    EXPECT_NEAR(bound1(model), 2.0 * std::sqrt(k / m), 1e-9);  // for any number of points
}

// m ω² = max{4A; (4kb + A)²/4kb if kb > A/4; (4B + ks)²/4B if B > ks/4}, A = ks + kd, B = kb + kd, on the endless grid.
double gridFrequency(double ks, double kd, double kb, double m) {
    const double a = ks + kd, b = kb + kd;
    double most = 4.0 * a;
    if (kb > a / 4) most = std::max(most, (4.0 * kb + a) * (4.0 * kb + a) / (4.0 * kb));
    if (b > ks / 4) most = std::max(most, (4.0 * b + ks) * (4.0 * b + ks) / (4.0 * b));
    return std::sqrt(most / m);
}

// The same from plane waves e^{i(p u + q v)}: the larger eigenvalue of a 2×2 matrix, the largest over a fine grid of
// waves.
double waveFrequency(double ks, double kd, double kb, double m) {
    constexpr int waves = 400;
    double most = 0.0;
    for (int i = 0; i <= waves; ++i)
        for (int j = 0; j <= waves; ++j) {
            const double p = pi * i / waves, q = pi * j / waves;
            const double diagonals = 2.0 * kd * (1.0 - std::cos(p) * std::cos(q));
            const double xx = 2.0 * ks * (1.0 - std::cos(p)) + 2.0 * kb * (1.0 - std::cos(2.0 * p)) + diagonals;
            const double yy = 2.0 * ks * (1.0 - std::cos(q)) + 2.0 * kb * (1.0 - std::cos(2.0 * q)) + diagonals;
            const double xy = 2.0 * kd * std::sin(p) * std::sin(q);
            most = std::max(most, 0.5 * (xx + yy) + std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy));
        }
    return std::sqrt(most / m);
}

TEST(ClosedForms, GiveTheFastestMotionOfAGrid) {
    const double cases[][3] = {{900, 450, 2}, {900, 100, 1}, {200, 50, 400}, {100, 400, 30}, {900, 450, 300}};
    for (const auto& [ks, kd, kb] : cases) {
        SCOPED_TRACE("ks " + std::to_string(ks) + ", kd " + std::to_string(kd) + ", kb " + std::to_string(kb));
        const double m = 0.18 * 0.05 * 0.05;
        const double ought = gridFrequency(ks, kd, kb, m);
        EXPECT_NEAR(waveFrequency(ks, kd, kb, m) / ought, 1.0, 1e-4);  // the grid of waves misses the peak by (π/800)²
        // With free edges a cloth may have faster modes that live there; held edges leave the inside, which is slower
        // than the endless grid by a share (π/40)²/4. The estimate has its 1 %.
        Model model = cloth(40, ks, kd, kb);
        hold(model, "edges");
        EXPECT_NEAR(lanczos(model, model.positions) / ought, 1.0, 0.015);
        EXPECT_GE(bound2(model, model.positions) * (1.0 + 1e-12), ought);
    }
}

}  // namespace
}  // namespace taut::test::frequency_bounds
