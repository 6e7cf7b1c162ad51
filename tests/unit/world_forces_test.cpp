// A force that this file adds to a world behaves as the engine's own.
#include "taut/bodies/net.h"
#include "taut/forces/force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/timelines.h"
#include "taut/world/world.h"

namespace taut::world::forces_test {
namespace {

using support::run;

// F = -k (x - c) on every point of every body.
template <class Real>
class Attraction final : public mechanics::ForceGenerator<Real> {
  public:
    Attraction(double stiffness, const dvec3& centre) : stiffness_(stiffness), centre_(centre) {}
    void addForces(const mechanics::Motion<Real>& motion, int first, int last, Real* f) const override {
        for (int p = 0; p < 3; ++p)
            for (int i = first; i < last; ++i) {
                const int at = p * motion.stride + i;
                f[at] -= static_cast<Real>(stiffness_ * (static_cast<double>(motion.x[at]) - centre_[p]));
            }
    }
    double potentialEnergy(const mechanics::Motion<Real>& motion, const std::vector<bool>& only) const override {
        double energy = 0;
        for (int i = 0; i < motion.count; ++i)
            for (int p = 0; p < 3; ++p) {
                if (!only.empty() && !only[i]) continue;
                const double way = static_cast<double>(motion.x[p * motion.stride + i]) - centre_[p];
                energy += 0.5 * stiffness_ * way * way;
            }
        return energy;
    }
    void addStiffnessProduct(const mechanics::Motion<Real>& motion, const Real* u, Real* out) const override {
        for (int p = 0; p < 3; ++p)
            for (int i = 0; i < motion.count; ++i)
                out[p * motion.stride + i] += static_cast<Real>(stiffness_) * u[p * motion.stride + i];
    }
    void addStability(const mechanics::Motion<Real>& motion, mechanics::StabilityShare& share) const override {
        for (int i = 0; i < motion.count; ++i) share.stiffness[i] += stiffness_;
    }

  private:
    double stiffness_;  // [N/m]
    dvec3 centre_;      // [m]
};

class AttractionForce final : public ForceOf<AttractionForce> {
  public:
    AttractionForce(double stiffness, const dvec3& centre)
        : ForceOf("attraction.well"), stiffness_(stiffness), centre_(centre) {}
    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan&) const {
        return std::make_unique<Attraction<Real>>(stiffness_, centre_);
    }
    void visit(StateBytes& bytes) override { bytes(centre_); }

  private:
    double stiffness_;
    dvec3 centre_;
};

std::shared_ptr<const Force> attraction(double stiffness, const dvec3& centre = dvec3(0.0)) {
    return std::make_shared<AttractionForce>(stiffness, centre);
}

// 2 kg at (0.5, 0, 0), bound to nothing but a wall far away by a spring without force to speak of.
SceneSpec freeMass(Precision precision) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = precision;
    NetSpec net;
    net.name = "ball";
    net.drag = 0;
    net.points = {{"m", {0.5, 0, 0}, 2.0, false, {}}, {"wall", {0, 0, 5}, 1.0, true, {}}};
    net.springs = {{"m", "wall", 1e-9, {}, {}, {}}};
    scene.bodies.add(net);
    return scene;
}

Options with(std::shared_ptr<const Force> force) {
    Options options;
    options.forces = {std::move(force)};
    return options;
}

// 72 N/m on 2 kg: ω = 6/s. Leap-frog's phase is off by ω³h²t/24 = 3e-3 at h = 1/60 s and t = 1 s, so by 1.5 mm.
TEST(OwnForce, MovesAMassInBothPrecisionsAndItsEnergyIsCounted) {
    for (Precision precision : {Precision::single_, Precision::double_}) {
        World world(freeMass(precision), with(attraction(72.0)));
        run(world, 60);
        const PointsNow ball = world.points("net.ball@m");
        EXPECT_NEAR(ball.x[0].x, 0.5 * std::cos(6.0), 2e-3);
        const Metrics metrics = world.metrics("net.ball");
        const double wall = 0.5 * 72.0 * 25.0;  // held, and drawn all the same
        EXPECT_NEAR(metrics.elastic, 0.5 * 72.0 * ball.x[0].x * ball.x[0].x + wall, 1e-3);
        EXPECT_NEAR(metrics.elastic + metrics.kinetic, 0.5 * 72.0 * 0.25 + wall, 0.01 * 9.0);  // z²/4 < 0.3 %
    }
}

TEST(OwnForce, IsPartOfTheStepsBoundOrAWarning) {
    // 1e6 N/m on 2 kg is ω = 707 /s; undamped, ω h is kept to 1.5, of which a tick of 16.7 ms takes eight.
    World allowed(freeMass(Precision::double_), with(attraction(1e6)));
    EXPECT_EQ(allowed.islands()[0].substeps, 8);
    World following(freeMass(Precision::double_));
    following.addForce(attraction(1e6));
    (void)following.advance();
    EXPECT_EQ(following.islands()[0].substeps, 8);
    World late(freeMass(Precision::double_), {.keepsSteps = true});
    EXPECT_TRUE(late.warnings().empty());
    late.addForce(attraction(1e6));
    (void)late.advance();
    ASSERT_EQ(late.warnings().size(), 1U);
    EXPECT_NE(late.warnings()[0].text.find("over the stability limit"), std::string::npos) << late.warnings()[0].text;
}

TEST(OwnForce, IsSavedAndAWorldWithoutItRefusesTheBytesByName) {
    World world(freeMass(Precision::double_), with(attraction(72.0, {0.1, 0.2, 0.3})));
    run(world, 10);
    const std::vector<std::byte> bytes = world.save();
    // The bytes say where the centre is, not the one who restores.
    World again(freeMass(Precision::double_), with(attraction(72.0)));
    again.restore(bytes);
    run(world, 10);
    run(again, 10);
    EXPECT_EQ(again.stateHash(), world.stateHash());

    World without(freeMass(Precision::double_));
    try {
        without.restore(bytes);
        FAIL() << "restored without the force";
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what()).find("attraction.well"), std::string::npos) << error.what();
    }
}

TEST(OwnForce, OfANameThatActsAlreadyIsRefused) {
    World world(freeMass(Precision::double_), with(attraction(72.0)));
    EXPECT_THROW(world.addForce(attraction(1.0)), core::Error);
}

}  // namespace
}  // namespace taut::world::forces_test
