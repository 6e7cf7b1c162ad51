// Every row: a faulty scene and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, SyntaxIsReportedWhereTheTextStopsToBeToml) {
    expectMessages({
        {"a value is missing",
         "[solver]\n"
         "safety =\n",
         "s.toml:3:9: error: key-value pair: expected value, saw '\\n'\n"
         "  safety =\n"
         "          ^"},
        {"a text without its end", "title = \"flag\n",
         "s.toml:2:14: error: string: unescaped control characters other than TAB (U+0009) are explicitly prohibited\n"
         "  title = \"flag\n"
         "               ^"},
        {"a table given twice",
         "[solver]\n"
         "[run]\n"
         "[solver]\n",
         "s.toml:4:1: error: table header: cannot redefine existing table 'solver'\n"
         "  [solver]\n"
         "  ^"},
        {"a body given twice",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:4:1: error: table header: cannot redefine existing table 'rope.r'\n"
         "  [rope.r]\n"
         "  ^"},
        {"a key given twice",
         "[run]\n"
         "fps = 30\n"
         "fps = 60\n",
         "s.toml:4:7: error: key-value pair: cannot redefine existing integer 'fps'\n"
         "  fps = 60\n"
         "        ^"},
        {"a truncated list",
         "[world]\n"
         "gravity = [0, -9.81",
         "s.toml:3:20: error: array: encountered end-of-file\n"
         "  gravity = [0, -9.81\n"
         "                     ^"},
        {"an integer beyond 64 bits",
         "[run]\n"
         "fps = 9223372036854775808\n",
         "s.toml:3:26: error: decimal integer: '9223372036854775808' is not representable in 64 bits\n"
         "  fps = 9223372036854775808\n"
         "                           ^"},
        {"a number that is none",
         "[run]\n"
         "fps = 6O\n",
         "s.toml:3:8: error: decimal integer: expected digit, saw 'O'\n"
         "  fps = 6O\n"
         "         ^"},
        {"an unclosed header",
         "[run\n"
         "fps = 60\n",
         "s.toml:2:5: error: table header: expected ']', saw '\\n'\n"
         "  [run\n"
         "      ^"},
        {"a header without a name", "[[=]]\n",
         "s.toml:2:1: error: this line is not TOML\n"
         "  [[=]]\n"
         "  ^"},
        {"a table in braces over two lines",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { colour = [1, 0, 0],\n"
         "           pattern = \"plain\" }\n",
         "s.toml:4:10: error: a table in braces must end on the line where it begins\n"
         "  finish = { colour = [1, 0, 0],\n"
         "           ^ write it on one line, or as [rope.r.finish]"},
        {"an action over two lines",
         "at = [\n"
         "  { t = 1, do = \"free\",  # } a comment\n"
         "    target = \"rope.r@all\" },\n"
         "]\n",
         "s.toml:3:3: error: a table in braces must end on the line where it begins\n"
         "    { t = 1, do = \"free\",  # } a comment\n"
         "    ^ write it on one line, or as [[at]]"},
        {"a mistake before a table over two lines",
         "[run]\n"
         "fps = 6O\n"
         "[rope.r]\n"
         "finish = {\n"
         "}\n",
         "s.toml:3:8: error: decimal integer: expected digit, saw 'O'\n"
         "  fps = 6O\n"
         "         ^"},
        {"a letter beyond ASCII outside of quotes", "größe = 3\n",
         "s.toml:2:3: error: a letter beyond ASCII stands outside of quotes\n"
         "  größe = 3\n"
         "    ^"},
        {"a letter beyond ASCII after a broken line",
         "title = \"\"\"a\\\n"
         "  é\"\"\"\n",
         "s.toml:3:3: error: a letter beyond ASCII follows a backslash\n"
         "    é\"\"\"\n"
         "    ^"},
        {"too many parts of a key", "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r = 1\n",
         "s.toml:2:34: error: this key has too many parts\n"
         "  a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r = 1\n"
         "                                   ^"},
    });
}

