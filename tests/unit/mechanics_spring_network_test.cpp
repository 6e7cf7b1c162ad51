#include "taut/mechanics/spring_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "mechanics_random_net.h"
#include "taut/mechanics/builders.h"

namespace taut::mechanics::test {
namespace {

using Network = SpringNetwork<double>;
using Line = std::tuple<int, int, double, double, double>;  // a < b, k, L, τ

std::vector<Line> linesOf(const std::vector<Spring>& springs) {
    std::vector<Line> lines;
    for (const Spring& s : springs)
        lines.emplace_back(std::min(s.a, s.b), std::max(s.a, s.b), s.stiffness, s.restLength, s.dampingTime);
    std::sort(lines.begin(), lines.end());
    return lines;
}

// The springs of the blocks first … last - 1; a stiffness of zero within a run is a bridge, not a spring.
std::vector<Line> linesOf(const Network& network, std::size_t first, std::size_t last) {
    std::vector<Line> lines;
    for (std::size_t i = first; i < last; ++i) {
        const SpringBlock& block = network.blocks[i];
        for (int r = block.firstRun; r < block.lastRun; ++r) {
            const SpringRun<double>& run = network.runs[r];
            for (int j = 0; j < run.count; ++j) {
                const double k = network.stiffness[run.table + j];
                if (k == 0.0) continue;
                const auto own = [&](int at) { return network.mixed[run.mixed + at]; };
                lines.emplace_back(run.a + j, run.a + j + run.offset, k, run.mixed < 0 ? run.restLength : own(j),
                                   run.mixed < 0 ? run.tau : own(run.count + j));
            }
        }
        for (int s = block.firstSingle; s < block.lastSingle; ++s) {
            const auto j = static_cast<std::size_t>(s);
            lines.emplace_back(network.singles.a[j], network.singles.b[j], network.singles.k[j],
                               network.singles.restLength[j], network.singles.tau[j]);
        }
    }
    std::sort(lines.begin(), lines.end());
    return lines;
}

struct Case {
    int points;
    std::vector<Network::Body> bodies;
    std::vector<Spring> springs;
};

Case randomCase() {
    return {40000, {{0, 0}, {7, 0}, {5000, 33}, {20000, 0}}, randomNet(40000, 100000, 3000, 1).springs};
}

Case clothCase(int side) {
    ClothShape shape;
    shape.cells = {side - 1, side - 1};
    return {side * side, {{0, side}}, buildCloth(shape).springs};
}

// Springs that span everything: a chunk may not end before the reach of the one before.
Case longCase() {
    return {60000, {{0, 0}}, randomNet(60000, 20000, 25000, 2).springs};
}

Network networkOf(const Case& c) {
    return Network(c.points, c.bodies, c.springs);
}

class SpringNetworks : public testing::TestWithParam<Case (*)()> {
  protected:
    Case case_ = GetParam()();
    Network network_ = networkOf(case_);
};

TEST_P(SpringNetworks, HoldEverySpringOnce) {
    EXPECT_EQ(network_.springCount, static_cast<int>(case_.springs.size()));
    EXPECT_EQ(linesOf(network_, 0, network_.blocks.size()), linesOf(case_.springs));
}

TEST_P(SpringNetworks, PutASpringIntoTheBlockOfItsLowerPoint) {
    for (std::size_t i = 0; i < network_.blocks.size(); ++i)
        for (const Line& line : linesOf(network_, i, i + 1)) {
            ASSERT_GE(std::get<0>(line), network_.blocks[i].firstPoint);
            ASSERT_LT(std::get<0>(line), network_.blocks[i].lastPoint);
        }
}

TEST_P(SpringNetworks, CutThePointsIntoBlocksAndTheBlocksIntoChunks) {
    int point = 0, block = 0;
    for (const SpringBlock& b : network_.blocks) {
        EXPECT_EQ(b.firstPoint, point);
        EXPECT_GT(b.lastPoint, b.firstPoint);
        point = b.lastPoint;
    }
    EXPECT_EQ(point, case_.points);
    for (const SpringChunk& c : network_.chunks) {
        EXPECT_EQ(c.firstBlock, block);
        EXPECT_GT(c.lastBlock, c.firstBlock);
        EXPECT_EQ(c.firstPoint, network_.blocks[c.firstBlock].firstPoint);
        EXPECT_EQ(c.lastPoint, network_.blocks[static_cast<std::size_t>(c.lastBlock) - 1].lastPoint);
        block = c.lastBlock;
    }
    EXPECT_EQ(block, static_cast<int>(network_.blocks.size()));
}

TEST_P(SpringNetworks, LetNoBlockSpanTwoBodiesOrBreakARow) {
    for (std::size_t i = 0; i < case_.bodies.size(); ++i) {
        const int first = case_.bodies[i].firstPoint, row = case_.bodies[i].row;
        const int last = i + 1 < case_.bodies.size() ? case_.bodies[i + 1].firstPoint : case_.points;
        for (const SpringBlock& b : network_.blocks) {
            if (b.lastPoint <= first || b.firstPoint >= last) continue;
            EXPECT_GE(b.firstPoint, first);
            EXPECT_LE(b.lastPoint, last);
            if (row > 0) {
                EXPECT_EQ((b.firstPoint - first) % row, 0);
                EXPECT_TRUE(b.lastPoint == last || (b.lastPoint - first) % row == 0);
            }
        }
    }
}

TEST_P(SpringNetworks, KnowHowFarBlocksAndChunksReach) {
    for (std::size_t i = 0; i < network_.blocks.size(); ++i) {
        int reach = network_.blocks[i].lastPoint;
        for (const Line& line : linesOf(network_, i, i + 1)) reach = std::max(reach, std::get<1>(line) + 1);
        EXPECT_EQ(network_.blocks[i].reach, reach);
    }
    for (std::size_t c = 0; c < network_.chunks.size(); ++c) {
        const SpringChunk& chunk = network_.chunks[c];
        int reach = chunk.lastPoint;
        for (int i = chunk.firstBlock; i < chunk.lastBlock; ++i) reach = std::max(reach, network_.blocks[i].reach);
        EXPECT_EQ(chunk.spill, reach - chunk.lastPoint);
        // Into the next chunk, never past it.
        const int next = c + 1 < network_.chunks.size() ? network_.chunks[c + 1].lastPoint : case_.points;
        EXPECT_LE(reach, next);
    }
}

TEST_P(SpringNetworks, BundleRunsThatCoverTheSamePoints) {
    for (const SpringBlock& block : network_.blocks)
        for (int r = block.firstRun; r < block.lastRun;) {
            const SpringRun<double>* bundle = &network_.runs[r];
            ASSERT_GE(bundle->together, 1);
            ASSERT_LE(bundle->together, std::min(mostTogether, block.lastRun - r));
            for (int i = 0; i < bundle->together; ++i) {
                ASSERT_EQ(bundle[i].a, bundle->a);
                ASSERT_EQ(bundle[i].count, bundle->count);
                ASSERT_EQ(bundle[i].together, i == 0 ? bundle->together : 0);
                ASSERT_LE(bundle[i].a + bundle[i].count - 1 + bundle[i].offset, block.reach - 1);
            }
            r += bundle->together;
        }
}

TEST_P(SpringNetworks, DoNotDependOnTheOrderOfTheSprings) {
    std::mt19937 random(3);
    std::shuffle(case_.springs.begin(), case_.springs.end(), random);
    for (Spring& s : case_.springs)
        if (random() % 2 == 0) std::swap(s.a, s.b);
    const Network other = networkOf(case_);
    EXPECT_EQ(other.stiffness, network_.stiffness);
    EXPECT_EQ(other.singles.a, network_.singles.a);
    EXPECT_EQ(other.singles.b, network_.singles.b);
    EXPECT_EQ(other.singles.k, network_.singles.k);
    EXPECT_EQ(other.singles.restLength, network_.singles.restLength);
    EXPECT_EQ(other.singles.tau, network_.singles.tau);
    ASSERT_EQ(other.runs.size(), network_.runs.size());
    for (std::size_t r = 0; r < other.runs.size(); ++r) {
        const SpringRun<double>&a = other.runs[r], &b = network_.runs[r];
        EXPECT_EQ(std::tie(a.a, a.offset, a.count, a.table, a.restLength, a.tau),
                  std::tie(b.a, b.offset, b.count, b.table, b.restLength, b.tau));
    }
}

// Each changed on its own, so that runs are alike no longer; then as they were.
TEST_P(SpringNetworks, TakeChangesWhereTheSpringsAre) {
    std::vector<Spring> changed = case_.springs;
    double factor = 1.0;
    for (Spring& s : changed)
        for (double* number : {&s.stiffness, &s.restLength, &s.dampingTime})
            *number = (*number + 1.0) * (factor += 1e-3);
    Network network = network_;
    network.setSprings(changed);
    EXPECT_EQ(linesOf(network, 0, network.blocks.size()), linesOf(changed));
    EXPECT_EQ(network.order, network_.order);
    network.setSprings(case_.springs);
    EXPECT_EQ(linesOf(network, 0, network.blocks.size()), linesOf(case_.springs));
    EXPECT_EQ(network.stiffness, network_.stiffness);
    EXPECT_TRUE(network.mixed.empty());
}

// The third of them one after the other: as if all had been set.
TEST_P(SpringNetworks, TakeOneSpringAsTheyTakeAll) {
    std::vector<Spring> changed = case_.springs;
    Network network = network_, all = network_;
    for (std::size_t i = 0; i < changed.size(); i += 3) {
        (i % 2 == 0 ? changed[i].stiffness : changed[i].restLength) += 1.0 + 1e-3 * static_cast<double>(i);
        EXPECT_EQ(network.setSpring(static_cast<int>(i), changed[i]), i % 2 == 0);
    }
    all.setSprings(changed);
    EXPECT_EQ(linesOf(network, 0, network.blocks.size()), linesOf(all, 0, all.blocks.size()));
}

INSTANTIATE_TEST_SUITE_P(All, SpringNetworks,
                         testing::Values(
                             randomCase, longCase, +[] { return clothCase(1 + 1); }, +[] { return clothCase(13); },
                             +[] { return clothCase(150); }, +[] { return clothCase(300); }));

TEST(SpringNetwork, OfAClothIsAlmostAllRunsWithFewTables) {
    const Case cloth = clothCase(100);
    const Network network = networkOf(cloth);
    // Six kinds of spring a row; the rest are row ends: far below one in a hundred.
    EXPECT_LT(network.singles.size(), network.springCount / 100);
    // All six in one sweep, but for the last rows, from which less goes on.
    const auto isOfSix = [](const SpringRun<double>& run) { return run.together == 6; };
    EXPECT_GE(std::count_if(network.runs.begin(), network.runs.end(), isOfSix),
              static_cast<std::ptrdiff_t>(network.blocks.size()) - 2);
    // Rows are alike: tables for the first, the inner and the last ones, not one of its own for each spring.
    EXPECT_LT(static_cast<int>(network.stiffness.size()), network.springCount / 10);
}

TEST(SpringNetwork, MayBeEmpty) {
    const Network none(0, {}, {});
    EXPECT_TRUE(none.blocks.empty());
    EXPECT_TRUE(none.chunks.empty());
    const Network::Body body{0, 0};
    const Network loose(3, {&body, 1}, {});
    ASSERT_EQ(loose.blocks.size(), 1u);
    EXPECT_EQ(loose.blocks[0].lastPoint, 3);
    EXPECT_EQ(loose.chunks.size(), 1u);
}

}  // namespace
}  // namespace taut::mechanics::test
