#include "taut/mechanics/spring_kernels.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mechanics_random_net.h"

namespace taut::mechanics::test {
namespace {

template <class Real>
class SpringKernelsOf : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(SpringKernelsOf, Precisions, );

constexpr int stride = 1008;

template <class Real>
std::vector<Real> randomPlanes(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Real> values(3 * stride);
    for (Real& value : values) value = static_cast<Real>(std::uniform_real_distribution<>(-1.0, 1.0)(random));
    return values;
}

// The definition, spring by spring.
template <class Real>
glm::dvec3 force(const std::vector<Real>& x, const std::vector<Real>& v, int a, int b, double k, double L, double tau) {
    glm::dvec3 d, u;
    for (int p = 0; p < 3; ++p) {
        const auto plane = static_cast<std::size_t>(p * stride);
        d[p] = static_cast<double>(x[plane + static_cast<std::size_t>(b)] - x[plane + static_cast<std::size_t>(a)]);
        u[p] = static_cast<double>(v[plane + static_cast<std::size_t>(b)] - v[plane + static_cast<std::size_t>(a)]);
    }
    const glm::dvec3 n = glm::normalize(d);
    return (k * (glm::length(d) - L) + k * tau * glm::dot(u, n)) * n;
}

// Lengths about the vectors and the slices of the kernel, offsets from overlapping to far apart, with and without
// dashpots: against the definition, and every instruction set against the first.
TYPED_TEST(SpringKernelsOf, RunsAddEachSpringToBothEndsWithTheSameBits) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const auto x = randomPlanes<Real>(1), v = randomPlanes<Real>(2), before = randomPlanes<Real>(3),
               k = randomPlanes<Real>(4);
    // Sums of at most three terms below 8 in size, each with some ten roundings.
    const double tolerance = 100.0 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    for (const int n : {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 33, 100, 127, 128, 129, 255, 256, 300})
        for (const int offset : {1, 2, 3, 15, 16, 17, 100, 127, 128, 129, 400})
            for (const double tau : {0.0, 0.125}) {
                std::vector<glm::dvec3> expected(stride, glm::dvec3(0.0));
                for (int i = 0; i < n; ++i) {
                    const double stiffness = static_cast<double>(k[static_cast<std::size_t>(i)]);
                    const glm::dvec3 f = force(x, v, i, i + offset, stiffness, 0.25, tau);
                    expected[static_cast<std::size_t>(i)] += f;
                    expected[static_cast<std::size_t>(i + offset)] -= f;
                }
                std::vector<Real> first;
                for (const core::InstructionSet set : supportedSets()) {
                    core::useInstructionSet(set);
                    std::vector<Real> f = before;
                    springKernels<Real>().run({n, offset, stride, stride, x.data(), v.data(), f.data(), k.data(),
                                               Real(0.25), static_cast<Real>(tau)});
                    if (first.empty()) {
                        first = f;
                        for (int p = 0; p < 3; ++p)
                            for (int i = 0; i < stride; ++i) {
                                const auto at = static_cast<std::size_t>(p * stride + i);
                                const double change = static_cast<double>(f[at]) - static_cast<double>(before[at]);
                                ASSERT_NEAR(change, expected[static_cast<std::size_t>(i)][p], tolerance)
                                    << "n " << n << ", offset " << offset << ", point " << i;
                                if (i >= n + offset) {
                                    ASSERT_EQ(f[at], before[at]);
                                }
                            }
                    }
                    ASSERT_EQ(f, first) << core::nameOf(set) << ", n " << n << ", offset " << offset;
                }
            }
}

// Far apart, so that every point has one spring and no sum an order.
TYPED_TEST(SpringKernelsOf, RunsOfDifferentSpringsEqualARunForEach) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const auto x = randomPlanes<Real>(1), v = randomPlanes<Real>(2), k = randomPlanes<Real>(3),
               rest = randomPlanes<Real>(4), tau = randomPlanes<Real>(5);
    const int n = 300, offset = 400;
    for (const core::InstructionSet set : supportedSets()) {
        core::useInstructionSet(set);
        std::vector<Real> together(3 * stride), oneByOne(3 * stride);
        springKernels<Real>().run({n, offset, stride, stride, x.data(), v.data(), together.data(), k.data(), Real(0),
                                   Real(0), rest.data(), tau.data()});
        for (std::size_t i = 0; i < n; ++i)
            springKernels<Real>().run({1, offset, stride, stride, x.data() + i, v.data() + i, oneByOne.data() + i,
                                       k.data() + i, rest[i], tau[i]});
        EXPECT_EQ(together, oneByOne) << core::nameOf(set);
    }
}

