// A kind of body and a kind of force that this file adds: scenes name them, and they behave as
// the engine's own.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene_support.h"
#include "support/timelines.h"
#include "taut/forces/force.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/gravity.h"
#include "taut/spec/kinds.h"
#include "taut/world/world.h"

namespace taut::world::own_kinds_test {
namespace {

using support::run;

// Equal masses around a circle, each tied to the next.
struct Ring final : SpecOf<Ring, BodySpec> {
    static constexpr const char* kindName = "ring";
    double radius = 1.0;  // [m]
    int points = 6;
    double stiffness = 100.0;  // [N/m]

    static fields::Section section() {
        fields::Section section;
        section.help = "A closed chain.";
        section.fields = fields::FieldList<Ring>()
                             .number("radius", &Ring::radius, "m", lengthRange, "Of the circle.")
                             .whole("points", &Ring::points, "", {3, 1000}, "Number of points.")
                             .number("stiffness_N_per_m", &Ring::stiffness, "N/m", fields::positive, "Of a spring.")
                             .ramps(fields::Affects::springs)
                             .take();
        return section;
    }
    mechanics::Model build(const SceneSpec&) const override {
        std::vector<mechanics::NetPoint> masses;
        std::vector<mechanics::NetSpring> ties;
        for (int i = 0; i < points; ++i) {
            const double angle = 2 * std::numbers::pi * i / points;
            const dvec3 place = radius * dvec3(std::cos(angle), 0, std::sin(angle));
            masses.push_back({"p" + std::to_string(i), place, dvec3(0.0), 0.1, 0.0, false});
            ties.push_back({"p" + std::to_string(i), "p" + std::to_string((i + 1) % points), stiffness, {}, 0.0});
        }
        return mechanics::buildNet(masses, ties);
    }
};

// A gravity of its own for everything.
class LiftForce final : public ForceOf<LiftForce> {
  public:
    LiftForce(const std::string& name, const dvec3& rate) : ForceOf(name), rate_(rate) {}
    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan&) const {
        return std::make_unique<mechanics::Gravity<Real>>(mechanics::LinearPath{rate_, rate_});
    }
    void visit(StateBytes& bytes) override { bytes(rate_); }

  private:
    dvec3 rate_;  // [m/s²]
};

struct Lift final : SpecOf<Lift, ForceSpec> {
    static constexpr const char* kindName = "lift";
    double rate = 0.0;  // [m/s²] upwards

    static fields::Section section() {
        fields::Section section;
        section.help = "Pulls everything up.";
        section.fields = fields::FieldList<Lift>()
                             .number("rate", &Lift::rate, "m/s²", {0, 100}, "How fast it makes things faster.")
                             .ramps(fields::Affects::forces)
                             .take();
        return section;
    }
    std::shared_ptr<const Force> make(const SceneSpec&) const override {
        return std::make_shared<LiftForce>(fullName(), dvec3(0, rate, 0));
    }
};

Kinds mine() {
    Kinds kinds = builtIn();
    kinds.bodies.add(bodyKind<Ring>());
    kinds.forces.add(forceKind<Lift>());
    return kinds;
}

constexpr const char* text =
    "schema = 1\n"
    "run = { seconds = 2 }\n"
    "at = [\n"
    "  { t = 0.5, do = \"ramp\", key = \"lift.balloon.rate\", to = 19.62 },\n"
    "  { t = 0.5, do = \"ramp\", key = \"ring.hoop.stiffness_N_per_m\", to = 400 },\n"
    "]\n"
    "[ring.hoop]\n"
    "radius = 0.5\n"
    "velocity = [1, 0, 0]\n"
    "[lift.balloon]\n"
    "rate = 9.81\n";

SceneSpec sceneOf(const scene::AssetFolder& folder) {
    scene::LoadOptions options;
    options.kinds = std::make_shared<const Kinds>(mine());
    return folder.load(text, options).spec;
}

// It floats for half a second, then falls up by g: y = g t²/2.
TEST(OwnKinds, StandInAScene) {
    const scene::AssetFolder folder;
    World world(sceneOf(folder));
    ASSERT_EQ(world.islands().size(), 1U);
    EXPECT_EQ(world.islands()[0].name, "ring.hoop");
    EXPECT_EQ(world.islands()[0].springs, 6);
    // The fastest mode of the ring has ω² = 4 k/m; the step allows for 400 N/m.
    EXPECT_NEAR(world.islands()[0].stepLimit, 2 / std::sqrt(4 * 400.0 / 0.1), 1e-4);
    run(world, 30);
    EXPECT_NEAR(world.points("ring.hoop@p0").x[0].y, 0.0, 1e-5);
    run(world, 30);
    EXPECT_NEAR(world.points("ring.hoop").x[3].y, 0.5 * 9.81 * 0.25, 1e-4);
    // 0.6 kg at 1 m/s; the kinetic energy comes from the potential of gravity and lift together.
    const Metrics metrics = world.metrics("ring.*");
    EXPECT_NEAR(metrics.kinetic, 0.3 * (1.0 + std::pow(9.81 * 0.5, 2)), 1e-3);
    EXPECT_NEAR(metrics.energy(), 0.3, 1e-3);
    EXPECT_EQ(world.view(false).surfaces.size(), 6U) << "drawn as its springs";
}

TEST(OwnKinds, AreSavedAndRestored) {
    const scene::AssetFolder folder;
    World world(sceneOf(folder));
    run(world, 40);
    const std::vector<std::byte> bytes = world.save();
    World again(sceneOf(folder));
    again.restore(bytes);
    run(world, 20);
    run(again, 20);
    EXPECT_EQ(again.stateHash(), world.stateHash());

    SceneSpec without = sceneOf(folder);
    without.actions.clear();
    without.forces.clear();
    World other(without);
    try {
        other.restore(bytes);
        FAIL() << "restored without the kind";
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what()).find("force lift.balloon"), std::string::npos) << error.what();
    }
}

TEST(OwnKinds, StandInSchemaAndManualAndAreRefusedByNameWithoutThem) {
    EXPECT_NE(scene::jsonSchema(mine()).find("\"ring\""), std::string::npos);
    EXPECT_NE(scene::manual(mine()).find("[lift.NAME]\n  Pulls everything up."), std::string::npos);
    const scene::AssetFolder folder;
    const std::string message = folder.messageOf(text);
    EXPECT_NE(message.find("a scene has no \"ring\""), std::string::npos) << message;
    EXPECT_NE(message.find("a scene has no \"lift\""), std::string::npos) << message;
}

}  // namespace
}  // namespace taut::world::own_kinds_test
