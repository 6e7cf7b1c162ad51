// Every row: a faulty scene and the exact message with file, line, column, caret and remedy.
#include "taut/scene/private/used_files.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, ReferencesToWhatIsNotThereAreReported) {
    expectMessages({
        {"a material that is not there",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"n\"\n",
         "s.toml:4:12: error: there is no material \"n\"\n"
         "  material = \"n\"\n"
         "             ^ add a table [material.n], or take a fabric: taut materials lists them"},
        {"a material that is nearly there",
         "[material.nylon]\n"
         "[cloth.c]\n"
         "material = \"nylno\"\n",
         "s.toml:4:12: error: there is no material \"nylno\"\n"
         "  material = \"nylno\"\n"
         "             ^ did you mean \"nylon\"?"},
        {"a material without a name",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"\"\n",
         "s.toml:4:12: error: there is no material \"\"\n"
         "  material = \"\"\n"
         "             ^ give a name"},
        {"a camera that is not there",
         "[picture]\n"
         "camera = \"mian\"\n"
         "[camera.main]\n",
         "s.toml:3:10: error: there is no camera \"mian\"\n"
         "  camera = \"mian\"\n"
         "           ^ did you mean \"main\"?"},
        {"a target without a kind",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[mass]]\n"
         "target = \"r@end\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: \"r@end\" names no body\n"
         "  target = \"r@end\"\n"
         "           ^ write KIND.NAME, e.g. cloth.flag"},
        {"a target of an unknown kind",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[mass]]\n"
         "target = \"roep.r@end\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: \"roep\" is no kind of body\n"
         "  target = \"roep.r@end\"\n"
         "           ^ did you mean \"rope\"?"},
        {"a target that is no body",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[mass]]\n"
         "target = \"collider.s@all\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: \"collider\" is no kind of body\n"
         "  target = \"collider.s@all\"\n"
         "           ^ bodies are cloth, rope, block, net, solid"},
        {"a target that is not there",
         "[rope.rail]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[mass]]\n"
         "target = \"rope.rial@end\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: there is no rope.rial\n"
         "  target = \"rope.rial@end\"\n"
         "           ^ did you mean \"rope.rail\"?"},
        {"a wildcard that fits nothing",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[mass]]\n"
         "target = \"cloth.*@all\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: there is no cloth.*\n"
         "  target = \"cloth.*@all\"\n"
         "           ^"},
        {"a target without a selector",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[mass]]\n"
         "target = \"rope.r\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: \"rope.r\" does not say which points\n"
         "  target = \"rope.r\"\n"
         "           ^ write rope.r@all or another selector"},
        {"an array without a number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "array = { count = [3, 1, 1], step_x = [1, 0, 0] }\n"
         "[[mass]]\n"
         "target = \"rope.r@end\"\n"
         "mass_kg = 1\n",
         "s.toml:6:10: error: rope.r is an array\n"
         "  target = \"rope.r@end\"\n"
         "           ^ write rope.r.0 … rope.r.2, or rope.r.*"},
        {"a copy that an array lacks",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "array = { count = [3, 1, 1], step_x = [1, 0, 0] }\n"
         "[[mass]]\n"
         "target = \"rope.r.3@end\"\n"
         "mass_kg = 1\n",
         "s.toml:6:10: error: there is no rope.r.3\n"
         "  target = \"rope.r.3@end\"\n"
         "           ^ the copies are rope.r.0 … rope.r.2"},
        {"an unknown group of a rope",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"left\"]\n",
         "s.toml:4:9: error: rope.r has no points \"left\"\n"
         "  hold = [\"left\"]\n"
         "          ^ it has start, end, ends, all"},
        {"an unknown group of a cloth",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "hold = [\"top-lefft\"]\n",
         "s.toml:5:9: error: cloth.c has no points \"top-lefft\"\n"
         "  hold = [\"top-lefft\"]\n"
         "          ^ did you mean \"top-left\"?"},
        {"a group that only meshes have",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "hold = [\"boundary\"]\n",
         "s.toml:5:9: error: cloth.c has no points \"boundary\"\n"
         "  hold = [\"boundary\"]\n"
         "          ^ it has left, right, top, bottom, top-left, top-right, bottom-left, bottom-right, corners, edges, "
         "all"},
        {"an unknown group of a block",
         "[block.b]\n"
         "hold = [\"all\", \"edges\"]\n",
         "s.toml:3:16: error: block.b has no points \"edges\"\n"
         "  hold = [\"all\", \"edges\"]\n"
         "                 ^ it has left, right, bottom, top, back, front, corners, all"},
        {"a point beyond the last",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "segments = 4\n"
         "hold = [\"#5\"]\n",
         "s.toml:5:9: error: rope.r has no point #5\n"
         "  hold = [\"#5\"]\n"
         "          ^ its points are #0 … #4"},
        {"a point beyond any number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"#99999999999999999999\"]\n",
         "s.toml:4:9: error: rope.r has no point #99999999999999999999\n"
         "  hold = [\"#99999999999999999999\"]\n"
         "          ^ its points are #0 … #40"},
        {"a point that is no number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"#-1\"]\n",
         "s.toml:4:9: error: \"#-1\" is not the number of a point\n"
         "  hold = [\"#-1\"]\n"
         "          ^ write #0, #1, …"},
        {"a place off the cloth",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "hold = [\"(0.5,1.5)\"]\n",
         "s.toml:5:9: error: \"(0.5,1.5)\" is not a place on a cloth\n"
         "  hold = [\"(0.5,1.5)\"]\n"
         "          ^ write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres"},
        {"a place without a comma",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "hold = [\"(0.5)\"]\n",
         "s.toml:5:9: error: \"(0.5)\" is not a place on a cloth\n"
         "  hold = [\"(0.5)\"]\n"
         "          ^ write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres"},
        {"a radius below zero",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "hold = [\"(0.5,0.5,-1)\"]\n",
         "s.toml:5:9: error: \"(0.5,0.5,-1)\" is not a place on a cloth\n"
         "  hold = [\"(0.5,0.5,-1)\"]\n"
         "          ^ write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres"},
        {"a corner of a round cloth",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "round = true\n"
         "hold = [\"(0,1)\"]\n",
         "s.toml:6:9: error: cloth.c is round: there is nothing of it at (0,1)\n"
         "  hold = [\"(0,1)\"]\n"
         "          ^ (0.5,0.5) is its middle"},
        {"a place on a rope",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"(0.5,0.5)\"]\n",
         "s.toml:4:9: error: rope.r is no grid: it has no (u,v)\n"
         "  hold = [\"(0.5,0.5)\"]\n"
         "          ^"},
        {"a share of a cloth",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "hold = [\"50%\"]\n",
         "s.toml:5:9: error: cloth.c is no rope: it has no 50%\n"
         "  hold = [\"50%\"]\n"
         "          ^"},
        {"a share above the whole",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"150%\"]\n",
         "s.toml:4:9: error: \"150%\" is not a place along a rope\n"
         "  hold = [\"150%\"]\n"
         "          ^ write 0% … 100%"},
        {"an empty selector",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"\"]\n",
         "s.toml:4:9: error: rope.r has no points \"\"\n"
         "  hold = [\"\"]\n"
         "          ^ it has start, end, ends, all"},
        {"a joint with a fault at each end",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "a = \"rope.q@end\"\n"
         "b = \"rope.r@ennd\"\n",
         "s.toml:5:5: error: there is no rope.q\n"
         "  a = \"rope.q@end\"\n"
         "      ^ did you mean \"rope.r\"?\n"
         "s.toml:6:5: error: rope.r has no points \"ennd\"\n"
         "  b = \"rope.r@ennd\"\n"
         "      ^ did you mean \"end\"?"},
        {"an anchor with a fault",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[anchor.a]\n"
         "target = \"rope.r@#41\"\n"
         "at = [0, 0, 0]\n",
         "s.toml:5:10: error: rope.r has no point #41\n"
         "  target = \"rope.r@#41\"\n"
         "           ^ its points are #0 … #40"},
        {"a joint of bodies that disagree",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[rope.s]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "solver = { safety = 0.5 }\n"
         "[[joint]]\n"
         "a = \"rope.r@end\"\n"
         "b = \"rope.s@end\"\n",
         "s.toml:7:1: error: this joint ties rope.r and rope.s, whose solver overrides differ in safety\n"
         "  [[joint]]\n"
         "  ^ give both the same"},
        {"a wind on points",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "[wind.w]\n"
         "on = [\"cloth.c@all\"]\n",
         "s.toml:6:7: error: \"cloth.c@all\" names points, not a body\n"
         "  on = [\"cloth.c@all\"]\n"
         "        ^ write cloth.c"},
        {"a filling of a rope",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[filling.w]\n"
         "in = [\"rope.r\"]\n",
         "s.toml:5:7: error: a rope has no surface\n"
         "  in = [\"rope.r\"]\n"
         "        ^ bodies with a surface are cloth, block"},
        {"a spring to no point",
         "[net.n]\n"
         "points = [{ name = \"anna\", position = [0, 0, 0] }, { name = \"b\", position = [1, 0, 0] }]\n"
         "springs = [{ a = \"b\", b = \"ana\" }]\n",
         "s.toml:4:27: error: there is no point \"ana\"\n"
         "  springs = [{ a = \"b\", b = \"ana\" }]\n"
         "                            ^ did you mean \"anna\"?"},
        {"a spring from a point to itself",
         "[net.n]\n"
         "points = [{ name = \"a\", position = [0, 0, 0] }]\n"
         "springs = [{ a = \"a\", b = \"a\" }]\n",
         "s.toml:4:27: error: a spring needs two different points\n"
         "  springs = [{ a = \"a\", b = \"a\" }]\n"
         "                            ^"},
        {"two points of one name",
         "[net.n]\n"
         "points = [{ name = \"a\", position = [0, 0, 0] }, { name = \"a\", position = [1, 0, 0] }]\n",
         "s.toml:3:58: error: there is a point \"a\" already\n"
         "  points = [{ name = \"a\", position = [0, 0, 0] }, { name = \"a\", position = [1, 0, 0] }]\n"
         "                                                           ^"},
        {"a point with an impossible name",
         "[net.n]\n"
         "points = [{ name = \"#1\", position = [0, 0, 0] }]\n",
         "s.toml:3:20: error: \"#1\" cannot be the name of a point\n"
         "  points = [{ name = \"#1\", position = [0, 0, 0] }]\n"
         "                     ^ a name has letters, digits, - and _"},
        {"a point called all",
         "[net.n]\n"
         "points = [{ name = \"all\", position = [0, 0, 0] }]\n",
         "s.toml:3:20: error: \"all\" cannot be the name of a point: it means all of them\n"
         "  points = [{ name = \"all\", position = [0, 0, 0] }]\n"
         "                     ^"},
        {"an unknown point of a net",
         "[net.n]\n"
         "points = [{ name = \"a\", position = [0, 0, 0] }]\n"
         "[[mass]]\n"
         "target = \"net.n@b\"\n"
         "mass_kg = 1\n",
         "s.toml:5:10: error: net.n has no points \"b\"\n"
         "  target = \"net.n@b\"\n"
         "           ^ it has a, all"},
        {"a model that is not there",
         "[collider.s]\n"
         "shape = \"mesh\"\n"
         "mesh = \"body.obj\"\n",
         "s.toml:4:8: error: there is no file \"body.obj\"\n"
         "  mesh = \"body.obj\"\n"
         "         ^ looked for body.obj"},
        {"a picture that is not there",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { pattern = \"image\", texture = \"art.png\" }\n",
         "s.toml:4:41: error: there is no file \"art.png\"\n"
         "  finish = { pattern = \"image\", texture = \"art.png\" }\n"
         "                                          ^ looked for art.png"},
        {"a model that is a folder",
         "[collider.s]\n"
         "shape = \"mesh\"\n"
         "mesh = \"models\"\n",
         "s.toml:4:8: error: there is no file \"models\"\n"
         "  mesh = \"models\"\n"
         "         ^ looked for models"},
        {"a model that is wrong",
         "[collider.s]\n"
         "shape = \"mesh\"\n"
         "mesh = \"broken.obj\"\n",
         "s.toml:4:8: error: cannot use this mesh: broken.obj:4: error: there is no vertex 4: 3 are defined so far\n"
         "  mesh = \"broken.obj\"\n"
         "         ^"},
    });
}

// What can be used is said by who knows pictures; the keys of pictures change with what is in them.
TEST(SceneErrors, PicturesThatCannotBeUsedAreReported) {
    const AssetFolder folder;
    LoadOptions options;
    options.pictureFault = [](const std::filesystem::path& picture, bool isAround) {
        return isAround ? picture.filename().string() + ": too narrow" : "";
    };
    const std::string text =
        "schema = 1\nenvironment = { image = \"square.png\" }\n[rope.r]\n"
        "ends = [[0, 0, 0], [1, 0, 0]]\nfinish = { pattern = \"image\", texture = \"square.png\" }\n";
    EXPECT_EQ(folder.messageOf(text, options),
              "s.toml:2:25: error: cannot use this picture: square.png: too narrow\n"
              "  environment = { image = \"square.png\" }\n"
              "                          ^");

    const world::SceneSpec scene = folder.load(text).spec;
    const std::vector<UsedFile> before = pictureFiles(scene);
    ASSERT_EQ(before.size(), 1U);
    folder.write("square.png", "another");
    EXPECT_NE(pictureFiles(scene)[0].content, before[0].content);
}

}  // namespace
}  // namespace taut::scene
