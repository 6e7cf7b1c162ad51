#include "taut/mechanics/spring_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
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

// A bundle of runs that begin at point 0, n springs each, with stiffnesses from `k` on: the input of springKernels.
template <class Real>
std::vector<SpringRun<Real>> bundleOf(int n, const std::vector<int>& offsets, double rest, double tau) {
    std::vector<SpringRun<Real>> runs;
    for (const int offset : offsets)
        runs.push_back(
            {0, offset, n, 0, static_cast<int>(runs.size()), static_cast<Real>(rest), static_cast<Real>(tau), -1});
    runs[0].together = static_cast<int>(runs.size());
    return runs;
}

// Lengths about the vectors and the slices of the kernel, offsets from overlapping to far apart, alone and together,
// with and without dashpots: against the definition, and every instruction set against the first.
TYPED_TEST(SpringKernelsOf, BundlesAddEachSpringToBothEndsWithTheSameBits) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const auto x = randomPlanes<Real>(1), v = randomPlanes<Real>(2), before = randomPlanes<Real>(3),
               k = randomPlanes<Real>(4);
    // Sums of at most eighteen terms below 8 in size, each with some ten roundings.
    const double tolerance = 600.0 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    for (const int n : {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 33, 100, 127, 128, 129, 255, 256, 257, 300})
        for (const std::vector<int>& offsets :
             {std::vector{1}, {2}, {17}, {128}, {400}, {1, 2}, {1, 2, 31, 32, 33, 64}, {3, 4, 5, 6, 7, 8, 200, 500}})
            for (const double tau : {0.0, 0.125}) {
                std::vector<glm::dvec3> expected(stride, glm::dvec3(0.0));
                for (std::size_t r = 0; r < offsets.size(); ++r)
                    for (int i = 0; i < n; ++i) {
                        const double stiffness = static_cast<double>(k[r + static_cast<std::size_t>(i)]);
                        const glm::dvec3 f = force(x, v, i, i + offsets[r], stiffness, 0.25, tau);
                        expected[i] += f;
                        expected[i + offsets[r]] -= f;
                    }
                const auto runs = bundleOf<Real>(n, offsets, 0.25, tau);
                std::vector<Real> first;
                for (const core::InstructionSet set : supportedSets()) {
                    core::useInstructionSet(set);
                    std::vector<Real> f = before;
                    springKernels<Real>().bundle(
                        {runs.data(), k.data(), nullptr, stride, stride, x.data(), v.data(), f.data()});
                    if (first.empty()) {
                        first = f;
                        for (int p = 0; p < 3; ++p)
                            for (int i = 0; i < stride; ++i) {
                                const auto at = static_cast<std::size_t>(p * stride + i);
                                const double change = static_cast<double>(f[at]) - static_cast<double>(before[at]);
                                ASSERT_NEAR(change, expected[i][p], tolerance)
                                    << "n " << n << ", " << offsets.size() << " runs, point " << i;
                                if (i >= n + offsets.back()) ASSERT_EQ(f[at], before[at]);
                            }
                    }
                    ASSERT_EQ(f, first) << core::nameOf(set) << ", n " << n << ", " << offsets.size() << " runs";
                }
            }
}

// Far apart, so that every point has one spring and no sum an order.
TYPED_TEST(SpringKernelsOf, RunsOfDifferentSpringsEqualARunForEach) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const auto x = randomPlanes<Real>(1), v = randomPlanes<Real>(2), k = randomPlanes<Real>(3),
               rest = randomPlanes<Real>(4), tau = randomPlanes<Real>(5);
    const int n = 300;
    const std::vector<int> offsets{400};
    std::vector<Real> mixed(rest.begin(), rest.begin() + n);
    mixed.insert(mixed.end(), tau.begin(), tau.begin() + n);
    auto runs = bundleOf<Real>(n, offsets, 0.0, 0.0);
    runs[0].mixed = 0;
    for (const core::InstructionSet set : supportedSets()) {
        core::useInstructionSet(set);
        std::vector<Real> together(3 * stride), oneByOne(3 * stride);
        springKernels<Real>().bundle(
            {runs.data(), k.data(), mixed.data(), stride, stride, x.data(), v.data(), together.data()});
        for (std::size_t i = 0; i < n; ++i) {
            const auto one = bundleOf<Real>(1, offsets, static_cast<double>(rest[i]), static_cast<double>(tau[i]));
            springKernels<Real>().bundle(
                {one.data(), k.data() + i, nullptr, stride, stride, x.data() + i, v.data() + i, oneByOne.data() + i});
        }
        EXPECT_EQ(together, oneByOne) << core::nameOf(set);
    }
}

