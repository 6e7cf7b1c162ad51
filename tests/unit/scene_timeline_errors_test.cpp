// Every row: actions that do not go together, and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, HandsOutOfTheirOrderAreReported) {
    expectMessages({
        {"a move before the grab",
         "at = [\n"
         "  { t = 1, do = \"move\", id = \"h\", to = [0, 0, 0] },\n"
         "  { t = 2, do = \"grab\", id = \"h\", target = \"rope.r@end\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:30: error: \"h\" has grabbed nothing before 1 s\n"
         "    { t = 1, do = \"move\", id = \"h\", to = [0, 0, 0] },\n"
         "                               ^"},
        {"a release of nothing",
         "at = [\n"
         "  { t = 1, do = \"release\", id = \"h\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:33: error: \"h\" has grabbed nothing before 1 s\n"
         "    { t = 1, do = \"release\", id = \"h\" },\n"
         "                                  ^"},
        {"a mistyped hand",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"left\", target = \"rope.r@end\" },\n"
         "  { t = 2, do = \"release\", id = \"lefd\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:4:33: error: \"lefd\" has grabbed nothing before 2 s\n"
         "    { t = 2, do = \"release\", id = \"lefd\" },\n"
         "                                  ^ did you mean \"left\"?"},
        {"a move after the release",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@end\" },\n"
         "  { t = 2, do = \"release\", id = \"h\" },\n"
         "  { t = 3, do = \"move\", id = \"h\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:5:30: error: \"h\" has let go before 3 s\n"
         "    { t = 3, do = \"move\", id = \"h\", to = [0, 0, 0] },\n"
         "                               ^"},
        {"a second grab",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@end\" },\n"
         "  { t = 2, do = \"grab\", id = \"h\", target = \"rope.r@start\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:4:30: error: \"h\" is holding something since 1 s\n"
         "    { t = 2, do = \"grab\", id = \"h\", target = \"rope.r@start\" },\n"
         "                               ^ release it first, or give this hand another id"},
        {"a hand called as a joint",
         "at = [{ t = 1, do = \"grab\", id = \"peg\", target = \"rope.r@end\" }]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "name = \"peg\"\n"
         "a = \"rope.r@start\"\n"
         "b = \"rope.r@end\"\n"
         "kind = \"rod\"\n",
         "s.toml:2:34: error: \"peg\" is the name of a joint\n"
         "  at = [{ t = 1, do = \"grab\", id = \"peg\", target = \"rope.r@end\" }]\n"
         "                                   ^ give the hand another id, for both are released by it"},
        {"a mistyped joint",
         "at = [{ t = 1, do = \"release\", id = \"pegg\" }]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "name = \"peg\"\n"
         "a = \"rope.r@start\"\n"
         "b = \"rope.r@end\"\n"
         "kind = \"rod\"\n",
         "s.toml:2:37: error: \"pegg\" has grabbed nothing before 1 s, and no joint has that name\n"
         "  at = [{ t = 1, do = \"release\", id = \"pegg\" }]\n"
         "                                      ^ did you mean \"peg\"?"},
        {"a release where joints have no names",
         "at = [{ t = 1, do = \"release\", id = \"peg\" }]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "a = \"rope.r@start\"\n"
         "b = \"rope.r@end\"\n"
         "kind = \"rod\"\n",
         "s.toml:2:37: error: \"peg\" has grabbed nothing before 1 s\n"
         "  at = [{ t = 1, do = \"release\", id = \"peg\" }]\n"
         "                                      ^ a joint or a seam is released by its name; give it one"},
        {"a claim about a joint that is not there",
         "check = [{ that = \"joints_left(pig) == 1\" }]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "name = \"peg\"\n"
         "a = \"rope.r@start\"\n"
         "b = \"rope.r@end\"\n"
         "kind = \"rod\"\n",
         "s.toml:2:32: error: there is no joint \"pig\"\n"
         "  check = [{ that = \"joints_left(pig) == 1\" }]\n"
         "                                 ^ did you mean \"peg\"?"},
    });
}

