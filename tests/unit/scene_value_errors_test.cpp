// Every row: a faulty scene and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, ValuesOfTheWrongTypeAreReported) {
    expectMessages({
        {"a text for a number",
         "[run]\n"
         "fps = \"fast\"\n",
         "s.toml:3:7: error: fps must be a number [1/s], not \"fast\"\n"
         "  fps = \"fast\"\n"
         "        ^"},
        {"a number for a text", "title = 7\n",
         "s.toml:2:9: error: title must be a text, not 7\n"
         "  title = 7\n"
         "          ^"},
        {"a list for a number",
         "[run]\n"
         "fps = [60]\n",
         "s.toml:3:7: error: fps must be a number [1/s], not a list of 1\n"
         "  fps = [60]\n"
         "        ^"},
        {"a number for a list",
         "[world]\n"
         "gravity = -9.81\n",
         "s.toml:3:11: error: gravity must be a list of 3 numbers [m/s²], not -9.81\n"
         "  gravity = -9.81\n"
         "            ^"},
        {"a number for a flag",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "collide = 1\n",
         "s.toml:4:11: error: collide must be true, false or \"faces\", not 1\n"
         "  collide = 1\n"
         "            ^"},
        {"a word that a flag has not",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "collide = \"face\"\n",
         "s.toml:4:11: error: collide must be true, false or \"faces\", not \"face\"\n"
         "  collide = \"face\"\n"
         "            ^ did you mean \"faces\"?"},
        {"a date for a number",
         "[run]\n"
         "seconds = 1979-05-27\n",
         "s.toml:3:11: error: seconds must be a number [s], not a date or time\n"
         "  seconds = 1979-05-27\n"
         "            ^"},
        {"a fraction for a whole number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "segments = 2.5\n",
         "s.toml:4:12: error: segments must be a whole number, not 2.5\n"
         "  segments = 2.5\n"
         "             ^"},
        {"a fraction in a list of whole numbers",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "cells = [3, 2.5]\n",
         "s.toml:5:13: error: cells[1] must be a whole number, not 2.5\n"
         "  cells = [3, 2.5]\n"
         "              ^"},
        {"a list that is too short",
         "[world]\n"
         "gravity = [0, -9.81]\n",
         "s.toml:3:11: error: gravity must be a list of 3 numbers [m/s²], not a list of 2\n"
         "  gravity = [0, -9.81]\n"
         "            ^"},
        {"a list that is too long",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "size = [1, 1, 1]\n",
         "s.toml:5:8: error: size must be a list of 2 numbers [m], not a list of 3\n"
         "  size = [1, 1, 1]\n"
         "         ^"},
        {"a text in a list of numbers",
         "[world]\n"
         "gravity = [0, \"down\", 0]\n",
         "s.toml:3:15: error: gravity[1] must be a number [m/s²], not \"down\"\n"
         "  gravity = [0, \"down\", 0]\n"
         "                ^"},
        {"ends that are one point",
         "[rope.r]\n"
         "ends = [0, 0, 0]\n",
         "s.toml:3:8: error: ends must be a list of two points, each a list of 3 numbers [m], not a list of 3\n"
         "  ends = [0, 0, 0]\n"
         "         ^"},
        {"ends with a short point",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0]]\n",
         "s.toml:3:20: error: ends[1] must be a list of 3 numbers [m], not a list of 2\n"
         "  ends = [[0, 0, 0], [1, 0]]\n"
         "                     ^"},
        {"a text for a list of texts",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = \"ends\"\n",
         "s.toml:4:8: error: hold must be a list of texts, not \"ends\"\n"
         "  hold = \"ends\"\n"
         "         ^ write hold = [\"ends\"]"},
        {"a number in a list of texts",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "hold = [\"start\", 3]\n",
         "s.toml:4:18: error: hold[1] must be a text, not 3\n"
         "  hold = [\"start\", 3]\n"
         "                   ^"},
        {"a wrong step",
         "[solver]\n"
         "dt = \"fast\"\n",
         "s.toml:3:6: error: dt must be \"auto\" or a number [s], not \"fast\"\n"
         "  dt = \"fast\"\n"
         "       ^"},
        {"a step that is true",
         "[solver]\n"
         "dt = true\n",
         "s.toml:3:6: error: dt must be \"auto\" or a number [s], not true\n"
         "  dt = true\n"
         "       ^"},
        {"an unknown choice",
         "[solver]\n"
         "integrator = \"leapforg\"\n",
         "s.toml:3:14: error: integrator must be one of euler, symplectic-euler, heun, midpoint, rk4, "
         "velocity-verlet, leapfrog, blanes-moan, implicit-euler, sdirk2, not \"leapforg\"\n"
         "  integrator = \"leapforg\"\n"
         "               ^ did you mean \"leapfrog\"?"},
        {"a choice that is a number",
         "[solver]\n"
         "precision = 64\n",
         "s.toml:3:13: error: precision must be one of single, double, not 64\n"
         "  precision = 64\n"
         "              ^"},
        {"a colour that is no colour",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { colour = \"red\" }\n",
         "s.toml:4:21: error: colour must be a list of 3 numbers from 0 to 1, or \"#rrggbb\", not \"red\"\n"
         "  finish = { colour = \"red\" }\n"
         "                      ^"},
        {"a colour with a wrong digit",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { colour = \"#12345g\" }\n",
         "s.toml:4:21: error: colour must be a list of 3 numbers from 0 to 1, or \"#rrggbb\", not \"#12345g\"\n"
         "  finish = { colour = \"#12345g\" }\n"
         "                      ^"},
        {"a colour that is too bright",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { colour = [255, 0, 0] }\n",
         "s.toml:4:21: error: colour must be a list of 3 numbers from 0 to 1, or \"#rrggbb\", not [255, 0, 0]\n"
         "  finish = { colour = [255, 0, 0] }\n"
         "                      ^ write \"#ff0000\""},
        {"a colour a little too bright",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { colour = [1.5, 0, 0] }\n",
         "s.toml:4:22: error: colour[0] must be between 0 and 1, not 1.5\n"
         "  finish = { colour = [1.5, 0, 0] }\n"
         "                       ^"},
        {"a title of two lines", "title = \"a\\nb\"\n",
         "s.toml:2:9: error: title must be a text of one line, not one with control characters\n"
         "  title = \"a\\nb\"\n"
         "          ^"},
    });
}

