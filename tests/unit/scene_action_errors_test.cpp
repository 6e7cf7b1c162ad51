// Every row: a faulty action and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, ActionsThatAreIncompleteAreReported) {
    expectMessages({
        {"an action without a moment",
         "at = [\n"
         "  { do = \"grab\", id = \"h\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: [[at]] needs t\n"
         "    { do = \"grab\", id = \"h\", target = \"rope.r@end\" },\n"
         "    ^ t is a number [s]: Moment; the nearest tick is taken"},
        {"an action that does nothing",
         "at = [\n"
         "  { t = 1, target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: [[at]] needs do\n"
         "    { t = 1, target = \"rope.r@end\" },\n"
         "    ^ do is one of grab, move, release, push, hold, free, cut, add-mass, ramp, spawn: What happens"},
        {"an unknown action",
         "at = [\n"
         "  { t = 1, do = \"gab\", id = \"h\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:17: error: do must be one of grab, move, release, push, hold, free, cut, add-mass, ramp, spawn, not "
         "\"gab\"\n"
         "    { t = 1, do = \"gab\", id = \"h\", target = \"rope.r@end\" },\n"
         "                  ^ did you mean \"grab\"?"},
        {"a key of another action",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@end\", impulse_Ns = [1, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:58: error: impulse_Ns does not go with do \"grab\"\n"
         "    { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@end\", impulse_Ns = [1, 0, 0] },\n"
         "                                                           ^ it belongs to push"},
        {"a grab of nothing",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: do = \"grab\" needs target\n"
         "    { t = 1, do = \"grab\", id = \"h\" },\n"
         "    ^ write target = \"KIND.NAME@SELECTOR\""},
        {"a grab by nobody",
         "at = [\n"
         "  { t = 1, do = \"grab\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: do = \"grab\" needs id\n"
         "    { t = 1, do = \"grab\", target = \"rope.r@end\" },\n"
         "    ^ id is the name of the hand"},
        {"a rigid hand with a largest force",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\", target = \"rope.r\", rigid = true, max_force_N = 30 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:82: error: a rigid hand leads its points whatever it takes\n"
         "    { t = 1, do = \"grab\", id = \"h\", target = \"rope.r\", rigid = true, max_force_N = 30 },\n"
         "                                                                                   ^ leave max_force_N or "
         "rigid out"},
        {"a hand without a name",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:30: error: a hand needs a name\n"
         "    { t = 1, do = \"grab\", id = \"\", target = \"rope.r@end\" },\n"
         "                               ^"},
        {"a move of nothing",
         "at = [\n"
         "  { t = 1, do = \"move\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: do = \"move\" needs id or target\n"
         "    { t = 1, do = \"move\", to = [0, 0, 0] },\n"
         "    ^ write id = \"HAND\" or target = \"collider.NAME\""},
        {"a move of two things",
         "at = [\n"
         "  { t = 1, do = \"move\", id = \"h\", target = \"collider.b\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:44: error: a move has id or target, not both\n"
         "    { t = 1, do = \"move\", id = \"h\", target = \"collider.b\", to = [0, 0, 0] },\n"
         "                                             ^ a hand has an id, a collider is a target"},
        {"a move to nowhere",
         "at = [\n"
         "  { t = 1, do = \"move\", id = \"h\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: do = \"move\" needs to\n"
         "    { t = 1, do = \"move\", id = \"h\" },\n"
         "    ^ write to = [x, y, z]"},
        {"a move to a number",
         "at = [\n"
         "  { t = 1, do = \"move\", id = \"h\", to = 3 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:40: error: to must be a list of 3 numbers [m], not 3\n"
         "    { t = 1, do = \"move\", id = \"h\", to = 3 },\n"
         "                                         ^"},
        {"a push of nothing",
         "at = [\n"
         "  { t = 1, do = \"push\", target = \"rope.r@end\", impulse_Ns = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:61: error: a push of [0, 0, 0] does nothing\n"
         "    { t = 1, do = \"push\", target = \"rope.r@end\", impulse_Ns = [0, 0, 0] },\n"
         "                                                              ^"},
        {"a push without an impulse",
         "at = [\n"
         "  { t = 1, do = \"push\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: [[at]] needs impulse_Ns\n"
         "    { t = 1, do = \"push\", target = \"rope.r@end\" },\n"
         "    ^ impulse_Ns is a list of 3 numbers [N s]: Of all the points, shared by mass"},
        {"a cut along two things",
         "at = [\n"
         "  { t = 1, do = \"cut\", target = \"cloth.c\", plane = [[0, 0, 0], [1, 0, 0]], segment = [[0, 0], [1, 1]] "
         "},\n"
         "]\n"
         "[cloth.c]\nmaterial = \"m\"\n[material.m]\n",
         "s.toml:3:86: error: a cut has a plane or a segment, not both\n"
         "    { t = 1, do = \"cut\", target = \"cloth.c\", plane = [[0, 0, 0], [1, 0, 0]], segment = [[0, 0], [1, 1]] "
         "},\n"
         "                                                                                       ^ leave one out; "
         "without either all of the body comes apart"},
        {"a cut along a point",
         "at = [\n"
         "  { t = 1, do = \"cut\", target = \"cloth.c\", segment = [[0.5, 0.5], [0.5, 0.5]] },\n"
         "]\n"
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n",
         "s.toml:3:54: error: the two ends of the cut are the same point\n"
         "    { t = 1, do = \"cut\", target = \"cloth.c\", segment = [[0.5, 0.5], [0.5, 0.5]] },\n"
         "                                                       ^"},
        {"a cut along a plane that faces nowhere",
         "at = [\n"
         "  { t = 1, do = \"cut\", target = \"rope.r\", plane = [[0, 0, 0], [0, 0, 0]] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:51: error: the normal of the plane must not be [0, 0, 0]\n"
         "    { t = 1, do = \"cut\", target = \"rope.r\", plane = [[0, 0, 0], [0, 0, 0]] },\n"
         "                                                    ^"},
        {"a cut beyond the cloth",
         "at = [\n"
         "  { t = 1, do = \"cut\", target = \"cloth.c\", segment = [[0.5, 0.5], [0.5, 1.5]] },\n"
         "]\n"
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n",
         "s.toml:3:73: error: segment[1][1] must be between 0 and 1, not 1.5\n"
         "    { t = 1, do = \"cut\", target = \"cloth.c\", segment = [[0.5, 0.5], [0.5, 1.5]] },\n"
         "                                                                          ^"},
        {"a segment of a rope",
         "at = [\n"
         "  { t = 1, do = \"cut\", target = \"rope.r\", segment = [[0.5, 0.5], [0.5, 1]] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:33: error: rope.r is no cloth grid: it has no segment\n"
         "    { t = 1, do = \"cut\", target = \"rope.r\", segment = [[0.5, 0.5], [0.5, 1]] },\n"
         "                                  ^ cut it with a plane"},
        {"a ramp to nowhere",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"world.gravity\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:3: error: do = \"ramp\" needs to\n"
         "    { t = 1, do = \"ramp\", key = \"world.gravity\" },\n"
         "    ^ to is the value that the ramp ends at"},
        {"a negative time",
         "at = [\n"
         "  { t = -1, do = \"release\", id = \"h\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:9: error: t must be between 0 and 1e+06 s, not -1\n"
         "    { t = -1, do = \"release\", id = \"h\" },\n"
         "          ^"},
        {"actions that are no list",
         "[at]\n"
         "t = 1\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:2:2: error: at must be a list of tables, not a table\n"
         "  [at]\n"
         "   ^ write [[at]]"},
    });
}