TEST(SceneErrors, ActionsThatContradictOneAnotherAreReported) {
    expectMessages({
        {"a hand on two ways",
         "at = [\n"
         "  { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@end\" },\n"
         "  { t = 1, do = \"move\", id = \"h\", to = [0, 1, 0], over_s = 2 },\n"
         "  { t = 2.5, do = \"move\", id = \"h\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:5:9: error: \"h\" is moved from 1 s to 3 s already\n"
         "    { t = 2.5, do = \"move\", id = \"h\", to = [0, 0, 0] },\n"
         "          ^"},
        {"a collider on two ways",
         "at = [\n"
         "  { t = 1, do = \"move\", target = \"collider.b\", to = [0, 1, 0], over_s = 1 },\n"
         "  { t = 1, do = \"move\", target = \"collider.b\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[collider.b]\n"
         "shape = \"box\"\n",
         "s.toml:4:9: error: collider.b is moved from 1 s to 2 s already\n"
         "    { t = 1, do = \"move\", target = \"collider.b\", to = [0, 0, 0] },\n"
         "          ^"},
        {"two ramps of one field",
         "at = [\n"
         "  { t = 2, do = \"ramp\", key = \"world.gravity\", to = [0, 0, 0], over_s = 1 },\n"
         "  { t = 1, do = \"ramp\", key = \"world.gravity\", to = [0, 9, 0], over_s = 1.5 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:9: error: world.gravity is changed from 1 s to 2.5 s already\n"
         "    { t = 2, do = \"ramp\", key = \"world.gravity\", to = [0, 0, 0], over_s = 1 },\n"
         "          ^"},
        {"points held and freed",
         "at = [\n"
         "  { t = 1, do = \"hold\", target = \"rope.r@end\" },\n"
         "  { t = 1, do = \"free\", target = \"rope.*\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:4:34: error: points of rope.r are held and freed at the same moment\n"
         "    { t = 1, do = \"free\", target = \"rope.*\" },\n"
         "                                   ^"},
        {"a body spawned twice",
         "at = [\n"
         "  { t = 1, do = \"spawn\", target = \"rope.r\" },\n"
         "  { t = 2, do = \"spawn\", target = \"rope.*\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:4:35: error: rope.r is spawned already at 1 s\n"
         "    { t = 2, do = \"spawn\", target = \"rope.*\" },\n"
         "                                    ^"},
        {"a body of a joint spawned",
         "at = [\n"
         "  { t = 1, do = \"spawn\", target = \"rope.s\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[rope.s]\n"
         "ends = [[1, 0, 0], [2, 0, 0]]\n"
         "[[joint]]\n"
         "a = \"rope.r@end\"\n"
         "b = \"rope.s@start\"\n",
         "s.toml:3:35: error: a joint ties rope.s: it cannot be spawned\n"
         "    { t = 1, do = \"spawn\", target = \"rope.s\" },\n"
         "                                    ^"},
        {"a push before the spawn",
         "at = [\n"
         "  { t = 1, do = \"push\", target = \"rope.r@end\", impulse_Ns = [1, 0, 0] },\n"
         "  { t = 2, do = \"spawn\", target = \"rope.r\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:34: error: rope.r@end is not there before it is spawned at 2 s\n"
         "    { t = 1, do = \"push\", target = \"rope.r@end\", impulse_Ns = [1, 0, 0] },\n"
         "                                   ^"},
    });
}