TEST(SceneErrors, KeysAndTablesOutOfPlaceAreReportedWithARemedy) {
    expectMessages({
        {"an unknown key of the file", "titel = \"flag\"\n",
         "s.toml:2:1: error: a scene has no \"titel\"\n"
         "  titel = \"flag\"\n"
         "  ^ did you mean \"title\"?"},
        {"an unknown section", "[cloths.flag]\n",
         "s.toml:2:2: error: a scene has no \"cloths\"\n"
         "  [cloths.flag]\n"
         "   ^ did you mean \"cloth\"?"},
        {"an unknown section unlike any other", "[zzzzzz]\n",
         "s.toml:2:2: error: a scene has no \"zzzzzz\"\n"
         "  [zzzzzz]\n"
         "   ^"},
        {"an unknown key of a setting",
         "[solver]\n"
         "integratr = \"leapfrog\"\n",
         "s.toml:3:1: error: [solver] has no key \"integratr\"\n"
         "  integratr = \"leapfrog\"\n"
         "  ^ did you mean \"integrator\"?"},
        {"an unknown key unlike any other",
         "[run]\n"
         "whatever = 1\n",
         "s.toml:3:1: error: [run] has no key \"whatever\"\n"
         "  whatever = 1\n"
         "  ^ it has fps, seconds, start"},
        {"an unknown key of a table with many",
         "[material.m]\n"
         "[cloth.c]\n"
         "material = \"m\"\n"
         "zzzzzz = 1\n",
         "s.toml:5:1: error: [cloth.c] has no key \"zzzzzz\"\n"
         "  zzzzzz = 1\n"
         "  ^ it has material, size, cells, origin, across, down, grain_deg, round, hold, clamp, hold_on, velocity, "
         "spin_rad_per_s, "
         "jitter_m, seed, friction, restitution, thickness, collide, touch, finish, solver, array, like"},
        {"a timeline below a table",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "at = [{ t = 0.1, do = \"free\", target = \"rope.r@all\" }]\n",
         "s.toml:4:1: error: [rope.r] has no key \"at\"\n"
         "  at = [{ t = 0.1, do = \"free\", target = \"rope.r@all\" }]\n"
         "  ^ write it above the first table, or as [[at]]"},
        {"a setting below a table",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "run = { fps = 30 }\n",
         "s.toml:4:1: error: [rope.r] has no key \"run\"\n"
         "  run = { fps = 30 }\n"
         "  ^ write it above the first table, or as [run]"},
        {"a title below a table",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "title = \"a rope\"\n",
         "s.toml:4:1: error: [rope.r] has no key \"title\"\n"
         "  title = \"a rope\"\n"
         "  ^ write it above the first table"},
        {"a key without its unit",
         "[material.m]\n"
         "density = 0.2\n",
         "s.toml:3:1: error: [material.m] has no key \"density\"\n"
         "  density = 0.2\n"
         "  ^ did you mean \"density_kg_per_m2\"?"},
        {"an American colour in a finish",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = { color = [1, 0, 0] }\n",
         "s.toml:4:12: error: finish of [rope.r] has no key \"color\"\n"
         "  finish = { color = [1, 0, 0] }\n"
         "             ^ did you mean \"colour\"?"},
        {"a key of the finish beside it",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "colour = [1, 0, 0]\n",
         "s.toml:4:1: error: [rope.r] has no key \"colour\"\n"
         "  colour = [1, 0, 0]\n"
         "  ^ did you mean finish = { colour = … }?"},
        {"a key in a list of tables",
         "[collider.s]\n"
         "shape = \"sphere\"\n"
         "keys = [{ t = 0, pos = [0, 0, 0] }]\n",
         "s.toml:4:18: error: keys[0] of [collider.s] has no key \"pos\"\n"
         "  keys = [{ t = 0, pos = [0, 0, 0] }]\n"
         "                   ^ did you mean \"position\"?"},
        {"a setting that is no table", "solver = 3\n",
         "s.toml:2:1: error: solver must be a table, not 3\n"
         "  solver = 3\n"
         "  ^ write [solver]"},
        {"a kind that is no table", "cloth = \"flag\"\n",
         "s.toml:2:1: error: cloth must be a table, not \"flag\"\n"
         "  cloth = \"flag\"\n"
         "  ^ write [cloth.NAME]"},
        {"a body without a name",
         "[cloth]\n"
         "size = [1, 1]\n",
         "s.toml:3:1: error: size belongs to a cloth with a name\n"
         "  size = [1, 1]\n"
         "  ^ write [cloth.NAME]"},
        {"a body that is no table",
         "[cloth]\n"
         "flag = 1\n",
         "s.toml:3:1: error: cloth.flag must be a table, not 1\n"
         "  flag = 1\n"
         "  ^ write [cloth.NAME]"},
        {"a body with an impossible name", "[rope.\"a b\"]\n",
         "s.toml:2:7: error: \"a b\" cannot be the name of a rope\n"
         "  [rope.\"a b\"]\n"
         "        ^ a name has letters, digits, - and _"},
        {"a body with an empty name", "[rope.\"\"]\n",
         "s.toml:2:7: error: \"\" cannot be the name of a rope\n"
         "  [rope.\"\"]\n"
         "        ^ a name has letters, digits, - and _"},
        {"a list written as a table",
         "[joint]\n"
         "a = \"rope.r@all\"\n",
         "s.toml:2:2: error: joint must be a list of tables, not a table\n"
         "  [joint]\n"
         "   ^ write [[joint]]"},
        {"a list with a number in it", "mass = [1]\n",
         "s.toml:2:9: error: mass[0] must be a table, not 1\n"
         "  mass = [1]\n"
         "          ^"},
        {"a table inside that is none",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "finish = \"red\"\n",
         "s.toml:4:10: error: finish must be a table, not \"red\"\n"
         "  finish = \"red\"\n"
         "           ^ write finish = { … }"},
        {"tables inside that are none",
         "[net.n]\n"
         "points = { name = \"a\" }\n",
         "s.toml:3:10: error: points must be a list of tables, not a table\n"
         "  points = { name = \"a\" }\n"
         "           ^ write points = [{ … }]"},
        {"a number among tables inside",
         "[net.n]\n"
         "points = [{ name = \"a\", position = [0, 0, 0] }, 7]\n",
         "s.toml:3:49: error: points[1] must be a table, not 7\n"
         "  points = [{ name = \"a\", position = [0, 0, 0] }, 7]\n"
         "                                                  ^"},
        {"a required key that is missing", "[cloth.c]\n",
         "s.toml:2:8: error: [cloth.c] needs material\n"
         "  [cloth.c]\n"
         "         ^ material is a text: Name of its material"},
        {"two required keys that are missing", "[[mass]]\n",
         "s.toml:2:1: error: [[mass]] needs target\n"
         "  [[mass]]\n"
         "  ^ target is a text: Points: KIND.NAME@SELECTOR\n"
         "s.toml:2:1: error: [[mass]] needs mass_kg\n"
         "  [[mass]]\n"
         "  ^ mass_kg is a number [kg]: Added mass, shared evenly among the points"},
        {"a required key inside that is missing",
         "[collider.s]\n"
         "shape = \"sphere\"\n"
         "keys = [{ position = [0, 0, 0] }]\n",
         "s.toml:4:9: error: keys[0] of [collider.s] needs t\n"
         "  keys = [{ position = [0, 0, 0] }]\n"
         "          ^ t is a number [s]: Moment"},
        {"a required key of one form",
         "[collider.s]\n"
         "shape = \"hull\"\n",
         "s.toml:2:11: error: [collider.s] needs mesh\n"
         "  [collider.s]\n"
         "            ^ mesh is a text: OBJ or glTF file"},
    });
}

}  // namespace
}  // namespace taut::scene
