// Labels and freezing in scene files: accepted texts, and the exact messages for the others.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, FaultsOfLabelsAreReported) {
    expectMessages({
        {"a label without a place",
         "[label.a]\n"
         "text = \"x\"\n",
         "s.toml:2:8: error: [label.a] has no place\n"
         "  [label.a]\n"
         "         ^ give at = [x, y, z], screen = [x, y], or of = \"KIND.NAME\""},
        {"a label without text",
         "[label.a]\n"
         "screen = [0.5, 0.5]\n",
         "s.toml:2:8: error: [label.a] needs text\n"
         "  [label.a]\n"
         "         ^ only a label of bodies has a text of its own: their method"},
        {"a label without letters",
         "[label.a]\n"
         "text = \"\"\n"
         "screen = [0.5, 0.5]\n",
         "s.toml:3:8: error: text must not be empty\n"
         "  text = \"\"\n"
         "         ^"},
        {"a label with two places",
         "[label.a]\n"
         "text = \"x\"\n"
         "at = [0, 0, 0]\n"
         "screen = [0.5, 0.5]\n",
         "s.toml:5:1: error: screen does not go with a label in the world\n"
         "  screen = [0.5, 0.5]\n"
         "  ^ it belongs to a label on the screen"},
        {"a label of a body that is not there",
         "[rope.rail]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[label.a]\n"
         "of = \"rope.rial\"\n",
         "s.toml:5:6: error: there is no rope.rial\n"
         "  of = \"rope.rial\"\n"
         "       ^ did you mean \"rope.rail\"?"},
        {"a label of points",
         "[rope.rail]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[label.a]\n"
         "of = \"rope.rail@start\"\n",
         "s.toml:5:6: error: \"rope.rail@start\" names points, not a body\n"
         "  of = \"rope.rail@start\"\n"
         "       ^ write rope.rail"},
        {"a caption that ends before it begins",
         "[label.a]\n"
         "text = \"x\"\n"
         "screen = [0.5, 0.5]\n"
         "from_s = 2.0\n"
         "to_s = 1.5\n",
         "s.toml:6:8: error: to_s must be later than from_s\n"
         "  to_s = 1.5\n"
         "         ^"},
        {"a size beyond the picture",
         "[label.a]\n"
         "text = \"x\"\n"
         "screen = [0.5, 0.5]\n"
         "size = 20\n",
         "s.toml:5:8: error: size must be between 0.005 and 0.5, not 20\n"
         "  size = 20\n"
         "         ^"},
        {"an alignment that is not there",
         "[label.a]\n"
         "text = \"x\"\n"
         "screen = [0.5, 0.5]\n"
         "align = \"center\"\n",
         "s.toml:5:9: error: align must be one of left, centre, right, not \"center\"\n"
         "  align = \"center\"\n"
         "          ^ did you mean \"centre\"?"},
        {"what to do on a divergence",
         "[solver]\n"
         "on_divergence = \"freze\"\n",
         "s.toml:3:17: error: on_divergence must be one of stop, freeze, not \"freze\"\n"
         "  on_divergence = \"freze\"\n"
         "                  ^ did you mean \"freeze\"?"},
        {"a strain of nothing",
         "[solver]\n"
         "freeze_strain = 0\n",
         "s.toml:3:17: error: freeze_strain must be between 0.01 and 1e+06, not 0\n"
         "  freeze_strain = 0\n"
         "                  ^"},
    });
}

TEST(SceneFields, LabelsLandInTheirMembersSortedByName) {
    const AssetFolder folder;
    const world::SceneSpec scene = folder
                                       .load(
                                           "schema = 1\n"
                                           "[solver]\n"
                                           "on_divergence = \"freeze\"\n"
                                           "freeze_strain = 0.5\n"
                                           "[rope.r]\n"
                                           "ends = [[0, 0, 0], [1, 0, 0]]\n"
                                           "[label.c]\n"
                                           "text = \"ω h\"\n"
                                           "at = [1, 2, 3]\n"
                                           "size = 0.05\n"
                                           "colour = \"#ff0000\"\n"
                                           "align = \"right\"\n"
                                           "plate = 0.4\n"
                                           "[label.b]\n"
                                           "of = \"rope.*\"\n"
                                           "[label.a]\n"
                                           "text = \"x\"\n"
                                           "screen = [0.1, 0.2]\n")
                                       .spec;
    EXPECT_EQ(scene.solver.onDivergence, world::OnDivergence::freeze);
    EXPECT_EQ(scene.solver.freezeStrain, 0.5);
    ASSERT_EQ(scene.labels.size(), 3U);
    EXPECT_EQ(scene.labels[0].name, "a");
    EXPECT_EQ(scene.labels[0].screen, glm::dvec2(0.1, 0.2));
    EXPECT_EQ(scene.labels[1].of, "rope.*");
    EXPECT_EQ(scene.labels[1].text, std::nullopt);
    const world::LabelSpec& full = scene.labels[2];
    EXPECT_EQ(full.text, "ω h");
    EXPECT_EQ(full.at, glm::dvec3(1, 2, 3));
    EXPECT_EQ(full.size, 0.05);
    EXPECT_EQ(full.colour, glm::dvec3(1, 0, 0));
    EXPECT_EQ(full.align, world::Align::right);
    EXPECT_EQ(full.plate, 0.4);
}

}  // namespace
}  // namespace taut::scene