// Ends that meet, or come so near that l² vanishes in the numbers of the machine: no force where the direction is
// undefined, k d at a rest length of zero, and never more than k L.
TYPED_TEST(SpringKernelsOf, StayFiniteAsLengthsVanish) {
    using Real = TypeParam;
    const InstructionSetGuard guard;
    const Real tiny = std::numeric_limits<Real>::denorm_min();
    const Real d[] = {0, tiny, 1000 * tiny, std::numeric_limits<Real>::min(),
                      std::sqrt(std::numeric_limits<Real>::min())};
    for (const core::InstructionSet set : supportedSets())
        for (const double rest : {0.0, 0.5})
            for (const Real& length : d) {
                core::useInstructionSet(set);
                const auto runs = bundleOf<Real>(1, {1}, rest, 0.125);
                const std::vector<Real> x{0, length, 0, 0, 0, 0}, v{0, 1, 0, 1, 0, 0};
                const Real k = 3;
                std::vector<Real> f(6);
                springKernels<Real>().bundle({runs.data(), &k, nullptr, 2, 2, x.data(), v.data(), f.data()});
                const Real most = k * static_cast<Real>(rest + 0.125) * Real(1.0001) + k * length;
                for (const Real force : f) ASSERT_LE(std::abs(force), most) << core::nameOf(set) << " " << length;
                if (length == Real(0))
                    for (const Real force : f) ASSERT_EQ(force, Real(0));
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
        std::vector<glm::dvec3> expected(windowStride, glm::dvec3(0.0));
        double largest = 0.0;
        for (int i = 0; i < n; ++i) {
            a.push_back(windowFirst + static_cast<int>(random() % 100));
            b.push_back(windowFirst + 100 + static_cast<int>(random() % 100));
            rest.push_back(Real(0.5) * static_cast<Real>(i % 3));
            tau.push_back(Real(0.125) * static_cast<Real>(i % 2));
            const auto s = static_cast<std::size_t>(i);
            const glm::dvec3 f = force(x, v, a[s], b[s], static_cast<double>(k[s]), static_cast<double>(rest[s]),
                                       static_cast<double>(tau[s]));
            expected[a[s] - windowFirst] += f;
            expected[b[s] - windowFirst] -= f;
            largest += glm::length(f);
        }
        // Partial sums are below `largest` and each addition rounds once, each spring some ten times.
        const double tolerance = 16.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * (1.0 + largest);
        std::vector<Real> first, firstOwn;
        for (const core::InstructionSet set : supportedSets()) {
            core::useInstructionSet(set);
            std::vector<Real> f(before.begin(), before.begin() + 3 * windowStride);
            springKernels<Real>().list({n, stride, windowStride, windowFirst, x.data(), v.data(), f.data(), a.data(),
                                        b.data(), k.data(), rest.data(), tau.data()});
            if (first.empty()) first = f;
            ASSERT_EQ(f, first) << core::nameOf(set);

            // The same springs point by point: forces of their own, added at the end.
            constexpr int points = windowStride - 8;
            std::vector<Real> state(points * packedState), packed(points * packedForce, Real(1)), own(3 * windowStride);
            springKernels<Real>().pack(
                {points, stride, x.data() + windowFirst, v.data() + windowFirst, state.data(), packed.data()});
            springKernels<Real>().packedList(
                {n, windowFirst, state.data(), packed.data(), a.data(), b.data(), k.data(), rest.data(), tau.data()});
            springKernels<Real>().unpack({points, packed.data(), own.data(), windowStride});
            if (firstOwn.empty()) firstOwn = own;
            ASSERT_EQ(own, firstOwn) << core::nameOf(set);
        }
        for (int p = 0; p < 3; ++p)
            for (int i = 0; i < windowStride; ++i) {
                const auto at = static_cast<std::size_t>(p * windowStride + i);
                ASSERT_NEAR(static_cast<double>(first[at]) - static_cast<double>(before[at]), expected[i][p],
                            tolerance);
                ASSERT_NEAR(static_cast<double>(firstOwn[at]), expected[i][p], tolerance);
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