TEST(SceneErrors, TargetsOfActionsThatAreNotThereAreReported) {
    expectMessages({
        {"a body that is not there",
         "at = [\n"
         "  { t = 1, do = \"push\", target = \"rope.s@end\", impulse_Ns = [1, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:34: error: there is no rope.s\n"
         "    { t = 1, do = \"push\", target = \"rope.s@end\", impulse_Ns = [1, 0, 0] },\n"
         "                                   ^ did you mean \"rope.r\"?"},
        {"points that are not there",
         "at = [\n"
         "  { t = 1, do = \"hold\", target = \"rope.r@ent\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:34: error: rope.r has no points \"ent\"\n"
         "    { t = 1, do = \"hold\", target = \"rope.r@ent\" },\n"
         "                                   ^ did you mean \"end\"?"},
        {"a point beyond the last",
         "at = [\n"
         "  { t = 1, do = \"free\", target = \"rope.r@#41\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:34: error: rope.r has no point #41\n"
         "    { t = 1, do = \"free\", target = \"rope.r@#41\" },\n"
         "                                   ^ its points are #0 … #40"},
        {"a place on a rope",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@(0,1)\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:44: error: rope.r is no grid: it has no (u,v)\n"
         "    { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@(0,1)\" },\n"
         "                                             ^"},
        {"a kind that is none",
         "at = [\n"
         "  { t = 1, do = \"add-mass\", target = \"robe.r@end\", mass_kg = 1 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:38: error: \"robe\" is no kind of body\n"
         "    { t = 1, do = \"add-mass\", target = \"robe.r@end\", mass_kg = 1 },\n"
         "                                       ^ did you mean \"rope\"?"},
        {"a collider that is not there",
         "at = [\n"
         "  { t = 1, do = \"move\", target = \"collider.bal\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[collider.ball]\n"
         "shape = \"sphere\"\n",
         "s.toml:3:34: error: there is no collider.bal\n"
         "    { t = 1, do = \"move\", target = \"collider.bal\", to = [0, 0, 0] },\n"
         "                                   ^ did you mean \"collider.ball\"?"},
        {"a body moved like a collider",
         "at = [\n"
         "  { t = 1, do = \"move\", target = \"rope.r\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:34: error: \"rope.r\" is no collider\n"
         "    { t = 1, do = \"move\", target = \"rope.r\", to = [0, 0, 0] },\n"
         "                                   ^ a move takes a collider, or a hand by its id"},
        {"a collider led twice",
         "at = [\n"
         "  { t = 1, do = \"move\", target = \"collider.ball\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[collider.ball]\n"
         "shape = \"sphere\"\n"
         "keys = [{ t = 0 }]\n",
         "s.toml:3:34: error: collider.ball is led by its keys\n"
         "    { t = 1, do = \"move\", target = \"collider.ball\", to = [0, 0, 0] },\n"
         "                                   ^ move it by one of the two"},
        {"a cut of points",
         "at = [\n"
         "  { t = 1, do = \"cut\", target = \"rope.r@end\", plane = [[0, 0, 0], [1, 0, 0]] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:33: error: \"rope.r@end\" names points, not a body\n"
         "    { t = 1, do = \"cut\", target = \"rope.r@end\", plane = [[0, 0, 0], [1, 0, 0]] },\n"
         "                                  ^ write rope.r"},
        {"a spawn of points",
         "at = [\n"
         "  { t = 1, do = \"spawn\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:35: error: \"rope.r@end\" names points, not a body\n"
         "    { t = 1, do = \"spawn\", target = \"rope.r@end\" },\n"
         "                                    ^ write rope.r"},
    });
}

