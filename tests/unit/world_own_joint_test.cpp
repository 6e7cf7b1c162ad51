// Joints from outside the engine: springs of twice the stiffness, and a leash, whose points come no further apart than
// they were.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/joints/joints.h"
#include "taut/plan/constraint.h"
#include "taut/plan/island_plan.h"
#include "taut/spec/kinds.h"
#include "unit/scene_support.h"

namespace taut::world::own_joint {
namespace {

using support::run;

struct TwiceJoint final : SpecOf<TwiceJoint, JointSpec> {
    static constexpr std::string_view kindName = "twice";
    SpringJoint spring;

    std::string_view title() const override { return "a double spring"; }
    SpringJoint twice() const {
        SpringJoint other = spring;
        other.stiffness *= 2;
        return other;
    }
    void tie(IslandPlan& plan, const Spot& first, const Spot& second, double distance) const override {
        twice().tie(plan, first, second, distance);
    }
    void carry(IslandPlan& plan, const Spot& end, Grip grip) const override {
        twice().carry(plan, end, std::move(grip));
    }
};

class Leash final : public ConstraintOf<Leash> {
  public:
    Leash(int a, int b, double most) : points_{a, b}, most_(most) {}

    std::span<const int> points() const override { return points_; }
    bool projectPositions(const Moment& now) override {
        const dvec3 d = now.x[1] - now.x[0];
        const double length = std::sqrt(glm::dot(d, d)), excess = length - most_, w = weight(now);
        if (!holds() || !(w > 0) || excess <= 1e-13) return false;
        now.x[0] += now.inverseMass[0] / w * excess / length * d;
        now.x[1] -= now.inverseMass[1] / w * excess / length * d;
        return true;
    }
    bool projectVelocities(const Moment& now) override {
        const dvec3 d = now.x[1] - now.x[0], u = now.v[1] - now.v[0];
        const double away = glm::dot(u, d) / glm::dot(d, d), w = weight(now);
        if (!holds() || !(w > 0) || away <= 1e-14 || glm::dot(d, d) < most_ * most_ * (1 - 1e-9)) return false;
        now.v[0] += now.inverseMass[0] / w * away * d;
        now.v[1] -= now.inverseMass[1] / w * away * d;
        return true;
    }

  private:
    static double weight(const Moment& now) { return now.inverseMass[0] + now.inverseMass[1]; }
    std::array<int, 2> points_;
    double most_;  // [m]
};

struct LeashJoint final : SpecOf<LeashJoint, JointSpec> {
    static constexpr std::string_view kindName = "leash";
    double longer = 1;  // than it is at the start

