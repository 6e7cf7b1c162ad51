// The material properties of a block: pulled and bent at rest, by the products of its springs and cells.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "mechanics_planar_state.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"
#include "taut/mechanics/private/volume.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using Vectors = std::vector<dvec3>;  // (points)

class RestingBlock {
  public:
    explicit RestingBlock(const BlockShape& shape)
        : model_(buildBlock(shape)), state_(model_), volume_(model_.cells, model_.positions) {}

    const Model& model() const { return model_; }

    // The small displacement under forces that act on the right face, per area evenly [N], where `isFree(point, axis)`.
    // By conjugate gradients.
    Vectors underLoad(const dvec3& force, const std::function<bool(int, int)>& isFree) {
        const std::size_t n = model_.positions.size();
        const auto keepFree = [&](Vectors& v) {
            for (std::size_t i = 0; i < n; ++i)
                for (int axis = 0; axis < 3; ++axis)
                    if (!isFree(static_cast<int>(i), axis)) v[i][axis] = 0.0;
        };
        const auto product = [](const Vectors& a, const Vectors& b) {
            return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                                         [](const dvec3& u, const dvec3& v) { return glm::dot(u, v); });
        };
        Vectors u(n, dvec3(0.0)), r = u, q(n);
        spread(force, r);
        keepFree(r);
        Vectors p = r;
        double square = product(r, r);
        const double enough = 1e-22 * square;
        while (square > enough) {
            stiffness(p, q);
            keepFree(q);
            const double step = square / product(p, q), before = square;
            for (std::size_t i = 0; i < n; ++i) {
                u[i] += step * p[i];
                r[i] -= step * q[i];
            }
            square = product(r, r);
            for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + square / before * p[i];
        }
        return u;
    }

    // Distributes the force on the right face by the area around its points: half at its edges, a quarter at its
    // corners.
    void spread(const dvec3& whole, Vectors& onPoints) const {
        const std::vector<int>& face = model_.groups.at("right");
        const dvec3 corner = model_.positions[face.back()];
        std::vector<double> areas;
        for (int i : face) {
            const dvec3& at = model_.positions[i];
            const auto part = [&](int axis) { return std::abs(at[axis]) > 0.999 * std::abs(corner[axis]) ? 0.5 : 1.0; };
            areas.push_back(part(1) * part(2));
        }
        const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
        for (std::size_t k = 0; k < face.size(); ++k) onPoints[face[k]] = areas[k] / sum * whole;
    }
    // Mean over the right face.
    dvec3 tip(const Vectors& u) const {
        Vectors shares(u.size(), dvec3(0.0));
        spread(dvec3(1.0), shares);
        dvec3 mean(0.0);
        for (std::size_t i = 0; i < u.size(); ++i) mean += shares[i] * u[i];
        return mean;
    }

  private:
    void stiffness(const Vectors& u, Vectors& out) {
        std::fill(out.begin(), out.end(), dvec3(0.0));
        addSpringStiffness(model_.springs, model_.positions, u, out);
        core::AlignedArray<double> in(state_.planes()), sum(state_.planes());
        for (std::size_t i = 0; i < u.size(); ++i)
            for (int axis = 0; axis < 3; ++axis) in[state_.index(static_cast<int>(i), axis)] = u[i][axis];
        volume_.addStiffnessProduct(state_.motion(), in.data(), sum.data());
        for (std::size_t i = 0; i < u.size(); ++i)
            for (int axis = 0; axis < 3; ++axis) out[i][axis] += sum[state_.index(static_cast<int>(i), axis)];
    }

    Model model_;
    test::PlanarState<double> state_;
    VolumePreservation<double> volume_;
};

// A bar is pulled with its sides free: ε = σ/E along it, -ν ε across. Cells of 0.1 × 0.11 × 0.093 m are nearly cubes,
// for which the springs hold as well.
TEST(BlockModuli, HoldInATensionTest) {
    const double young = 3e5, stress = 1.0;
    for (const double poisson : {0.25, 0.3, 0.45})
        for (const dvec3& size : {dvec3(0.4, 0.2, 0.2), dvec3(0.4, 0.22, 0.186)}) {
            RestingBlock bar({.size = size, .cells = {4, 2, 2}, .young = young, .poisson = poisson});
            const Vectors u = bar.underLoad({stress * size.y * size.z, 0.0, 0.0}, [&](int point, int axis) {
                return bar.model().positions[point][axis] > -0.499 * size[axis];
            });
            const std::size_t far = u.size() - 1;  // the corner at the far ends of all axes
            EXPECT_NEAR(stress / (u[far].x / size.x), young, 1e-8 * young);
            for (int axis : {1, 2}) EXPECT_NEAR(-(u[far][axis] / size[axis]) / (u[far].x / size.x), poisson, 1e-8);
        }
}

// A bar of square section, ten times as long as high, clamped at one end and loaded at the other, against Timoshenko's
// beam: δ = F L³/(3 E I) + F L/(k G A), k = 10 (1 + ν)/(12 + 11 ν) for a rectangle (Cowper 1966). Measured with one,
// two and four cells across: 0.54, 0.81, 0.94 for ν = 1/4 and 0.63, 0.84, 0.94 for 0.45; with a pressure for each of
// six tetrahedra it was 0.14, 0.36, 0.66 for 0.45.
TEST(BlockModuli, CantileverDoesNotLock) {
    const double young = 1.0, force = 1e-6;
    for (const double poisson : {0.25, 0.35, 0.45}) {
        const auto ratio = [&](int across) {
            RestingBlock bar(
                {.size = {10.0, 1.0, 1.0}, .cells = {10 * across, across, across}, .young = young, .poisson = poisson});
            const Vectors u = bar.underLoad({0.0, force, 0.0},
                                            [&](int point, int) { return bar.model().positions[point].x > -4.99; });
            const double shear = young / (2.0 * (1.0 + poisson)), k = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
            return bar.tip(u).y / (force * 1000.0 / (3.0 * young / 12.0) + force * 10.0 / (k * shear));
        };
        const double two = ratio(2), four = ratio(4);
        EXPECT_GE(two, 0.80) << poisson;
        EXPECT_GE(four, 0.93) << poisson;
        EXPECT_GT(four, two) << poisson;
        EXPECT_LT(four, 1.0) << poisson;
    }
}

}  // namespace
}  // namespace taut::mechanics