TEST(SceneErrors, TimesThatDoNotFitTheRunAreReported) {
    expectMessages({
        {"an action after the end",
         "at = [\n"
         "  { t = 7.5, do = \"hold\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:9: error: 7.5 s is past the end: the last frame shows 4.98333 s\n"
         "    { t = 7.5, do = \"hold\", target = \"rope.r@end\" },\n"
         "          ^ set seconds in [run]"},
        {"an action in the last frame",
         "at = [\n"
         "  { t = 4.99, do = \"hold\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:9: error: 4.99 s is past the end: the last frame shows 4.98333 s\n"
         "    { t = 4.99, do = \"hold\", target = \"rope.r@end\" },\n"
         "          ^ set seconds in [run]"},
        {"a golden after the end",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[golden]]\n"
         "frames = [0, 299, 300]\n",
         "s.toml:5:19: error: frame 300 is past the end: the last is 299\n"
         "  frames = [0, 299, 300]\n"
         "                    ^"},
        {"a golden of nothing",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[golden]]\n"
         "frames = []\n",
         "s.toml:5:10: error: frames must not be empty\n"
         "  frames = []\n"
         "           ^"},
        {"a golden before the start",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[golden]]\n"
         "frames = [-1]\n",
         "s.toml:5:11: error: frames[0] must be between 0 and 1e+09, not -1\n"
         "  frames = [-1]\n"
         "            ^"},
        {"a golden through no camera",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[golden]]\n"
         "frames = [1]\n"
         "camera = \"main\"\n",
         "s.toml:6:10: error: there is no camera \"main\"\n"
         "  camera = \"main\"\n"
         "           ^ add a table [camera.main]"},
    });
}

}  // namespace
}  // namespace taut::scene