    std::string_view title() const override { return "a leash"; }
    bool tiesWithin() const override { return true; }
    void tie(IslandPlan& plan, const Spot& first, const Spot& second, double distance) const override {
        plan.constraints.push_back(std::make_shared<Leash>(first.nearest(), second.nearest(), longer * distance));
    }
    void carry(IslandPlan&, const Spot&, Grip) const override {
        throw core::Error(core::ErrorKind::badContent, world::at(source) + "a leash is for points of bodies");
    }
};

std::shared_ptr<const Kinds> withOwn() {
    Kinds kinds = builtIn();
    kinds.joints.add(jointKind<TwiceJoint>(
        "Springs of twice the stiffness.",
        fields::FieldList<TwiceJoint>().number("stiffness_N_per_m", &TwiceJoint::spring, &SpringJoint::stiffness, "N/m",
                                               fields::positive, "Half of what it has.")));
    kinds.joints.add(jointKind<LeashJoint>(
        "A leash keeps points from going apart.",
        fields::FieldList<LeashJoint>().number("longer", &LeashJoint::longer, "", fields::Range{1.0, 100.0},
                                               "Its length over the distance at the start.")));
    return std::make_shared<const Kinds>(std::move(kinds));
}

const std::string pair = R"(schema = 1
[world]
gravity = [0, 0, 0]
[solver]
precision = "double"
dt = 0.001
[net.n]
points = [{ name = "a", position = [0, 0, 0], mass_kg = 3 }, { name = "b", position = [1, 0, 0] }]
drag_per_s = 0
[net.o]
points = [{ name = "c", position = [0, 1, 0] }]
drag_per_s = 0
[[joint]]
)";

scene::Loaded load(const std::string& joint, const std::string& at = "") {
    std::string text = pair + joint;
    text.insert(text.find("[world]"), at);
    return scene::loadSceneText(text, "s.toml", {.kinds = withOwn()});
}

TEST(OwnJoint, SpringsOfItsOwnAreReadAndTied) {
    const World own(load("a = \"net.n@a\"\nb = \"net.o@c\"\nkind = \"twice\"\nstiffness_N_per_m = 50\n").spec);
    const World spring(load("a = \"net.n@a\"\nb = \"net.o@c\"\nkind = \"spring\"\nstiffness_N_per_m = 100\n").spec);
    EXPECT_EQ(own.joints()[0].kind, "twice");
    EXPECT_EQ(own.islands()[0].name, spring.islands()[0].name);
    EXPECT_EQ(own.islands()[0].omegaBound, spring.islands()[0].omegaBound);
}

const std::string leash = "a = \"net.n@a\"\nb = \"net.n@b\"\nkind = \"leash\"\nlonger = 1.5\n";
const std::string apart =
    "at = [{ t = 0.1, do = \"push\", target = \"net.n@b\", impulse_Ns = [4, 0, 0] },\n"
    "      { t = 0.6, do = \"cut\", target = \"net.n\", plane = [[0.9, 0, 0], [1, 0, 0]] },\n"
    "      { t = 0.7, do = \"push\", target = \"net.n@b\", impulse_Ns = [1, 0, 0] }]\n";

// 4 kg m/s: b runs off alone, is caught 0.5 m further and draws a along, both at 1 m/s; cut off, it goes alone.
TEST(OwnJoint, AConstraintOfItsOwnHoldsIsSavedAndCut) {
    const SceneSpec scene = load(leash, apart).spec;
    World world(scene);
    const auto distance = [&] { return world.points("net.n@b").x[0].x - world.points("net.n@a").x[0].x; };
    run(world, 12);
    EXPECT_EQ(world.points("net.n@a").v[0].x, 0.0);
    run(world, 22);
    EXPECT_NEAR(distance(), 1.5, 1e-10);
    EXPECT_NEAR(world.points("net.n@a").v[0].x, 1.0, 1e-10);
    EXPECT_NEAR(world.metrics("net.n").momentum.x, 4.0, 1e-12);
    World other(scene);
    other.restore(world.save());
    run(world, 26);
    run(other, 26);
    EXPECT_EQ(world.save(), other.save());
    EXPECT_GT(distance(), 1.5 + 0.2);
    EXPECT_NEAR(world.points("net.n@a").v[0].x, 1.0, 1e-10);
    World late(scene);
    late.restore(world.save());
    run(world, 5);
    run(late, 5);
    EXPECT_EQ(world.save(), late.save());
}

// A mass of 1 kg on a leash that is taut: its kind says nothing of names and forces.
TEST(OwnJoint, IsReleasedByNameAndBreaksByTheForceThroughIt) {
    const std::string hanging =
        "schema = 1\nat = [{ t = 0.1, do = \"release\", id = \"dog\" }]\n[solver]\nprecision = \"double\"\ndt = 0.001\n"
        "[net.n]\npoints = [{ name = \"a\", position = [0, 0, 0], hold = true }, { name = \"b\", position = [0, -1, 0] "
        "}]\n"
        "drag_per_s = 0\n[[joint]]\nname = \"dog\"\n";
    for (const double share : {0.999, 1.001}) {
        World world(scene::loadSceneText(hanging + "a = \"net.n@a\"\nb = \"net.n@b\"\nkind = \"leash\"\nbreak_N = " +
                                             std::to_string(share * support::g) + "\n",
                                         "s.toml", {.kinds = withOwn()})
                        .spec);
        run(world, 3);
        EXPECT_EQ(world.joints()[0].left, share < 1 ? 0 : 1);
        run(world, 4);
        EXPECT_EQ(world.joints()[0].left, 0);  // after 1/10 s, the sixth tick
    }
}

TEST(OwnJoint, IsInTheManualAndRefusedByNameWhereItIsNotKnown) {
    EXPECT_NE(scene::manual(*withOwn()).find("A leash keeps points from going apart."), std::string::npos);
    const scene::AssetFolder folder;
    EXPECT_NE(folder.messageOf(pair + leash).find("kind must be one of weld, spring, rod, hinge, ball, slider, not \"leash\""),
              std::string::npos)
        << folder.messageOf(pair + leash);
    const std::string reach = folder.messageOf(pair + leash + "reach_m = 1\n", {.kinds = withOwn()});
    EXPECT_NE(reach.find("reach_m does not go with a leash"), std::string::npos) << reach;
    const std::string longer =
        folder.messageOf(pair + "a = \"net.n@a\"\nb = \"net.o@c\"\nkind = \"rod\"\nlonger = 2\n", {.kinds = withOwn()});
    EXPECT_NE(longer.find("longer does not go with a rod\n"), std::string::npos) << longer;
    EXPECT_NE(longer.find("it belongs to a leash"), std::string::npos) << longer;
}

}  // namespace
}  // namespace taut::world::own_joint