TYPED_TEST(SpringKernelsOf, ListsAddEachSpringToBothEndsWithTheSameBits) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const auto x = randomPlanes<Real>(1), v = randomPlanes<Real>(2), before = randomPlanes<Real>(3),
               k = randomPlanes<Real>(4);
    std::mt19937 random(5);
    const int windowFirst = 100, windowStride = 208;  // the window is a part of the points
    for (const int n : {1, 7, 63, 64, 65, 200}) {
        std::vector<int> a, b;
        std::vector<Real> rest, tau;
        std::vector<glm::dvec3> expected(static_cast<std::size_t>(windowStride), glm::dvec3(0.0));
        double largest = 0.0;
        for (int i = 0; i < n; ++i) {
            a.push_back(windowFirst + static_cast<int>(random() % 100));
            b.push_back(windowFirst + 100 + static_cast<int>(random() % 100));
            rest.push_back(Real(0.5) * static_cast<Real>(i % 3));
            tau.push_back(Real(0.125) * static_cast<Real>(i % 2));
            const auto s = static_cast<std::size_t>(i);
            const glm::dvec3 f = force(x, v, a[s], b[s], static_cast<double>(k[s]), static_cast<double>(rest[s]),
                                       static_cast<double>(tau[s]));
            expected[static_cast<std::size_t>(a[s] - windowFirst)] += f;
            expected[static_cast<std::size_t>(b[s] - windowFirst)] -= f;
            largest += glm::length(f);
        }
        // Partial sums are below `largest` and each addition rounds once, each spring some ten times.
        const double tolerance = 16.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * (1.0 + largest);
        std::vector<Real> first;
        for (const core::InstructionSet set : supportedSets()) {
            core::useInstructionSet(set);
            std::vector<Real> f(before.begin(), before.begin() + 3 * windowStride);
            springKernels<Real>().list({n, stride, windowStride, windowFirst, x.data(), v.data(), f.data(), a.data(),
                                        b.data(), k.data(), rest.data(), tau.data()});
            if (first.empty()) first = f;
            ASSERT_EQ(f, first) << core::nameOf(set);
        }
        for (int p = 0; p < 3; ++p)
            for (int i = 0; i < windowStride; ++i) {
                const auto at = static_cast<std::size_t>(p * windowStride + i);
                ASSERT_NEAR(static_cast<double>(first[at]) - static_cast<double>(before[at]),
                            expected[static_cast<std::size_t>(i)][p], tolerance);
            }
    }
}

TYPED_TEST(SpringKernelsOf, AccelerateFreePointsOnly) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const auto before = randomPlanes<Real>(1), external = randomPlanes<Real>(2);
    for (const int n : {1, 5, 16, 33, 300})
        for (const bool isPushed : {false, true})
            for (const core::InstructionSet set : supportedSets()) {
                core::useInstructionSet(set);
                std::vector<Real> f = before, w;
                for (int i = 0; i < n; ++i) w.push_back(i % 4 == 1 ? Real(0) : Real(1) / static_cast<Real>(1 + i));
                const Real g[3] = {Real(0.5), Real(-9.81), Real(0)};
                springKernels<Real>().accelerate(
                    {n, w.data(), {g[0], g[1], g[2]}, isPushed ? external.data() : nullptr, stride, f.data(), stride});
                for (int p = 0; p < 3; ++p)
                    for (int i = 0; i < stride; ++i) {
                        const auto at = static_cast<std::size_t>(p * stride + i), j = static_cast<std::size_t>(i);
                        Real expected = before[at];
                        if (i < n) {
                            const Real push = isPushed ? external[at] : Real(0);
                            const Real sum = before[at] + push, a = sum * w[j];
                            expected = w[j] > Real(0) ? a + g[p] : Real(0);
                        }
                        ASSERT_EQ(f[at], expected) << core::nameOf(set) << ", n " << n << ", point " << i;
                    }
            }
}

}  // namespace
}  // namespace taut::mechanics::test