TEST(SceneErrors, RampsOfWhatCannotChangeAreReported) {
    expectMessages({
        {"an unknown section",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"wnid.w.velocity\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:31: error: there is no \"wnid\" to change\n"
         "    { t = 1, do = \"ramp\", key = \"wnid.w.velocity\", to = [0, 0, 0] },\n"
         "                                ^ did you mean \"wind\"?"},
        {"a section that nothing changes in",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"solver.dt\", to = 0.1 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:31: error: nothing of solver can change while the scene runs\n"
         "    { t = 1, do = \"ramp\", key = \"solver.dt\", to = 0.1 },\n"
         "                                ^ what may: world, material, rope, block, net, anchor, wind, filling, "
         "collider, "
         "camera, light, lamp, environment, background"},
        {"an unknown wind",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"wind.breze.velocity\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[wind.breeze]\n",
         "s.toml:3:31: error: there is no wind \"breze\"\n"
         "    { t = 1, do = \"ramp\", key = \"wind.breze.velocity\", to = [0, 0, 0] },\n"
         "                                ^ did you mean \"breeze\"?"},
        {"a wind where there is none",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"wind.breeze.velocity\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:31: error: there is no wind \"breeze\"\n"
         "    { t = 1, do = \"ramp\", key = \"wind.breeze.velocity\", to = [0, 0, 0] },\n"
         "                                ^ the scene has none"},
        {"an unknown field",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"wind.breeze.velocty\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[wind.breeze]\n",
         "s.toml:3:31: error: [wind.breeze] has no key \"velocty\"\n"
         "    { t = 1, do = \"ramp\", key = \"wind.breeze.velocty\", to = [0, 0, 0] },\n"
         "                                ^ did you mean \"velocity\"?"},
        {"a key without a field",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"wind.breeze\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[wind.breeze]\n",
         "s.toml:3:31: error: \"wind.breeze\" names no field\n"
         "    { t = 1, do = \"ramp\", key = \"wind.breeze\", to = [0, 0, 0] },\n"
         "                                ^ what may change: velocity, gust.amplitude, drag, lift"},
        {"a number of segments",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"rope.r.segments\", to = 12 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:31: error: rope.r.segments cannot change while the scene runs\n"
         "    { t = 1, do = \"ramp\", key = \"rope.r.segments\", to = 12 },\n"
         "                                ^ what may of it: stretch_N, bend_N, bending_rigidity_N_m2, damping_time_s, "
         "drag_per_s"},
        {"a field without a value",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"material.m.shear_N_per_m\", to = 12 },\n"
         "]\n"
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n",
         "s.toml:3:31: error: material.m.shear_N_per_m has no value to begin from\n"
         "    { t = 1, do = \"ramp\", key = \"material.m.shear_N_per_m\", to = 12 },\n"
         "                                ^ give it in [material.m]"},
        {"the eye of a camera with keys",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"camera.c.eye\", to = [0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[camera.c]\n"
         "keys = [{ t = 0, eye = [0, 0, 1], target = [0, 0, 0] }]\n",
         "s.toml:3:31: error: camera.c is a camera with keys, which has no eye\n"
         "    { t = 1, do = \"ramp\", key = \"camera.c.eye\", to = [0, 0, 0] },\n"
         "                                ^"},
        {"a number for a vector",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"world.gravity\", to = -1.6 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:53: error: gravity must be a list of 3 numbers [m/s²], not -1.6\n"
         "    { t = 1, do = \"ramp\", key = \"world.gravity\", to = -1.6 },\n"
         "                                                      ^"},
        {"too many components",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"world.gravity\", to = [0, 0, 0, 0] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:53: error: gravity must be a list of 3 numbers [m/s²], not a list of 4\n"
         "    { t = 1, do = \"ramp\", key = \"world.gravity\", to = [0, 0, 0, 0] },\n"
         "                                                      ^"},
        {"a vector for a number",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"rope.r.stretch_N\", to = [1, 2] },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:56: error: stretch_N must be a number [N], not a list of 2\n"
         "    { t = 1, do = \"ramp\", key = \"rope.r.stretch_N\", to = [1, 2] },\n"
         "                                                         ^"},
        {"a value out of its range",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"rope.r.stretch_N\", to = -5 },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:56: error: stretch_N must be above 0 N, not -5\n"
         "    { t = 1, do = \"ramp\", key = \"rope.r.stretch_N\", to = -5 },\n"
         "                                                         ^"},
        {"a word for a number",
         "at = [\n"
         "  { t = 1, do = \"ramp\", key = \"rope.r.stretch_N\", to = \"soft\" },\n"
         "]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:56: error: to must be a number, a list of numbers or \"#rrggbb\", not \"soft\"\n"
         "    { t = 1, do = \"ramp\", key = \"rope.r.stretch_N\", to = \"soft\" },\n"
         "                                                         ^"},
    });
}

TEST(SceneErrors, SeamsThatTheRunDoesNotSeeOrSeesTwiceAreReported) {
    expectMessages({
        {"a seam past the end",
         "run = { seconds = 2 }\n"
         "[[seam]]\n"
         "a = \"cloth.a@right\"\n"
         "b = \"cloth.b@left\"\n"
         "start_s = 2\n"
         "over_s = 1\n"
         "[material.m]\n"
         "[cloth.a]\n"
         "material = \"m\"\n"
         "[cloth.b]\n"
         "material = \"m\"\n",
         "s.toml:6:11: error: 2 s is past the end: the last frame shows 1.98333 s\n"
         "  start_s = 2\n"
         "            ^ set seconds in [run]"},
        {"a seam twice",
         "[[seam]]\n"
         "a = \"cloth.a@right\"\n"
         "b = \"cloth.b@left\"\n"
         "[[seam]]\n"
         "a = \"cloth.b@left\"\n"
         "b = \"cloth.a@right\"\n"
         "over_s = 1\n"
         "[material.m]\n"
         "[cloth.a]\n"
         "material = \"m\"\n"
         "[cloth.b]\n"
         "material = \"m\"\n",
         "s.toml:5:1: error: this seam is there already, in line 2\n"
         "  [[seam]]\n"
         "  ^"},
    });
}

}  // namespace
}  // namespace taut::scene
