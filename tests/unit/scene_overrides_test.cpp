// Fields given on the command line.
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

constexpr const char* yard =
    "schema = 1\n"
    "[material.m]\n"
    "[cloth.flag]\nmaterial = \"m\"\nhold = [\"left\"]\n"
    "[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n"
    "[[mass]]\ntarget = \"rope.r@end\"\nmass_kg = 1\n";

world::SceneSpec sceneWith(const std::vector<std::string>& overrides) {
    LoadOptions options;
    options.overrides = overrides;
    return AssetFolder().load(yard, options).spec;
}

std::string messageWith(const std::vector<std::string>& overrides) {
    LoadOptions options;
    options.overrides = overrides;
    return AssetFolder().messageOf(yard, options);
}

TEST(SceneOverrides, ReplaceAndAddFields) {
    const world::SceneSpec scene = sceneWith({"cloth.flag.cells=[72,48]", "cloth.flag.hold = []", "solver.dt=1e-3",
                                              "cloth.flag.finish.colour=#ff0000", "solver.precision=double",
                                              "material.m.stretch_N_per_m=5", "wind={}"});
    EXPECT_EQ(scene.bodies.of<world::ClothSpec>()[0].cells, glm::ivec2(72, 48));
    EXPECT_TRUE(scene.bodies.of<world::ClothSpec>()[0].hold.empty());
    EXPECT_EQ(scene.bodies.of<world::ClothSpec>()[0].finish.colour, glm::dvec3(1, 0, 0));
    EXPECT_EQ(scene.solver.dt, 1e-3);
    EXPECT_EQ(scene.solver.precision, world::Precision::double_);
    EXPECT_EQ(scene.materials.at("m").stretch, 5.0);
}

TEST(SceneOverrides, ReachIntoLists) {
    const world::SceneSpec scene = sceneWith({"mass.0.mass_kg=3", "cloth.flag.hold.0=right", "rope.r.ends.1.0=2"});
    EXPECT_EQ(scene.masses[0].mass, 3.0);
    EXPECT_EQ(scene.bodies.of<world::ClothSpec>()[0].hold[0], "right");
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].end, glm::dvec3(2, 0, 0));
}

TEST(SceneOverrides, AStarStandsForAnyLettersOfAName) {
    const AssetFolder folder;
    const std::string text =
        std::string(yard) + "[rope.rig]\nends = [[0, 1, 0], [1, 1, 0]]\n[rope.sag]\nends = [[0, 2, 0], [1, 2, 0]]\n";
    LoadOptions options;
    options.overrides = {"rope.*.segments=7", "rope.r*.segments=9", "mass.*.mass_kg=3"};
    const world::SceneSpec scene = folder.load(text, options).spec;
    std::vector<int> segments;
    for (const world::RopeSpec& rope : scene.bodies.of<world::RopeSpec>()) segments.push_back(rope.segments);
    EXPECT_EQ(segments, (std::vector<int>{9, 9, 7}));  // r, rig, sag
    EXPECT_EQ(scene.masses[0].mass, 3.0);
    options.overrides = {"rope.*.segments=0"};  // reported once
    EXPECT_EQ(folder.messageOf(text, options),
              "--set rope.*.segments: error: segments must be between 1 and 1e+09, not 0");
}

TEST(SceneOverrides, TheLastOneWins) {
    EXPECT_EQ(sceneWith({"run.fps=30", "run.fps=24"}).run.fps, 24.0);
}

TEST(SceneOverrides, FaultsAreNamedByTheirKey) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"cloth.flag.cells=[72]",
         "--set cloth.flag.cells: error: cells must be a list of 2 whole numbers, not a list of 1"},
        {"cloth.flag.cells=[72,-1]", "--set cloth.flag.cells: error: cells[1] must be between 1 and 1e+09, not -1"},
        {"cloth.flag.celsl=[72,1]",
         "--set cloth.flag.celsl: error: [cloth.flag] has no key \"celsl\"; did you mean \"cells\"?"},
        {"cloth.falg.cells=[72,1]",
         "--set cloth.falg.cells: error: there is no cloth \"falg\"; did you mean \"flag\"?"},
        {"block.b.cells=[1,1,1]", "--set block.b.cells: error: there is no block \"b\""},
        {"rope.x*.segments=1", "--set rope.x*.segments: error: there is no rope \"x*\""},
        {"block.*.cells=[1,1,1]", "--set block.*.cells: error: there is no block \"*\""},
        {"clth.flag.cells=[72,1]", "--set clth.flag.cells: error: a scene has no \"clth\"; did you mean \"cloth\"?"},
        {"joint.0.kind=weld", "--set joint.0.kind: error: the scene has no [[joint]]"},
        {"mass.1.mass_kg=3", "--set mass.1.mass_kg: error: mass has no element \"1\"; write mass.0 … mass.0"},
        {"mass.mass_kg=3", "--set mass.mass_kg: error: mass has no element \"mass_kg\"; write mass.0 … mass.0"},
        {"schema.x=3", "--set schema.x: error: schema is 1: it has no \"x\""},
        {"solver.integrator=leapforg",
         "--set solver.integrator: error: integrator must be one of euler, symplectic-euler, heun, midpoint, rk4, "
         "velocity-verlet, leapfrog, blanes-moan, implicit-euler, sdirk2, not "
         "\"leapforg\"; "
         "did you mean \"leapfrog\"?"},
        {"cloth.flag.material=none",
         "--set cloth.flag.material: error: there is no material \"none\"; "
         "add a table [material.none], or take a fabric: taut materials lists them"},
        {"solver.dt=[1", "--set solver.dt: error: [1 is not a value: array: encountered end-of-file"},
        {"picture.samples=0 # --samples", "--samples: error: samples must be 1 or 4 or 8 or 16, not 0"},
        {"solver.dt=1\nx=2", "--set solver.dt: error: the value must be one value"},
    };
    for (const auto& [override, message] : cases) EXPECT_EQ(messageWith({override}), message);
}

TEST(SceneOverrides, FaultsOfTheFileComeFirst) {
    LoadOptions options;
    options.overrides = {"run.fps=0", "run.seconds=0"};
    EXPECT_EQ(AssetFolder().messageOf("schema = 1\n[solver]\nsafety = 2\n", options),
              "s.toml:3:10: error: safety must be between 0.01 and 1, not 2\n"
              "  safety = 2\n"
              "           ^\n"
              "--set run.fps: error: fps must be between 0.1 and 1000 1/s, not 0\n"
              "--set run.seconds: error: seconds must be between 0.001 and 1e+06 s, not 0");
}

TEST(SceneOverrides, OneWithoutKeyOrValueIsWrongUsage) {
    for (const std::string override : {"", "=", "run.fps", "run.fps=", "=30", " = "}) {
        try {
            sceneWith({override});
            ADD_FAILURE() << "accepted: " << override;
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::usage);
            EXPECT_NE(std::string(error.what()).find("write KEY=VALUE"), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace taut::scene
