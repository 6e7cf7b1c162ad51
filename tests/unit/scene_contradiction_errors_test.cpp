// Every row: a faulty scene and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, FieldsThatContradictEachOtherAreReported) {
    expectMessages({
        {"a mesh cloth with a size",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "mesh = \"square.obj\"\n"
         "size = [1, 1]\n"
         "cells = [3, 3]\n",
         "s.toml:6:1: error: size does not go with a cloth from a mesh\n"
         "  size = [1, 1]\n"
         "  ^ it belongs to a cloth grid\n"
         "s.toml:7:1: error: cells does not go with a cloth from a mesh\n"
         "  cells = [3, 3]\n"
         "  ^ it belongs to a cloth grid"},
        {"a grid with a position",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "position = [0, 0, 0]\n",
         "s.toml:5:1: error: position does not go with a cloth grid\n"
         "  position = [0, 0, 0]\n"
         "  ^ it belongs to a cloth from a mesh"},
        {"holes in a grid",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "cell_m = 0.1\n",
         "s.toml:5:1: error: cell_m does not go with a cloth grid\n"
         "  cell_m = 0.1\n"
         "  ^ it belongs to a cloth panel"},
        {"an outline that crosses itself",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "outline = [[0, 0], [1, 1], [1, 0], [0, 1]]\n",
         "s.toml:5:28: error: side 0 and side 2 cross or come nearer than a tenth of a cell: an outline goes round "
         "once "
         "and does not meet itself or a hole\n"
         "  outline = [[0, 0], [1, 1], [1, 0], [0, 1]]\n"
         "                             ^"},
        {"a hole outside, and edges that are none",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "outline = [[0, 0], [1, 0], [0, 1]]\n"
         "holes = [{ outline = [[2, 0], [3, 0], [2, 1]] }]\n"
         "edges = [{ name = \"side1\", corners = [0, 1] },\n"
         "         { name = \"hem\", corners = [0, 3] },\n"
         "         { name = \"hem\", corners = [1, 1] }]\n",
         "s.toml:6:23: error: this hole lies outside of the outline\n"
         "  holes = [{ outline = [[2, 0], [3, 0], [2, 1]] }]\n"
         "                        ^\n"
         "s.toml:7:19: error: \"side1\" cannot be the name of an edge\n"
         "  edges = [{ name = \"side1\", corners = [0, 1] },\n"
         "                    ^ all, side0, side1, hole0 and so on are there already\n"
         "s.toml:8:36: error: the outline has the corners 0 … 2\n"
         "           { name = \"hem\", corners = [0, 3] },\n"
         "                                     ^\n"
         "s.toml:9:19: error: there is an edge \"hem\" already\n"
         "           { name = \"hem\", corners = [1, 1] }]\n"
         "                    ^\n"
         "s.toml:9:36: error: an edge leads from one corner to another\n"
         "           { name = \"hem\", corners = [1, 1] }]\n"
         "                                     ^ from the last to the first it goes on round: [3, 0]"},
        {"a sheet that no energy has",
         "[material.m]\n"
         "bending_rigidity_N_m = { warp = 9e-5, weft = 1e-5, bias = 9e-6 }\n",
         "s.toml:3:59: error: no sheet is so soft at 45° with this warp and weft\n"
         "  bending_rigidity_N_m = { warp = 9e-5, weft = 1e-5, bias = 9e-6 }\n"
         "                                                            ^ it must be above (√warp - √weft)²/4 = 1e-05 N "
         "m"},
        {"a hysteresis that slips nowhere",
         "[material.m]\n"
         "bending_rigidity_N_m = 1e-5\n"
         "bending_hysteresis_N = 1e-3\n",
         "s.toml:4:24: error: a hysteresis needs the curvature at which threads slip\n"
         "  bending_hysteresis_N = 1e-3\n"
         "                         ^ give bending_yield_per_m too, such as a tenth of 2HB/(2B)"},
        {"a curvature at which nothing slips",
         "[material.m]\n"
         "bending_rigidity_N_m = 1e-5\n"
         "bending_yield_per_m = 5\n",
         "s.toml:4:23: error: nothing slips without a hysteresis\n"
         "  bending_yield_per_m = 5\n"
         "                        ^ give bending_hysteresis_N too"},
        {"a hysteresis of what does not bend",
         "[material.m]\n"
         "bending_hysteresis_N = 1e-3\n"
         "bending_yield_per_m = 5\n",
         "s.toml:3:24: error: a hysteresis is that of a sheet with a rigidity\n"
         "  bending_hysteresis_N = 1e-3\n"
         "                         ^ give bending_rigidity_N_m too"},
        {"a block of a ratio and a pressure",
         "[block.b]\n"
         "bulk_Pa = 1e5\n"
         "poisson = 0.3\n",
         "s.toml:3:11: error: [block.b] has either bulk_Pa or poisson\n"
         "  bulk_Pa = 1e5\n"
         "            ^ leave one out"},
        {"a curve that nothing keeps",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "closed = true\n"
         "rest_curved = true\n",
         "s.toml:5:15: error: without a bending rigidity nothing keeps the curve\n"
         "  rest_curved = true\n"
         "                ^ give bending_rigidity_N_m2 too"},
        {"a plane with a radius",
         "[collider.s]\n"
         "shape = \"plane\"\n"
         "radius = 1\n",
         "s.toml:4:1: error: radius does not go with shape \"plane\"\n"
         "  radius = 1\n"
         "  ^ it belongs to sphere, capsule, cylinder, cone"},
        {"a sphere with a size",
         "[collider.s]\n"
         "shape = \"sphere\"\n"
         "size = [1, 1, 1]\n",
         "s.toml:4:1: error: size does not go with shape \"sphere\"\n"
         "  size = [1, 1, 1]\n"
         "  ^ it belongs to box"},
        {"a box with a normal",
         "[collider.s]\n"
         "shape = \"box\"\n"
         "normal = [0, 1, 0]\n",
         "s.toml:4:1: error: normal does not go with shape \"box\"\n"
         "  normal = [0, 1, 0]\n"
         "  ^ it belongs to plane"},
        {"parts of what is no compound",
         "[collider.s]\n"
         "shape = \"box\"\n"
         "parts = []\n",
         "s.toml:4:1: error: parts does not go with shape \"box\"\n"
         "  parts = []\n"
         "  ^ it belongs to compound"},
        {"a compound without parts",
         "[collider.s]\n"
         "shape = \"compound\"\n"
         "parts = []\n",
         "s.toml:4:9: error: a compound needs parts\n"
         "  parts = []\n"
         "          ^"},
        {"a compound within a compound",
         "[collider.s]\n"
         "shape = \"compound\"\n"
         "parts = [{ shape = \"compound\" }]\n",
         "s.toml:4:20: error: shape must be one of box, sphere, capsule, cylinder, cone, hull, mesh, not \"compound\"\n"
         "  parts = [{ shape = \"compound\" }]\n"
         "                     ^"},
        {"a place beside keys",
         "[collider.s]\n"
         "shape = \"sphere\"\n"
         "position = [0, 0, 0]\n"
         "keys = [{ t = 0 }]\n",
         "s.toml:4:1: error: a collider with keys has no position of its own\n"
         "  position = [0, 0, 0]\n"
         "  ^ write it into the keys"},
        {"keys that do not ascend",
         "[collider.s]\n"
         "shape = \"sphere\"\n"
         "keys = [{ t = 0 }, { t = 2 }, { t = 1 }]\n",
         "s.toml:4:37: error: keys must ascend in t: 1 follows 2\n"
         "  keys = [{ t = 0 }, { t = 2 }, { t = 1 }]\n"
         "                                      ^"},
        {"two keys at one time",
         "[camera.c]\n"
         "keys = [{ t = 1, eye = [0, 1, 5], target = [0, 1, 0] }, { t = 1, eye = [0, 1, 6], target = [0, 1, 0] }]\n",
         "s.toml:3:63: error: keys must ascend in t: 1 follows 1\n"
         "  keys = [{ t = 1, eye = [0, 1, 5], target = [0, 1, 0] }, { t = 1, eye = [0, 1, 6], target = [0, 1, 0] }]\n"
         "                                                                ^"},
        {"an orbit beside keys",
         "[camera.c]\n"
         "orbit_period_s = 3\n"
         "keys = [{ t = 0, eye = [0, 1, 5], target = [0, 1, 0] }]\n",
         "s.toml:3:1: error: orbit_period_s does not go with a camera with keys\n"
         "  orbit_period_s = 3\n"
         "  ^ it belongs to an orbiting camera"},
        {"an orbit without a period",
         "[camera.c]\n"
         "orbit_period_s = 0\n",
         "s.toml:3:18: error: orbit_period_s must not be 0\n"
         "  orbit_period_s = 0\n"
         "                   ^"},
        {"a camera at its target",
         "[camera.c]\n"
         "eye = [0, 1, 0]\n"
         "target = [0, 1, 0]\n",
         "s.toml:3:7: error: eye and target are the same point\n"
         "  eye = [0, 1, 0]\n"
         "        ^"},
        {"a camera that looks straight down",
         "[camera.c]\n"
         "eye = [0, 5, 0]\n"
         "target = [0, 1, 0]\n",
         "s.toml:3:7: error: the camera looks straight up or down\n"
         "  eye = [0, 5, 0]\n"
         "        ^ move eye a little aside"},
        {"a weld with a stiffness",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "a = \"rope.r@start\"\n"
         "b = \"rope.r@end\"\n"
         "stiffness_N_per_m = 10\n",
         "s.toml:7:1: error: stiffness_N_per_m does not go with a weld\n"
         "  stiffness_N_per_m = 10\n"
         "  ^ it belongs to a spring joint, a spring joint to a collider"},
        {"a spring joint with a reach",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[joint]]\n"
         "a = \"rope.r@start\"\n"
         "b = \"rope.r@end\"\n"
         "kind = \"spring\"\n"
         "reach_m = 1\n",
         "s.toml:8:1: error: reach_m does not go with a spring joint\n"
         "  reach_m = 1\n"
         "  ^ it belongs to a weld"},
        {"a picture without its file",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { pattern = \"image\" }\n",
         "s.toml:4:1: error: finish of [rope.r] needs texture\n"
         "  finish = { pattern = \"image\" }\n"
         "  ^ texture is a text: Picture file, PNG or JPEG"},
        {"a file without its pattern",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { texture = \"square.png\" }\n",
         "s.toml:4:12: error: texture does not go with a painted pattern\n"
         "  finish = { texture = \"square.png\" }\n"
         "             ^ it belongs to the pattern image"},
        {"a ground that ends before it fades",
         "[background]\n"
         "fade_start = 20\n"
         "fade_end = 10\n",
         "s.toml:4:12: error: fade_end must be above fade_start\n"
         "  fade_end = 10\n"
         "             ^"},
        {"a ground that fades beyond its end",
         "[background]\n"
         "fade_start = 50\n",
         "s.toml:3:14: error: fade_end must be above fade_start\n"
         "  fade_start = 50\n"
         "               ^"},
        {"a slanted cloth",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "across = [1, 1, 0]\n",
         "s.toml:5:10: error: across and down must be at right angles\n"
         "  across = [1, 1, 0]\n"
         "           ^ give down too; it is [0, -1, 0] now"},
        {"a slanted cloth in both directions",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "across = [1, 0, 0]\n"
         "down = [1, -1, 0]\n",
         "s.toml:6:8: error: across and down must be at right angles\n"
         "  down = [1, -1, 0]\n"
         "         ^"},
        {"a rope from a point to itself",
         "[rope.r]\n"
         "ends = [[1, 2, 3], [1, 2, 3]]\n",
         "s.toml:3:8: error: the two ends are the same point\n"
         "  ends = [[1, 2, 3], [1, 2, 3]]\n"
         "         ^"},
        {"a length for a rope that is as long as its way",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "length_m = 2\n"
         "through = [{ position = [0.5, 1, 0] }]\n",
         "s.toml:4:12: error: a rope with `through` is as long as its way\n"
         "  length_m = 2\n"
         "             ^ leave length_m out"},
        {"copies in one place",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "array = { count = [2, 1, 1] }\n",
         "s.toml:4:19: error: the 2 copies lie in the same place\n"
         "  array = { count = [2, 1, 1] }\n"
         "                    ^ give step_x"},
        {"a net without points",
         "[net.n]\n"
         "points = []\n",
         "s.toml:3:10: error: a net needs points\n"
         "  points = []\n"
         "           ^"},
    });
}

}  // namespace
}  // namespace taut::scene