TEST(SceneErrors, ValuesOutOfRangeAreReported) {
    expectMessages({
        {"not a number",
         "[solver]\n"
         "safety = nan\n",
         "s.toml:3:10: error: safety must be a finite number, not nan\n"
         "  safety = nan\n"
         "           ^"},
        {"infinity",
         "[run]\n"
         "seconds = inf\n",
         "s.toml:3:11: error: seconds must be a finite number [s], not inf\n"
         "  seconds = inf\n"
         "            ^"},
        {"infinity in a list",
         "[world]\n"
         "gravity = [0, -inf, 0]\n",
         "s.toml:3:15: error: gravity[1] must be a finite number [m/s²], not -inf\n"
         "  gravity = [0, -inf, 0]\n"
         "                ^"},
        {"a negative mass",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "mass_kg = -1\n",
         "s.toml:4:11: error: mass_kg must be above 0 kg, not -1\n"
         "  mass_kg = -1\n"
         "            ^"},
        {"no mass",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "mass_kg = 0.0\n",
         "s.toml:4:11: error: mass_kg must be above 0 kg, not 0\n"
         "  mass_kg = 0.0\n"
         "            ^"},
        {"a mass that is far too small",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "mass_kg = 1e-30\n",
         "s.toml:4:11: error: mass_kg must be between 1e-09 and 1e+12 kg, not 1e-30\n"
         "  mass_kg = 1e-30\n"
         "            ^"},
        {"a number that is far too large",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "stretch_N = 1e30\n",
         "s.toml:4:13: error: stretch_N must be between 1e-09 and 1e+12 N, not 1e+30\n"
         "  stretch_N = 1e30\n"
         "              ^"},
        {"a share above 1",
         "[solver]\n"
         "safety = 1.5\n",
         "s.toml:3:10: error: safety must be between 0.01 and 1, not 1.5\n"
         "  safety = 1.5\n"
         "           ^"},
        {"no cells",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "cells = [0, 10]\n",
         "s.toml:5:10: error: cells[0] must be between 1 and 1e+09, not 0\n"
         "  cells = [0, 10]\n"
         "           ^"},
        {"negative cells",
         "[block.b]\n"
         "cells = [4, 4, -4]\n",
         "s.toml:3:16: error: cells[2] must be between 1 and 1e+09, not -4\n"
         "  cells = [4, 4, -4]\n"
         "                 ^"},
        {"a whole number beyond any count",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "segments = 9223372036854775807\n",
         "s.toml:4:12: error: segments must be between 1 and 1e+09, not 9223372036854775807\n"
         "  segments = 9223372036854775807\n"
         "             ^"},
        {"samples that no picture has",
         "[picture]\n"
         "samples = 2\n",
         "s.toml:3:11: error: samples must be 1 or 4 or 8 or 16, not 2\n"
         "  samples = 2\n"
         "            ^"},
        {"a shadow map that cannot be drawn",
         "[picture]\n"
         "shadow_size = 64\n",
         "s.toml:3:15: error: shadow_size must be between 128 and 16384 px, not 64\n"
         "  shadow_size = 64\n"
         "                ^"},
        {"a shadow map in no whole blocks",
         "[picture]\n"
         "shadow_size = 200\n",
         "s.toml:3:15: error: shadow_size must be a multiple of 128 [px], not 200\n"
         "  shadow_size = 200\n"
         "                ^"},
        {"a speed that counts as diverged",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "velocity = [0, 5000, 0]\n",
         "s.toml:4:16: error: velocity[1] must be between -3000 and 3000 m/s, not 5000\n"
         "  velocity = [0, 5000, 0]\n"
         "                 ^"},
        {"a size of nothing",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "size = [1, 0]\n",
         "s.toml:5:12: error: size[1] must be between 1e-06 and 1e+06 m, not 0\n"
         "  size = [1, 0]\n"
         "             ^"},
        {"a step above a second",
         "[solver]\n"
         "dt = 2\n",
         "s.toml:3:6: error: dt must be between 1e-09 and 1 s, not 2\n"
         "  dt = 2\n"
         "       ^"},
        {"a negative step",
         "[solver]\n"
         "dt = -1e-3\n",
         "s.toml:3:6: error: dt must be between 1e-09 and 1 s, not -0.001\n"
         "  dt = -1e-3\n"
         "       ^"},
        {"a direction of no length",
         "[light]\n"
         "direction = [0, 0, 0]\n",
         "s.toml:3:13: error: direction must not be [0, 0, 0]\n"
         "  direction = [0, 0, 0]\n"
         "              ^"},
        {"a light that fills the sky",
         "[light]\n"
         "softness_deg = 60\n",
         "s.toml:3:16: error: softness_deg must be between 0 and 45 degrees, not 60\n"
         "  softness_deg = 60\n"
         "                 ^"},
        {"a fourth light",
         "[lamp.one]\n"
         "[lamp.two]\n"
         "[lamp.three]\n",
         "s.toml:4:7: error: a scene has three lights at most: the sun and 2 lamps\n"
         "  [lamp.three]\n"
         "        ^ leave out a lamp"},
        {"a restitution above 1",
         "[collider.s]\n"
         "shape = \"sphere\"\n"
         "restitution = 1.2\n",
         "s.toml:4:15: error: restitution must be between 0 and 1, not 1.2\n"
         "  restitution = 1.2\n"
         "                ^"},
        {"more copies than an array has",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "array = { count = [1000, 1000, 1], step_x = [1, 0, 0], step_y = [0, 1, 0] }\n",
         "s.toml:4:19: error: an array has at most 100000 copies\n"
         "  array = { count = [1000, 1000, 1], step_x = [1, 0, 0], step_y = [0, 1, 0] }\n"
         "                    ^"},
        {"a scene too large for any machine",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "cells = [100000, 100000]\n",
         "s.toml:3:8: error: the scene is too large: 1e+10 points and 6e+10 springs need about 1.32e+04 GB; the limit "
         "is 5e+07 points and 16 GB\n"
         "  [cloth.c]\n"
         "         ^ cloth.c is the largest: give it fewer cells, segments or copies"},
        {"a wide field of view",
         "[camera.c]\n"
         "fov_deg = 180\n",
         "s.toml:3:11: error: fov_deg must be between 1 and 170 degrees, not 180\n"
         "  fov_deg = 180\n"
         "            ^"},
    });
}

}  // namespace
}  // namespace taut::scene
