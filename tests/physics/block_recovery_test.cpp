// Blocks pressed flat or turned inside out: they come back. Pressed to a line they do not, which is
// reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/network.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"
#include "taut/mechanics/private/volume.h"
#include "taut/ode/method_table.h"

namespace taut::test::block_recovery {
namespace {

using mechanics::Model;
using mechanics::VolumePreservation;
using mechanics::VolumeReport;

// A cube with so many cells along each side.
Model block(int cells) {
    return mechanics::buildBlock({.size = {0.3, 0.3, 0.3},
                                  .cells = {cells, cells, cells},
                                  .density = 300.0,
                                  .young = 2e4,
                                  .bulk = 2e4,
                                  .dampingTime = 1e-3,
                                  .dragRate = 1.0});
}

// A block whose points are moved and released. All springs and volumes keep the lengths of the rest shape.
class Released {
  public:
    template <class Deform>
    Released(int cells, std::string_view method, double stir, Deform deform) : rest_(block(cells)) {
        Model model = rest_;
        const std::vector<dvec3> rest = model.positions;
        for (std::size_t i = 0; i < rest.size(); ++i) {
            // A stir: a perfect shape may balance on its edge.
            const double s = static_cast<double>(i);
            model.positions[i] =
                deform(rest[i]) + stir * dvec3(core::sine(3.1 * s), core::sine(5.3 * s), core::sine(7.7 * s));
        }
        auto volume = std::make_unique<VolumePreservation<double>>(model.cells, rest, 2.0);
        volume_ = volume.get();
        const double h = step(model, rest, method);
        // For implicit Euler: solves to rounding would take most of the time.
        network_ = std::make_unique<Network>(model, method, h, dvec3(0.0), ode::MethodOptions{1, 1e-6, 1000});
        network_->add(std::move(volume), method, h);
        stepsASecond_ = static_cast<std::int64_t>(std::ceil(1.0 / h));
    }

    void run(double seconds) {
        network_->step(static_cast<std::int64_t>(seconds * static_cast<double>(stepsASecond_)));
    }
    VolumeReport report() const { return volume_->inspect(network_->motion()); }
    Network& network() { return *network_; }
    const Model& rest() const { return rest_; }

  private:
    // Nine tenths of the limit by the bounds of the working range and of the deformed start; implicit Euler, which has
    // none, at 1 ms. Explicit Euler at two tenths: near its limit, which dashpots and drag alone give it, it feeds
    // turning and folding.
    static double step(const Model& model, std::span<const dvec3> rest, std::string_view method) {
        std::vector<double> inverseMasses;
        for (double m : model.masses) inverseMasses.push_back(1.0 / m);
        ode::FastestMode mode;
        const mechanics::NetworkView network{model.springs, inverseMasses, model.cells};
        mode.omega = std::max(mechanics::boundWithin(network, {}, rest, 2.0).omega,
                              mechanics::boundHere(network, {}, model.positions).omega);
        mode.tau = 1e-3;
        mode.drag = mode.largestDrag = 1.0;
        const double part = method == "euler" ? 0.2 : 0.9;
        return std::min(part * ode::findMethod(method)->largestStep(mode), 1e-3);
    }

    Model rest_;
    const VolumePreservation<double>* volume_ = nullptr;
    std::unique_ptr<Network> network_;
    std::int64_t stepsASecond_ = 0;
};

void expectRecovery(Released& released, double seconds) {
    released.run(seconds);  // the drag of 1/s has had its time
    ASSERT_TRUE(released.network().isBounded(10.0));
    const VolumeReport end = released.report();
    EXPECT_GT(end.smallestRatio, 0.9) << "cell " << end.smallestCell;
    EXPECT_EQ(end.inverted, 0);
    EXPECT_EQ(end.collapsed, 0);
    // Every spring is back at its length: within 1 % of it.
    for (const mechanics::Spring& s : released.rest().springs)
        EXPECT_NEAR(glm::length(released.network().position(s.b) - released.network().position(s.a)) / s.restLength,
                    1.0, 0.01);
}

std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const ode::MethodInfo& method : ode::methods()) names.emplace_back(method.name);
    return names;
}

class BlockUnder : public testing::TestWithParam<std::string> {};

TEST_P(BlockUnder, ThatMethodComesBackFromATwentiethOfItsHeight) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE("axis " + std::to_string(axis));
        Released released(2, GetParam(), 1e-4, [axis](dvec3 x) {
            x[axis] *= 0.05;
            return x;
        });
        EXPECT_LT(released.report().smallestRatio, 0.1);
        EXPECT_EQ(released.report().collapsed, 8);
        expectRecovery(released, 6.0);
    }
}

// With two cells a side every point lies on the surface but one, and there is little room to fold: of 48 starts (two
// methods, each axis, eight stirs from 1e-5 to 1e-2 m) 44 came back; those of 1 and 2 mm along one axis stayed folded.
TEST_P(BlockUnder, ThatMethodTurnsBackFromItsMirrorImage) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE("axis " + std::to_string(axis));
        Released released(2, GetParam(), 1e-2, [axis](dvec3 x) {
            x[axis] *= -1.0;
            return x;
        });
        EXPECT_EQ(released.report().inverted, 8);
        expectRecovery(released, 6.0);
    }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, BlockUnder, testing::ValuesIn(methodNames()),
                         [](const testing::TestParamInfo<std::string>& method) {
                             std::string name = method.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Block, OfMoreCellsComesBackFromATwentiethOfItsHeight) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE("axis " + std::to_string(axis));
        Released released(3, "leapfrog", 1e-4, [axis](dvec3 x) {
            x[axis] *= 0.05;
            return x;
        });
        EXPECT_EQ(released.report().collapsed, 27);
        expectRecovery(released, 8.0);
    }
}

// From a mirror image the block turns through itself. On its way one of three cells a side may fold into a shape in
// which springs and volumes balance, and stay: of 81 starts stirred by a hundredth of a cell, with 2 to 4 cells a side,
// three stiffnesses of the volume and three drags, 3 did, and more where the stir was smaller. The same bits everywhere
// make these starts lucky ones for good. More drag folds more: with 3/s a third of them (33 of 87 under all methods).
TEST(Block, OfMoreCellsMayTurnBackFromItsMirrorImage) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE("axis " + std::to_string(axis));
        Released released(3, "leapfrog", 1e-3, [axis](dvec3 x) {
            x[axis] *= -1.0;
            return x;
        });
        EXPECT_NEAR(released.report().smallestRatio, -1.0, 0.1);  // the stir changes edges of 0.1 m by up to 2 mm
        EXPECT_EQ(released.report().inverted, 27);
        expectRecovery(released, 8.0);
    }
}

TEST(Block, CollapsedToALineIsReported) {
    Released released(3, "leapfrog", 1e-4, [](dvec3 x) { return dvec3(x.x, 0.0, 0.0); });
    const VolumeReport report = released.report();
    EXPECT_EQ(report.collapsed, 27);
    EXPECT_LT(report.smallestRatio, 0.1);
    EXPECT_GE(report.smallestCell, 0);
}

}  // namespace
}  // namespace taut::test::block_recovery
